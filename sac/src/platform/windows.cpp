// Windows 8 and later, by its own interface.
#define WIN32_LEAN_AND_MEAN
#define NOMINMAX
#include <windows.h>

#include "sac/internal/platform.hpp"

namespace sac::platform {

// Aligned places are tried from the end of the addresses downwards.
void* reserve(std::size_t bytes, std::size_t alignment) noexcept {
  for (std::uintptr_t n = (std::uintptr_t{1} << kAddressBits) / alignment - 1; n > 0; --n) {
    void* const place = reinterpret_cast<void*>(n * alignment);
    if (void* got = VirtualAlloc(place, bytes, MEM_RESERVE, PAGE_READWRITE)) return got;
  }
  return nullptr;
}

void release(void* block, std::size_t, std::size_t) noexcept { VirtualFree(block, 0, MEM_RELEASE); }

bool commit(void* from, std::size_t bytes) noexcept {
  return VirtualAlloc(from, bytes, MEM_COMMIT, PAGE_READWRITE) != nullptr;
}

// Reset pages need not be written anywhere; unlocking what is not locked takes them out of the
// working set, and so out of memory when others need it.
void discard(void* from, std::size_t bytes) noexcept {
  VirtualAlloc(from, bytes, MEM_RESET, PAGE_READWRITE);
  VirtualUnlock(from, bytes);
}

std::size_t page_bytes() noexcept {
  SYSTEM_INFO info;
  GetSystemInfo(&info);
  return info.dwPageSize;
}

// Huge pages need a privilege here that programs do not have.
void advise_huge_pages(void*, std::size_t) noexcept {}

std::size_t stack_bytes() noexcept {
  ULONG_PTR low = 0, high = 0;
  GetCurrentThreadStackLimits(&low, &high);
  return high - low;
}

}  // namespace sac::platform
