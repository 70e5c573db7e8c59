// How much searches have looked at. While it is held nothing is counted: then several threads may
// search at once, as far as searches write nothing else.
#pragma once

#include <cstdint>

namespace mesher::detail {

class Tally {
 public:
  void add() noexcept {
    if (!held_) ++count_;
  }
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  void hold(bool held) noexcept { held_ = held; }
  [[nodiscard]] bool is_held() const noexcept { return held_; }

 private:
  std::uint64_t count_ = 0;
  bool held_ = false;
};

}  // namespace mesher::detail
