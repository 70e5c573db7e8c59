// Pooled memory for calls and edges, addressed by 32-bit handles.
//
// One range of address space is reserved per arena, aligned to its own size; memory is committed as
// it is needed and never moves. A handle counts 8-byte granules from the start of the range; 0 is
// "nothing". Freed blocks go to a free list of their exact size and are handed out again, last
// freed first. The alignment makes the handle of an object, and the arena that it lies in, known
// from its address alone.
//
// Guarantees:
// (1) A block's address is fixed from allocate() to release().
// (2) allocate() and release() take O(1) (blocks above 1 KiB: O(log of distinct sizes)).
// (3) A program that allocates and frees the same sizes over and over keeps its memory flat.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "sac/internal/platform.hpp"

namespace sac {

struct Function;

/// A 32-bit handle of an object in an arena; 0 is null.
using Handle = std::uint32_t;

class Arena {
 public:
  static constexpr std::size_t kGranule = 8;
  /// Address space of an arena: 2^32 handles at the most.
  static constexpr std::size_t kReserve = std::size_t{1} << platform::kReserveBits;
  static_assert(kReserve / kGranule <= std::size_t{1} << 32);

  /// What lies at the start of the range, for objects that know nothing but their own address.
  struct Header {
    const Function* const* functions = nullptr;  // by number
    bool ending = false;                         // the engine is being destroyed
    std::uint32_t stamps = 0;                    // given by next_stamp()
  };

