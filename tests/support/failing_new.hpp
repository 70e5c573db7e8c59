// operator new that fails on demand, in the test binaries that include this.
#pragma once

#include <cstdint>

namespace support {

/// Something that happens many times and shall fail once.
struct Fuse {
  std::uint64_t left = 0;  ///< it fails when this reaches 0; 0: never
  bool burns() noexcept { return left != 0 && --left == 0; }
};

extern Fuse allocation_fuse;  ///< burns with every operator new
extern bool memory_is_out;    ///< while true, operator new fails

}  // namespace support
