// operator new that fails on demand, in the test binaries that include this.
#pragma once

#include <atomic>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <utility>

namespace support {

/// Something that happens many times, in any thread, and shall fail once.
struct Fuse {
  std::uint64_t left = 0;  ///< it fails when this reaches 0; 0: never
  bool burns() noexcept {
    const std::atomic_ref<std::uint64_t> now(left);
    std::uint64_t before = now.load(std::memory_order_relaxed);
    while (before != 0 &&
           !now.compare_exchange_weak(before, before - 1, std::memory_order_relaxed)) {
    }
    return before == 1;
  }
};

/// What client code throws when its fuse burns.
struct ClientFailure : std::runtime_error {
  ClientFailure() : std::runtime_error("client code") {}
};

extern Fuse allocation_fuse;  ///< burns with every operator new
extern bool memory_is_out;    ///< while true, operator new fails

/// Whether run() throws when its `count`-th allocation fails; `burnt`: whether there were so many.
template <class Run>
bool fails(std::uint64_t count, bool& burnt, Run&& run) {
  allocation_fuse.left = count;
  bool failed = false;
  try {
    run();
  } catch (const std::bad_alloc&) {
    failed = true;
  }
  burnt = std::exchange(allocation_fuse.left, 0) == 0;
  return failed;
}

}  // namespace support
