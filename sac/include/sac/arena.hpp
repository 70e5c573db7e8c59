// Pooled memory for calls and edges, addressed by 32-bit handles.
//
// One range of address space is reserved per arena; memory is committed as it is needed and never
// moves. A handle counts 8-byte granules from the start of the range; 0 is "nothing". Freed blocks
// go to a free list of their exact size and are handed out again, last freed first.
//
// Guarantees:
// (1) A block's address is fixed from allocate() to release().
// (2) allocate() and release() take O(1) (blocks above 1 KiB: O(log of distinct sizes)).
// (3) A program that allocates and frees the same sizes over and over keeps its memory flat.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>

namespace sac {

/// A 32-bit handle of an object in an arena; 0 is null.
using Handle = std::uint32_t;

class Arena {
 public:
  static constexpr std::size_t kGranule = 8;

  /// Reserves the address range; commits nothing. Throws: std::bad_alloc.
  Arena();
  ~Arena();
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  /// `bytes` of memory aligned to 8. Throws: std::bad_alloc. Cost: O(1).
  [[nodiscard]] Handle allocate(std::size_t bytes) {
    const std::size_t granules = granules_for(bytes);
    if (granules < kSmall && free_[granules] != 0) {
      const Handle head = free_[granules];
      free_[granules] = *at<Handle>(head);
      used_ += granules;
      return head;
    }
    return allocate_slowly(granules);
  }

  /// Gives back a block of `bytes`. Requires: allocate(bytes) returned `handle`.
  void release(Handle handle, std::size_t bytes) noexcept {
    const std::size_t granules = granules_for(bytes);
    used_ -= granules;
    if (granules >= kSmall) return release_large(handle, granules);
    *at<Handle>(handle) = free_[granules];
    free_[granules] = handle;
  }

  template <class T>
  [[nodiscard]] T* at(Handle handle) const noexcept {
    return reinterpret_cast<T*>(base_ + std::size_t{handle} * kGranule);
  }

  [[nodiscard]] Handle handle_of(const void* object) const noexcept {
    return static_cast<Handle>((static_cast<const std::byte*>(object) - base_) / kGranule);
  }

  [[nodiscard]] std::size_t bytes_used() const noexcept { return used_ * kGranule; }
  [[nodiscard]] std::size_t bytes_committed() const noexcept { return committed_; }

  void check_invariants() const;

 private:
  static constexpr std::size_t kSmall = 129;  // size classes of up to 128 granules: 1 KiB

  static std::size_t granules_for(std::size_t bytes) noexcept {
    return (bytes + kGranule - 1) / kGranule;
  }
  Handle allocate_slowly(std::size_t granules);
  void release_large(Handle handle, std::size_t granules) noexcept;
  void commit(std::size_t bytes);

  std::byte* base_ = nullptr;
  std::size_t next_ = 1;  // first granule never handed out; granule 0 is null
  std::size_t used_ = 0;
  std::size_t committed_ = 0;
  std::array<Handle, kSmall> free_{};
  std::map<std::size_t, Handle> free_large_;
};

}  // namespace sac
