// A function of every value of an array.
//
// One call for each element, all of them children of one call; nothing depends on the order. A
// change of k values runs k calls again.
//
// From scratch O(n); k changes O(k log k), because of the queue that orders them.
#pragma once

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

struct MapPlace {
  static constexpr std::string_view kName = "map_place";
  template <class S>
  void operator()(S& s, std::uint32_t place) const {
    const auto& array = s.template environment<const Array<S>>();
    s.write(array.out[place], image(s.read(array.in[place])));
  }
};
inline constexpr MapPlace map_place{};

/// Maps the array that is the environment.
struct MapArray {
  static constexpr std::string_view kName = "map_array";
  template <class S>
  void operator()(S& s) const {
    const auto n = static_cast<std::uint32_t>(s.template environment<const Array<S>>().in.size());
    for (std::uint32_t place = 0; place < n; ++place) s.template call<map_place>(place);
  }
};
inline constexpr MapArray map_array{};

}  // namespace examples