  /// Reserves the address range, or where that is limited a smaller one. Throws: std::bad_alloc if
  /// there is none of 64 MiB.
  Arena();
  ~Arena();
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  /// `bytes` of memory aligned to 8. Throws: std::bad_alloc. Cost: O(1).
  [[nodiscard]] Handle allocate(std::size_t bytes) {
    const std::size_t granules = granules_for(bytes);
    if (--until_failure_ == 0) fail();
    if (granules < kSmall && free_[granules] != 0) {
      const Handle head = free_[granules];
      free_[granules] = *at<Handle>(head);
      used_ += granules;
      return head;
    }
    if (granules < kSmall && spares_.empty() && (next_ + granules) * kGranule <= usable_) {
      const auto fresh = static_cast<Handle>(next_);
      __builtin_prefetch(at<void>(fresh + kFetchAhead), 1);
      next_ += granules;
      used_ += granules;
      return fresh;
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
  [[nodiscard]] Handle handle_of(const void* object) const noexcept { return locate(object); }
  [[nodiscard]] bool contains(const void* object) const noexcept {
    return static_cast<std::size_t>(static_cast<const std::byte*>(object) - base_) <
           next_ * kGranule;
  }
  [[nodiscard]] bool contains(Handle handle, std::size_t bytes) const noexcept {
    return handle != 0 && handle + granules_for(bytes) <= next_;
  }
  [[nodiscard]] Header& header() const noexcept { return *reinterpret_cast<Header*>(base_); }

  /// The handle of an object that lies in some arena.
  [[nodiscard]] static Handle locate(const void* object) noexcept {
    return static_cast<Handle>((reinterpret_cast<std::uintptr_t>(object) & (kReserve - 1)) /
                               kGranule);
  }
  [[nodiscard]] static bool same_arena(const void* a, const void* b) noexcept {
    return (reinterpret_cast<std::uintptr_t>(a) ^ reinterpret_cast<std::uintptr_t>(b)) < kReserve;
  }
  /// The header of the arena that `object` lies in.
  [[nodiscard]] static Header& header_of(const void* object) noexcept {
    return *reinterpret_cast<Header*>(reinterpret_cast<std::uintptr_t>(object) & ~(kReserve - 1));
  }
  /// The object of this handle in the arena that `neighbour` lies in.
  template <class T>
  [[nodiscard]] static T* in_arena_of(const void* neighbour, Handle handle) noexcept {
    return reinterpret_cast<T*>((reinterpret_cast<std::uintptr_t>(neighbour) & ~(kReserve - 1)) +
                                handle * kGranule);
  }

  /// A number for an object that lies in some arena: no other object has it while kMostStamps are
  /// numbered, nor one of another arena.
  [[nodiscard]] static std::uint32_t next_stamp(const void* object) noexcept {
    std::uint32_t& stamps = header_of(object).stamps;
    stamps = stamps % kMostStamps + 1;
    return number_of(object) * (kMostStamps + 1) + stamps;
  }
  /// Whether next_stamp() of an object in the arena that `object` lies in may have given `stamp`.
  [[nodiscard]] static bool is_stamp_of(std::uint32_t stamp, const void* object) noexcept {
    return stamp / (kMostStamps + 1) == number_of(object);
  }

  /// Memory of live blocks.
  [[nodiscard]] std::size_t bytes_used() const noexcept { return used_ * kGranule; }
  /// Memory taken from the system: live blocks, and freed ones that wait to be used again.
  [[nodiscard]] std::size_t bytes_held() const noexcept { return (next_ - spare_) * kGranule; }

  /// From now on allocate() fails rather than hold more than `bytes`.
  void set_limit(std::size_t bytes) noexcept {
    limit_ = bytes;
    usable_ = std::min(limit_, committed_);
  }
  [[nodiscard]] std::size_t limit() const noexcept { return limit_; }
  /// The `count`-th allocation from now fails, once; 0: none. For tests.
  void fail_after(std::uint64_t count) noexcept { until_failure_ = count; }

  /// Gives freed memory back to the system, if it takes any, where whole pages of it are free.
  /// Cost: O(f log f) for f free blocks. Throws: std::bad_alloc, and then changes nothing.
  void shrink();

  void check_invariants() const;

 private:
  static constexpr std::size_t kSmall = 129;  // size classes of up to 128 granules: 1 KiB
  // Memory never used before is written first, and what is only written the processor does not
  // fetch by itself: a few cache lines ahead of what is handed out.
  static constexpr Handle kFetchAhead = 512 / kGranule;

  struct Run {  // of free granules
    Handle first;
    std::size_t granules;
  };

  // The first bits of an address say which range of kReserve it is in: on Linux 12 of 47, which
  // leaves 20 of 32 for stamps.
  static constexpr int kNumberBits = platform::kAddressBits - platform::kReserveBits;
  static constexpr std::uint32_t kMostStamps = (std::uint32_t{1} << (32 - kNumberBits)) - 1;
  [[nodiscard]] static std::uint32_t number_of(const void* object) noexcept {
    constexpr std::uintptr_t kMask = (std::uintptr_t{1} << kNumberBits) - 1;
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object) / kReserve & kMask);
  }

  static std::size_t granules_for(std::size_t bytes) noexcept {
    return (bytes + kGranule - 1) / kGranule;
  }
  Handle allocate_slowly(std::size_t granules);
  void release_large(Handle handle, std::size_t granules) noexcept;
  void reserve();
  void commit(std::size_t bytes);
  [[noreturn]] void fail();
  [[nodiscard]] std::vector<Run> free_blocks() const;
  [[nodiscard]] bool discard(Run run) noexcept;
  void keep_free(Run run) noexcept;

  std::byte* base_ = nullptr;
  std::size_t reserved_ = 0;
  std::size_t next_;       // first granule never handed out
  std::size_t used_ = 0;   // granules of live blocks
  std::size_t spare_ = 0;  // granules in spare runs
  std::size_t committed_ = 0;
  std::size_t limit_ = kReserve;
  std::size_t usable_ = 0;  // committed, and within the limit
  std::uint64_t until_failure_ = 0;
  std::array<Handle, kSmall> free_{};
  std::map<std::size_t, Handle> free_large_;
  std::vector<Run> spares_;  // whose pages the system has; used from the back
};

}  // namespace sac
