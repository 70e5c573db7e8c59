// Memory for records that searches read at random places.
#pragma once

#include <cstddef>
#include <new>

#include "sac/huge_pages.hpp"

namespace mesher::detail {

/// Memory from the start of a cache line: what is aligned in it lies in as few lines as it can.
/// Large blocks are on huge pages, since searches read them at random places.
template <class T>
struct LineAllocator {
  using value_type = T;
  static constexpr std::size_t kHuge = std::size_t{2} << 20;

  LineAllocator() = default;
  template <class U>
  explicit LineAllocator(const LineAllocator<U>&) noexcept {}
  [[nodiscard]] T* allocate(std::size_t n) {
    const std::size_t bytes = n * sizeof(T);
    void* const block = ::operator new(bytes, alignment(bytes));
    if (bytes >= 2 * kHuge) sac::advise_huge_pages(block, bytes);
    return static_cast<T*>(block);
  }
  void deallocate(T* block, std::size_t n) noexcept {
    ::operator delete(block, alignment(n * sizeof(T)));
  }
  friend bool operator==(const LineAllocator&, const LineAllocator&) { return true; }

 private:
  static std::align_val_t alignment(std::size_t bytes) noexcept {
    return std::align_val_t(bytes >= 2 * kHuge ? kHuge : 64);
  }
};

}  // namespace mesher::detail
