// Linux, on any processor.
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

#include "sac/internal/platform.hpp"

namespace sac::platform {

void* reserve(std::size_t bytes, std::size_t alignment) noexcept {
  constexpr int kFlags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE;
  // Where the system would put it: aligned places are tried from there downwards, then upwards.
  void* const anywhere = mmap(nullptr, bytes, PROT_NONE, kFlags, -1, 0);
  if (anywhere == MAP_FAILED) return nullptr;
  munmap(anywhere, bytes);
  const std::uintptr_t end = (std::uintptr_t{1} << kAddressBits) / alignment;
  const std::uintptr_t start =
      std::min(reinterpret_cast<std::uintptr_t>(anywhere) / alignment, end - 1);
  const auto at = [&](std::uintptr_t number) -> void* {
    void* const place = reinterpret_cast<void*>(number * alignment);
    void* const got = mmap(place, bytes, PROT_NONE, kFlags | MAP_FIXED_NOREPLACE, -1, 0);
    if (got == place) return got;
    if (got != MAP_FAILED) munmap(got, bytes);
    return nullptr;
  };
  for (std::uintptr_t n = start; n > 0; --n) {
    if (void* got = at(n)) return got;
  }
  for (std::uintptr_t n = start + 1; n < end; ++n) {
    if (void* got = at(n)) return got;
  }
  return nullptr;
}

void release(void* block, std::size_t bytes, std::size_t) noexcept { munmap(block, bytes); }

bool commit(void* from, std::size_t bytes) noexcept {
  return mprotect(from, bytes, PROT_READ | PROT_WRITE) == 0;
}

void discard(void* from, std::size_t bytes) noexcept { madvise(from, bytes, MADV_DONTNEED); }

std::size_t page_bytes() noexcept { return static_cast<std::size_t>(sysconf(_SC_PAGESIZE)); }

void advise_huge_pages(void* block, std::size_t bytes) noexcept {
  madvise(block, bytes, MADV_HUGEPAGE);
}

std::size_t stack_bytes() noexcept {
  constexpr rlim_t kUnknown = rlim_t{2} << 20;
  rlimit limit{};
  const bool known = getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return static_cast<std::size_t>(known ? limit.rlim_cur : kUnknown);
}

}  // namespace sac::platform
