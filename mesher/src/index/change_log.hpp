// The vertices that have changed since the last update.
//
// They are linked through their records, so that undoing, which must not fail, can log its changes.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "records/vertex.hpp"

namespace mesher::detail {

template <int D>
class ChangeLog {
 public:
  explicit ChangeLog(VertexPool<D>& pool) noexcept : pool_(pool) {}

  /// The vertex may have come, gone, or become another kind.
  void touch(Vertex<D>& v) noexcept {
    if (v.changed) return;
    v.changed = true;
    v.next_changed = std::exchange(first_, v.self);
  }
  /// v is there, and was not.
  void came(const Vertex<D>& v) noexcept {
    if (came_count_ < kFewVertices) came_[came_count_] = v.self;
    if (came_count_ <= kFewVertices) ++came_count_;
  }
  /// Those that came, if they are few; some may have gone again.
  [[nodiscard]] std::optional<std::span<const VertexHandle>> few_that_came() const noexcept {
    if (came_count_ > kFewVertices) return std::nullopt;
    return std::span(came_.data(), came_count_);
  }
  /// Whether is(vertex) of one that may have come, gone, or become another kind.
  template <class Is>
  [[nodiscard]] bool any_touched(Is&& is) const noexcept {
    VertexHandle h = first_;
    while (h != 0 && !is(pool_[h])) h = pool_[h].next_changed;
    return h != 0;
  }
  /// All of these.
  [[nodiscard]] std::vector<VertexHandle> touched() const {
    std::vector<VertexHandle> all;
    for (VertexHandle h = first_; h != 0; h = pool_[h].next_changed) all.push_back(h);
    return all;
  }

  /// Forgets everything; calls visit(vertex) for each that was listed, which may release it.
  /// Cost: O(what is listed).
  template <class Visit>
  void clear(Visit&& visit) noexcept {
    came_count_ = 0;
    for (VertexHandle h = std::exchange(first_, 0); h != 0;) {
      Vertex<D>& v = pool_[h];
      h = std::exchange(v.next_changed, 0);
      v.changed = false;
      visit(v);
    }
  }

 private:
  VertexPool<D>& pool_;
  VertexHandle first_ = 0;
  static constexpr std::size_t kFewVertices = 64;
  std::size_t came_count_ = 0;  // one more than are kept: too many
  std::array<VertexHandle, kFewVertices> came_;
};

}  // namespace mesher::detail
