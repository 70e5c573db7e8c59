// What the platform says of memory, in vertices and in words.
#include "memory.hpp"

#include <array>
#include <cstdint>
#include <cstdio>

#include "platform/process.hpp"

namespace tool {

void bound_memory() noexcept {
  const std::uint64_t free = platform::free_memory_bytes();
  if (free != 0) platform::bound_memory(free);
}

std::string out_of_memory() {
  const std::uint64_t most = platform::peak_memory_bytes();
  if (most == 0) return "out of memory";
  constexpr double kGiB = 1 << 30;
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "out of memory after %.3g GiB",
                static_cast<double>(most) / kGiB);
  return text.data();
}

// Measured: 350 in the plane, 850 to 960 in space.
std::size_t most_vertices_in_memory(int dimension) {
  constexpr std::size_t kPlaneBytes = 300, kSpaceBytes = 700;
  return platform::free_memory_bytes() / (dimension == 2 ? kPlaneBytes : kSpaceBytes);
}

}  // namespace tool
