// What is to be done: skinny simplices first, then crowded vertices, then simplices that are
// moderately skinny [Fig 2.9, 3.5; rules D9], the last found first.
//
// A simplex that is gone leaves its entry: the place of a simplex has a note whether its present
// one is waiting, and for what [rules D5].
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "delaunay/simplex_store.hpp"

namespace mesher::detail {

class WorkQueue {
 public:
  enum class Wait : std::uint8_t { none = 0, skinny, moderately_skinny };

  /// There are so many places of simplices.
  void make_room(std::size_t places) { wait_.resize(places, Wait::none); }
  /// The simplex is gone.
  void forget(std::uint32_t s) noexcept { wait_[s] = Wait::none; }
  void add(std::uint32_t s, Wait wait) {
    (wait == Wait::skinny ? skinny_ : moderate_).push_back(s);
    wait_[s] = wait;
  }
  void add_crowded(std::uint32_t v) { crowded_.push_back(v); }

  /// The next simplex, or kNone; it does not wait any more.
  [[nodiscard]] std::uint32_t take_skinny() noexcept { return take(skinny_, Wait::skinny); }
  [[nodiscard]] std::uint32_t take_moderate() noexcept {
    return take(moderate_, Wait::moderately_skinny);
  }
  /// The next vertex of which is_crowded(v), or kNone; it stays in the queue.
  template <class IsCrowded>
  [[nodiscard]] std::uint32_t crowded(IsCrowded&& is_crowded) noexcept {
    while (!crowded_.empty() && !is_crowded(crowded_.back())) crowded_.pop_back();
    return crowded_.empty() ? kNone : crowded_.back();
  }

 private:
  [[nodiscard]] std::uint32_t take(std::vector<std::uint32_t>& from, Wait wait) noexcept {
    while (!from.empty()) {
      const std::uint32_t s = from.back();
      from.pop_back();
      if (wait_[s] != wait) continue;
      wait_[s] = Wait::none;
      return s;
    }
    return kNone;
  }

  std::vector<std::uint32_t> skinny_, crowded_, moderate_;
  std::vector<Wait> wait_;  // by simplex
};

}  // namespace mesher::detail
