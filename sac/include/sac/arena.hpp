// Pooled memory for calls and edges, addressed by 32-bit handles.
//
// An arena reserves one range of address space, aligned to its own size; memory is committed when
// needed and never moves. A handle counts 8-byte granules from the start of the range; 0 is null.
// Freed blocks go to a free list for their exact size and are reused, last freed first. Because of
// the alignment, the address of an object alone gives its handle and its arena.
//
// Guarantees:
// (1) The address of a block is fixed from allocate() to release().
// (2) allocate() and release() take O(1) (blocks above 1 KiB: O(log of the number of distinct
//     sizes)).
// (3) The memory of a program that allocates and frees the same sizes over and over does not grow.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <map>
#include <new>
#include <utility>
#include <vector>

#include "sac/internal/platform.hpp"

namespace sac {

struct Function;

/// A 32-bit handle of an object in an arena; 0 is null.
using Handle = std::uint32_t;

/// The handle of a T; null by default. A type of its own for each T: what lies there is known.
template <class T>
class Ref {
 public:
  constexpr Ref() = default;
  constexpr Ref(std::nullptr_t) noexcept {}
  /// Requires: a T lies there, or the handle is 0.
  constexpr explicit Ref(Handle handle) noexcept : handle_(handle) {}
  /// A record begins with its base.
  template <class Derived>
  requires(!std::same_as<Derived, T> &&
           std::derived_from<Derived, T>) constexpr Ref(Ref<Derived> derived) noexcept
      : handle_(derived.handle()) {}

  [[nodiscard]] constexpr Handle handle() const noexcept { return handle_; }
  constexpr explicit operator bool() const noexcept { return handle_ != 0; }
  friend constexpr bool operator==(Ref a, Ref b) noexcept { return a.handle_ == b.handle_; }

 private:
  Handle handle_ = 0;
};

/// The memory of an engine.
class Arena {
 public:
  static constexpr std::size_t kGranule = 8;
  /// Address space of an arena: at most 2^32 handles.
  static constexpr std::size_t kReserve = std::size_t{1} << platform::kReserveBits;
  static_assert(kReserve / kGranule <= std::size_t{1} << 32);

  /// Data at the start of the range, for objects that know only their own address.
  struct Header {
    const Function* const* functions = nullptr;  // by number
    bool ending = false;                         // the engine is being destroyed
    std::uint32_t stamps = 0;                    // given by next_stamp()
  };

  /// Reserves the address range, or a smaller one if address space is limited. Throws:
  /// std::bad_alloc if 64 MiB are not available.
  Arena();
  ~Arena();
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  /// Allocates `bytes` of memory aligned to 8. Throws: std::bad_alloc. Cost: O(1).
  [[nodiscard, gnu::always_inline]] Handle allocate(std::size_t bytes) {
    const std::size_t granules = granules_for(bytes);
    if (--until_failure_ == 0) fail();
    if (granules < kSmall && free_[granules] != 0) {
      const Handle head = free_[granules];
      free_[granules] = *at<Handle>(head);
      used_ += granules;
      return head;
    }
    if (granules < kSmall && next_ + granules <= fresh_end_) {
      const auto fresh = static_cast<Handle>(next_);
      __builtin_prefetch(at<void>(fresh + kFetchAhead), 1);
      next_ += granules;
      used_ += granules;
      return fresh;
    }
    return allocate_slowly(granules);
  }

  /// Frees a block of `bytes`. Requires: allocate(bytes) returned `handle`.
  void release(Handle handle, std::size_t bytes) noexcept {
    const std::size_t granules = granules_for(bytes);
    used_ -= granules;
    if (granules >= kSmall) return release_large(handle, granules);
    *at<Handle>(handle) = free_[granules];
    free_[granules] = handle;
  }

  /// Allocates memory for a T and makes one. Throws: std::bad_alloc, and what its constructor
  /// throws.
  template <class T, class... Args>
  [[nodiscard]] Ref<T> make(Args&&... args) {
    const Ref<T> fresh(allocate(sizeof(T)));
    try {
      ::new (at<void>(fresh.handle())) T(std::forward<Args>(args)...);
    } catch (...) {
      release(fresh, sizeof(T));
      throw;
    }
    return fresh;
  }
  /// Frees a block of `bytes` that begins with a T, which is destroyed already or needs no
  /// destroying. Requires: allocate(bytes) returned its handle.
  template <class T>
  void release(Ref<T> object, std::size_t bytes = sizeof(T)) noexcept {
    release(object.handle(), bytes);
  }

