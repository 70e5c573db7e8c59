#include "failing_new.hpp"

#include <cstdlib>
#include <new>

namespace support {

Fuse allocation_fuse;
bool memory_is_out = false;

namespace {

void* block_of(std::size_t bytes) noexcept {
  return memory_is_out || allocation_fuse.burns() ? nullptr : std::malloc(bytes);
}

}  // namespace
}  // namespace support

void* operator new(std::size_t bytes) {
  void* const block = support::block_of(bytes);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return support::block_of(bytes);
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  const auto size = static_cast<std::size_t>(alignment);
  void* const block = support::memory_is_out || support::allocation_fuse.burns()
                          ? nullptr
                          : std::aligned_alloc(size, (bytes + size - 1) / size * size);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
