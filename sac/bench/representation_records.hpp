// The candidate records of representation_bench, and how a reference of each becomes an address.
//
// A handle is a 32-bit index of an 8-byte granule: address = base + 8 * handle, 0 is null.
// A space has `Ref<T>`, `at(ref)`, and gives 64 KiB slabs; the kernel fills fresh pages with zeros
// when they are first touched. Letters A-D as in representation_bench.cpp.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <utility>

namespace representation {

constexpr std::size_t kGranule = 8;
constexpr std::size_t kRange = kGranule << 32;  // what 32-bit handles reach: 32 GiB
constexpr std::size_t kSlab = std::size_t{1} << 16;
constexpr unsigned kChunkBits = 18;  // D: 2^18 granules = 2 MiB, one huge page
constexpr std::size_t kChunk = kGranule << kChunkBits;

// ---- Addressing: what a reference is, and `at`, the way from it to memory ----------------------

template <class T>
struct Handle {
  std::uint32_t index = 0;
  explicit operator bool() const { return index != 0; }
  bool operator==(const Handle&) const = default;
};

/// Fresh pages, all zero; none is in memory before it is touched.
inline std::byte* map_pages(std::size_t bytes) {
  void* p = mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                 MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (p == MAP_FAILED) throw std::bad_alloc{};
  return static_cast<std::byte*>(p);
}

inline void ask_for_huge_pages(void* begin, std::size_t bytes, bool huge) {
  if (huge) madvise(begin, bytes, MADV_HUGEPAGE);
}

/// 32 GiB of address space; the kernel gives memory page by page, when first touched.
class Range {
 public:
  explicit Range(bool huge) : base_(map_pages(kRange)) { ask_for_huge_pages(base_, kRange, huge); }
  Range(const Range&) = delete;
  Range& operator=(const Range&) = delete;
  ~Range() { munmap(base_, kRange); }

  std::byte* base() const { return base_; }
  /// Offset of a slab never given since the last rewind; offset 0, the null handle, never is.
  std::size_t slab() {
    if (used_ + kSlab > kRange) throw std::bad_alloc{};
    return std::exchange(used_, used_ + kSlab);
  }
  void rewind() { used_ = kSlab; }

 private:
  std::byte* base_;
  std::size_t used_ = kSlab;
};

class Pointers {
 public:
  template <class T>
  using Ref = T*;
  explicit Pointers(bool huge) : range_(huge) {}

  template <class T>
  T* at(T* p) const {
    return p;
  }
  template <class To, class From>
  static To* cast(From* p) {
    return reinterpret_cast<To*>(p);
  }
  static std::byte* advance(std::byte* p, std::size_t bytes) { return p + bytes; }
  std::byte* slab() { return range_.base() + range_.slab(); }
  void rewind() { range_.rewind(); }

 private:
  Range range_;
};

struct HandleArithmetic {
  template <class T>
  using Ref = Handle<T>;
  template <class To, class From>
  static Handle<To> cast(Handle<From> h) {
    return {h.index};
  }
  static Handle<std::byte> advance(Handle<std::byte> h, std::size_t bytes) {
    return {static_cast<std::uint32_t>(h.index + bytes / kGranule)};
  }
};

class RangeHandles : public HandleArithmetic {
 public:
  explicit RangeHandles(bool huge) : range_(huge) {}

  template <class T>
  T* at(Handle<T> h) const {
    return reinterpret_cast<T*>(range_.base() + kGranule * h.index);
  }
  Handle<std::byte> slab() { return {static_cast<std::uint32_t>(range_.slab() / kGranule)}; }
  void rewind() { range_.rewind(); }

 private:
  Range range_;
};

class ChunkHandles : public HandleArithmetic {
 public:
  explicit ChunkHandles(bool huge) : huge_(huge), table_(new std::byte* [kRange / kChunk] {}) {}
  ~ChunkHandles() {
    for (std::size_t i = 0; i < kRange / kChunk; ++i)
      if (table_[i]) munmap(table_[i], kChunk);
  }

