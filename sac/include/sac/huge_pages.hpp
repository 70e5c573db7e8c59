// Huge pages for tables with random access: most reads miss the cache, and with small pages also
// the address translation.
#pragma once

#include <cstddef>
#include <new>

namespace sac {

/// Asks the system for huge pages; a hint, whose failure is harmless.
void advise_huge_pages(void* block, std::size_t bytes) noexcept;

/// An allocator that puts large blocks on huge pages, and other blocks on normal memory.
template <class T>
class HugePages {
 public:
  using value_type = T;

  HugePages() = default;
  template <class U>
  HugePages(const HugePages<U>&) noexcept {}

  [[nodiscard]] T* allocate(std::size_t n) {
    const std::size_t bytes = n * sizeof(T);
    if (bytes < kFrom) return static_cast<T*>(::operator new(bytes, kAlignment));
    void* const block = ::operator new(bytes, std::align_val_t(kPage));
    advise_huge_pages(block, bytes);
    return static_cast<T*>(block);
  }
  void deallocate(T* block, std::size_t n) noexcept {
    if (n * sizeof(T) < kFrom) return ::operator delete(block, kAlignment);
    ::operator delete(block, std::align_val_t(kPage));
  }
  friend bool operator==(const HugePages&, const HugePages&) noexcept { return true; }

 private:
  static constexpr std::align_val_t kAlignment{alignof(T) > __STDCPP_DEFAULT_NEW_ALIGNMENT__
                                                   ? alignof(T)
                                                   : __STDCPP_DEFAULT_NEW_ALIGNMENT__};
  static constexpr std::size_t kPage = std::size_t{2} << 20;
  static constexpr std::size_t kFrom = 2 * kPage;
};

}  // namespace sac
