// The vertices and stars that have changed since the last update.
//
// Everything is linked through existing records, so that undoing, which must not fail, can log its
// changes. A removed star hands its ring over; one ring is kept for each vertex, that of the star
// at the end of the last update.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "records/vertex.hpp"
#include "sac/arena.hpp"

namespace mesher::detail {

/// A star as its cell was written down; a block of the engine's arena.
struct Ring {
  VertexHandle center;
  sac::Handle next;  // in a list of rings
  std::uint32_t count;
  bool fresh;  // made since the last update

  [[nodiscard]] static std::size_t bytes(std::size_t count) noexcept {
    return sizeof(Ring) + count * sizeof(std::uint32_t);
  }
  [[nodiscard]] std::uint32_t* codes() noexcept {
    return reinterpret_cast<std::uint32_t*>(this + 1);
  }
  [[nodiscard]] std::span<const std::uint32_t> span() const noexcept {
    return {reinterpret_cast<const std::uint32_t*>(this + 1), count};
  }
};

template <int D>
class ChangeLog {
 public:
  /// The vertex, and its star as its cell was written down.
  struct Star {
    VertexHandle center;
    std::span<const std::uint32_t> ring;
  };

  ChangeLog(VertexPool<D>& pool, sac::Arena& arena) noexcept : pool_(pool), arena_(arena) {}

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
  /// The ring that v's star had at the end of the last update and has no more, if it is among the
  /// last few that went; else null.
  [[nodiscard]] const Ring* ring_gone(const Vertex<D>& v) const noexcept {
    sac::Handle h = gone_;
    for (int i = 0; i < kFewRings && h != 0; ++i, h = arena_.at<Ring>(h)->next) {
      if (arena_.at<Ring>(h)->center == v.self) return arena_.at<Ring>(h);
    }
    return nullptr;
  }
  /// v's star has gone; its ring is the log's from now on.
  void star_went(Vertex<D>& v, sac::Handle ring) noexcept {
    if (arena_.at<Ring>(ring)->fresh) return release(ring);
    mark_star(v);
    arena_.at<Ring>(ring)->next = std::exchange(gone_, ring);
  }
  /// v has a star that it had not, with this ring, and not in a first run.
  void star_came(Vertex<D>& v, sac::Handle ring) noexcept {
    arena_.at<Ring>(ring)->fresh = true;
    mark_star(v);
  }

  /// Vertices that may have come, gone, or become another kind; and those with another star.
  [[nodiscard]] std::vector<VertexHandle> touched() const {
    std::vector<VertexHandle> all;
    for (VertexHandle h = first_; h != 0; h = pool_[h].next_changed) all.push_back(h);
    return all;
  }
  /// The stars of the last update that are no more.
  [[nodiscard]] std::vector<Star> stars_gone() const {
    std::vector<Star> all;
    for (sac::Handle h = gone_; h != 0; h = arena_.at<Ring>(h)->next) {
      all.push_back({arena_.at<Ring>(h)->center, arena_.at<Ring>(h)->span()});
    }
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
      v.changed = v.star_changed = false;
      visit(v);
    }
    for (sac::Handle h = std::exchange(gone_, 0); h != 0;) {
      const sac::Handle next = arena_.at<Ring>(h)->next;
      release(h);
      h = next;
    }
  }

 private:
  void mark_star(Vertex<D>& v) noexcept {
    touch(v);
    v.star_changed = true;
  }
  void release(sac::Handle ring) noexcept {
    arena_.release(ring, Ring::bytes(arena_.at<Ring>(ring)->count));
  }

  VertexPool<D>& pool_;
  sac::Arena& arena_;
  VertexHandle first_ = 0;
  sac::Handle gone_ = 0;
  static constexpr std::size_t kFewVertices = 64;
  static constexpr int kFewRings = 256;
  std::size_t came_count_ = 0;  // one more than are kept: too many
  std::array<VertexHandle, kFewVertices> came_;
};

}  // namespace mesher::detail