  template <class T>
  T* at(Handle<T> h) const {
    constexpr std::uint32_t kWithin = (1u << kChunkBits) - 1;
    return reinterpret_cast<T*>(table_[h.index >> kChunkBits] + kGranule * (h.index & kWithin));
  }
  Handle<std::byte> slab() {
    if (used_ + kSlab > kRange) throw std::bad_alloc{};
    if (!table_[used_ / kChunk]) table_[used_ / kChunk] = new_chunk();
    return {static_cast<std::uint32_t>(std::exchange(used_, used_ + kSlab) / kGranule)};
  }
  void rewind() { used_ = kSlab; }

 private:
  std::byte* new_chunk() const {
    std::byte* p = map_pages(2 * kChunk);  // an aligned chunk of it stays
    const std::size_t before = -reinterpret_cast<std::uintptr_t>(p) % kChunk;
    if (before) munmap(p, before);
    munmap(p + before + kChunk, kChunk - before);
    ask_for_huge_pages(p + before, kChunk, huge_);
    return p + before;
  }

  bool huge_;
  std::unique_ptr<std::byte*[]> table_;
  std::size_t used_ = kSlab;
};

// ---- Records ----------------------------------------------------------------------------------

struct Function {
  const char* name;
};
inline constexpr Function kFunction{"map_cell"};

/// A. The time stamps of start and end stand apart; every call has both.
struct Separate {
  using Address = Pointers;
  static constexpr bool kEmbedded = false;
  struct Call;
  struct Edge;
  struct Group {
    Group *prev, *next;
    std::uint64_t label;
  };
  struct Stamp {
    Stamp *prev, *next;
    Group* group;
    std::uint64_t label;
  };
  struct Mod {
    Edge* edges;
    std::uint64_t value;
  };
  struct Call {
    Stamp *start, *end;
    const Function* function;
    Edge* edges;
    Call* memo_next;
    std::uint64_t args;
  };
  struct Edge {
    Call* call;
    Mod* mod;
    Edge *prev, *next, *next_in_call;
  };
};
static_assert(sizeof(Separate::Call) == 48 && sizeof(Separate::Edge) == 40);
static_assert(sizeof(Separate::Stamp) == 32);

/// B and D. The call begins with its start stamp; an end stamp exists for calls with children.
template <class Handles>
struct Embedded {
  using Address = Handles;
  static constexpr bool kEmbedded = true;
  struct Call;
  struct Edge;
  struct Group {
    Handle<Group> prev, next;
    std::uint64_t label;
  };
  struct Stamp {
    Handle<Stamp> prev, next;
    Handle<Group> group;
    std::uint32_t label;
  };
  struct Mod {
    Handle<Edge> edges;
    std::uint64_t value;
  };
  struct Call {
    Stamp stamp;
    const Function* function;
    Handle<Stamp> end;
    Handle<Edge> edges;
    Handle<Call> memo_next;
    std::uint32_t hash, queue_position, flags;
    std::uint64_t args;
  };
  struct Edge {
    Handle<Edge> next_in_call;
    std::uint16_t structure;
    std::uint8_t size, flags;
    Handle<Mod> mod;
    Handle<Call> call;
    Handle<Edge> prev, next;
  };
};
static_assert(sizeof(Embedded<RangeHandles>::Call) == 56);
static_assert(sizeof(Embedded<RangeHandles>::Edge) == 24);
static_assert(sizeof(Embedded<RangeHandles>::Stamp) == 16);

/// C. B's fields with pointers, ordered so that nothing is lost to padding but 4 bytes an edge.
struct Wide {
  using Address = Pointers;
  static constexpr bool kEmbedded = true;
  struct Call;
  struct Edge;
  struct Group {
    Group *prev, *next;
    std::uint64_t label;
  };
  struct Stamp {
    Stamp *prev, *next;
    Group* group;
    std::uint32_t label, flags;
  };
  struct Mod {
    Edge* edges;
    std::uint64_t value;
  };
  struct Call {
    Stamp stamp;
    const Function* function;
    Stamp* end;
    Edge* edges;
    Call* memo_next;
    std::uint32_t hash, queue_position;
    std::uint64_t args;
  };
  struct Edge {
    Edge* next_in_call;
    std::uint16_t structure;
    std::uint8_t size, flags;
    Mod* mod;
    Call* call;
    Edge *prev, *next;
  };
};
static_assert(sizeof(Wide::Call) == 80 && sizeof(Wide::Edge) == 48 && sizeof(Wide::Stamp) == 32);

}  // namespace representation
