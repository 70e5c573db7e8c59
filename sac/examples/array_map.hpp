// A function of every value of an array.
//
// One call for every four values, all of them children of one call; nothing depends on the order. A
// change of k values runs at most k calls again, each of which reads its four.
//
// From scratch O(n); k changes O(k log k), because of the queue that orders them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sac/sac.hpp"

namespace examples {

template <class S>
struct Array {
  std::vector<typename S::template ModType<int>> in;   // inputs
  std::vector<typename S::template ModType<int>> out;  // written by the program
};

[[nodiscard]] inline int image(int x) noexcept { return x / 3 + x / 7 + x / 9; }

/// So many values are mapped by a call. The rest of a call costs as much as mapping four values:
/// with more values to a call, changes cost more and a run from scratch hardly less.
inline constexpr std::size_t kStretch = 4;

/// Maps the values from `first` on that are one call's.
struct MapStretch {
  static constexpr std::string_view kName = "map_stretch";
  template <class S>
  void operator()(S& s, std::uint32_t first) const {
    const auto& array = s.template environment<const Array<S>>();
    const std::size_t end = std::min(first + kStretch, array.in.size());
    for (std::size_t i = first; i < end; ++i) s.write(array.out[i], image(s.read(array.in[i])));
    s.weigh(end - first);
  }
};
inline constexpr MapStretch map_stretch{};

/// Maps the array that is the environment.
struct MapArray {
  static constexpr std::string_view kName = "map_array";
  template <class S>
  void operator()(S& s) const {
    const std::size_t n = s.template environment<const Array<S>>().in.size();
    for (std::size_t first = 0; first < n; first += kStretch) {
      s.template call<map_stretch>(static_cast<std::uint32_t>(first));
    }
  }
};
inline constexpr MapArray map_array{};

}  // namespace examples
