// Random numbers of the tests: the same in every build, from a seed.
#pragma once

#include <cstdint>

#include "sac/label.hpp"

namespace support {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(sac::mix(seed + 1)) {}
  /// 0 .. n - 1
  int operator()(int n) {
    state_ = sac::mix(state_ + 0x9e3779b97f4a7c15u);
    return static_cast<int>(state_ % static_cast<std::uint64_t>(n));
  }

 private:
  std::uint64_t state_;
};

}  // namespace support
