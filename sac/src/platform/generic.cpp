// Any system, in standard C++: an arena's range is one block of aligned memory, and pages are never
// given back. Where memory is filled when it is touched, as most systems do, a block costs
// addresses; elsewhere all of it.
#include <new>

#include "sac/internal/platform.hpp"

namespace sac::platform {

void* reserve(std::size_t bytes, std::size_t alignment) noexcept {
  return ::operator new(bytes, std::align_val_t(alignment), std::nothrow);
}

void release(void* block, std::size_t, std::size_t alignment) noexcept {
  ::operator delete(block, std::align_val_t(alignment));
}

bool commit(void*, std::size_t) noexcept { return true; }

void discard(void*, std::size_t) noexcept {}

std::size_t page_bytes() noexcept { return 4096; }

void advise_huge_pages(void*, std::size_t) noexcept {}

// What Windows gives; Linux and macOS give the first thread 8 times as much.
std::size_t stack_bytes() noexcept { return std::size_t{1} << 20; }

}  // namespace sac::platform