  /// The object of a handle that is not null.
  template <class T>
  [[nodiscard]] T& operator[](Ref<T> ref) const noexcept {
    return *at<T>(ref.handle());
  }
  template <class T>
  [[nodiscard]] T* at(Handle handle) const noexcept {
    return reinterpret_cast<T*>(base_ + std::size_t{handle} * kGranule);
  }
  template <class T>
  [[nodiscard]] static Ref<T> ref(const T& object) noexcept {
    return Ref<T>(handle_of(&object));
  }
  [[nodiscard]] bool contains(const void* object) const noexcept {
    return static_cast<std::size_t>(static_cast<const std::byte*>(object) - base_) <
           next_ * kGranule;
  }
  /// Whether there is room for a T at any handle, be it one of a T or not.
  template <class T>
  [[nodiscard]] bool contains(Ref<T> ref) const noexcept {
    return ref && ref.handle() + granules_for(sizeof(T)) <= next_;
  }
  [[nodiscard]] Header& header() const noexcept { return *reinterpret_cast<Header*>(base_); }

  /// The handle of an object in some arena.
  [[nodiscard]] static Handle handle_of(const void* object) noexcept {
    return static_cast<Handle>((reinterpret_cast<std::uintptr_t>(object) & (kReserve - 1)) /
                               kGranule);
  }
  [[nodiscard]] static bool same_arena(const void* a, const void* b) noexcept {
    return (reinterpret_cast<std::uintptr_t>(a) ^ reinterpret_cast<std::uintptr_t>(b)) < kReserve;
  }
  /// The header of the arena of `object`.
  [[nodiscard]] static Header& header_of(const void* object) noexcept {
    return *reinterpret_cast<Header*>(reinterpret_cast<std::uintptr_t>(object) & ~(kReserve - 1));
  }
  /// The object with this handle in the arena of `neighbour`.
  template <class T>
  [[nodiscard]] static T& in_arena_of(const void* neighbour, Ref<T> ref) noexcept {
    return *reinterpret_cast<T*>((reinterpret_cast<std::uintptr_t>(neighbour) & ~(kReserve - 1)) +
                                 ref.handle() * kGranule);
  }

  /// A number for an object in some arena: unique among all arenas, until kMostStamps further
  /// objects of its arena are numbered.
  [[nodiscard]] static std::uint32_t next_stamp(const void* object) noexcept {
    std::uint32_t& stamps = header_of(object).stamps;
    stamps = stamps % kMostStamps + 1;
    return number_of(object) * (kMostStamps + 1) + stamps;
  }
  /// Whether next_stamp() for an object in the arena of `object` may have returned `stamp`.
  [[nodiscard]] static bool is_stamp_of(std::uint32_t stamp, const void* object) noexcept {
    return stamp / (kMostStamps + 1) == number_of(object);
  }

  /// Bytes of live blocks.
  [[nodiscard]] std::size_t bytes_used() const noexcept { return used_ * kGranule; }
  /// Bytes taken from the system: live blocks, and freed blocks kept for reuse.
  [[nodiscard]] std::size_t bytes_held() const noexcept { return (next_ - spare_) * kGranule; }

  /// Limits the bytes held: allocate() fails beyond the limit.
  void set_limit(std::size_t bytes) noexcept {
    limit_ = bytes;
    open_fresh();
  }
  [[nodiscard]] std::size_t limit() const noexcept { return limit_; }
  /// Makes the `count`-th allocation from now fail, once; 0: none. For tests.
  void fail_after(std::uint64_t count) noexcept { until_failure_ = count; }

  /// Returns whole free pages to the system, if it accepts them. Cost: O(f log f) for f free
  /// blocks. Throws: std::bad_alloc, after which nothing is changed.
  void shrink();

  void check_invariants() const;

 private:
  static constexpr std::size_t kSmall = 129;  // size classes of up to 128 granules: 1 KiB
  // New memory is written before it is read, and the processor does not prefetch memory that is
  // only written. So allocate() prefetches a few cache lines ahead.
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
  void open_fresh() noexcept {
    fresh_end_ = spares_.empty() ? std::min(limit_, committed_) / kGranule : 0;
  }
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
  std::size_t fresh_end_ = 0;  // up to here next_ may go at once; 0: spare runs go first
  std::uint64_t until_failure_ = 0;
  std::array<Handle, kSmall> free_{};
  std::map<std::size_t, Handle> free_large_;
  std::vector<Run> spares_;  // whose pages the system has; used from the back
};

}  // namespace sac
