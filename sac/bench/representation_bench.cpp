// How to represent a call and an edge of the trace: four candidates, measured. No engine needed.
//
// A  pointers, separate time stamps    call 40 B + args, stamp 32 B, edge 40 B (the CEAL way)
// B  handles, embedded time stamps     call 48 B + args, stamp 16 B, edge 24 B
// C  pointers, embedded time stamps    call 72 B + args, stamp 32 B, edge 48 B (B's fields)
// D  B through a table of 2 MiB chunks instead of one reserved range
//
// A handle is a 32-bit index of an 8-byte granule: address = base + 8 * handle, 0 is null.
// Every candidate has the same pool (64 KiB slabs per size, free lists), the same two-level
// timeline and the same chained memo table; they differ in their records and in `at` alone.
// A call has 8 bytes of args, reads mod i and writes mod i + 1, one edge each.
//
//   g++ -std=c++20 -O3 -ffp-contract=off representation_bench.cpp -o representation_bench
//   ./representation_bench [--huge] [n ...]      default n: 100000 1000000
//
// Prints one JSON line per figure: median, least and greatest of 5 rounds, process CPU time; a
// round runs the candidates in turn. `--huge` asks the kernel for 2 MiB pages. What the figures
// mean for the engine: sac/docs/representation.md.
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <map>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace {

constexpr std::size_t kGranule = 8;
constexpr std::size_t kRange = kGranule << 32;  // what 32-bit handles reach: 32 GiB
constexpr std::size_t kSlab = std::size_t{1} << 16;
constexpr unsigned kChunkBits = 18;  // D: 2^18 granules = 2 MiB, one huge page
constexpr std::size_t kChunk = kGranule << kChunkBits;
constexpr std::size_t kLargestBlock = 128;
constexpr int kRounds = 5;
constexpr std::size_t kOperations = 1'000'000;

// ---- Addressing: what a reference is, and `at`, the way from it to memory ----------------------

template <class T>
struct Handle {
  std::uint32_t index = 0;
  explicit operator bool() const { return index != 0; }
  bool operator==(const Handle&) const = default;
};

void ask_for_huge_pages(void* begin, std::size_t bytes, bool huge) {
  if (huge) madvise(begin, bytes, MADV_HUGEPAGE);
}

/// 32 GiB of address space; the kernel gives memory page by page, when first touched.
class Range {
 public:
  explicit Range(bool huge) {
    void* p = mmap(nullptr, kRange, PROT_READ | PROT_WRITE,
                   MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (p == MAP_FAILED) throw std::bad_alloc{};
    base_ = static_cast<std::byte*>(p);
    ask_for_huge_pages(base_, kRange, huge);
  }
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
  T* at(T* p) const { return p; }
  template <class To, class From>
  static To* cast(From* p) { return reinterpret_cast<To*>(p); }
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
  static Handle<To> cast(Handle<From> h) { return {h.index}; }
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
  Handle<std::byte> slab() {
    return {static_cast<std::uint32_t>(range_.slab() / kGranule)};
  }
  void rewind() { range_.rewind(); }

 private:
  Range range_;
};

class ChunkHandles : public HandleArithmetic {
 public:
  explicit ChunkHandles(bool huge) : huge_(huge), table_(new std::byte* [kRange / kChunk] {}) {}
  ~ChunkHandles() {
    for (std::size_t i = 0; i < kRange / kChunk; ++i) std::free(table_[i]);
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
    void* p = std::aligned_alloc(kChunk, kChunk);
    if (!p) throw std::bad_alloc{};
    ask_for_huge_pages(p, kChunk, huge_);
    return static_cast<std::byte*>(p);
  }

  bool huge_;
  std::unique_ptr<std::byte*[]> table_;
  std::size_t used_ = kSlab;
};

// ---- Records ----------------------------------------------------------------------------------

struct Function {
  const char* name;
};
constexpr Function kFunction{"map_cell"};

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

// ---- Pool, timeline, trace: the same text for every candidate -----------------------------------

template <class Address>
class Pool {
 public:
  template <class T>
  using Ref = typename Address::template Ref<T>;
  explicit Pool(bool huge) : address_(huge) {}

  template <class T>
  T* at(Ref<T> r) const { return address_.at(r); }

  template <class T>
  Ref<T> make() {
    static_assert(sizeof(T) % kGranule == 0 && sizeof(T) <= kLargestBlock);
    Ref<T> r = Address::template cast<T>(take(classes_[sizeof(T) / kGranule], sizeof(T)));
    new (at<T>(r)) T{};
    live_ += sizeof(T);
    return r;
  }
  template <class T>
  void drop(Ref<T> r) {
    Class& c = classes_[sizeof(T) / kGranule];
    Ref<Free> f = Address::template cast<Free>(r);
    at<Free>(f)->next = std::exchange(c.free, f);
    live_ -= sizeof(T);
  }
  std::size_t live_bytes() const { return live_; }
  /// Forgets every block but keeps the pages.
  void rewind() {
    address_.rewind();
    classes_ = {};
    live_ = 0;
  }

 private:
  struct Free {
    Ref<Free> next;
  };
  struct Class {
    Ref<Free> free{};
    Ref<std::byte> bump{};
    std::size_t left = 0;
  };
  Ref<std::byte> take(Class& c, std::size_t bytes) {
    if (c.free) {
      Ref<Free> f = c.free;
      c.free = at<Free>(f)->next;
      return Address::template cast<std::byte>(f);
    }
    if (c.left < bytes) c.bump = address_.slab(), c.left = kSlab;
    c.left -= bytes;
    return std::exchange(c.bump, Address::advance(c.bump, bytes));
  }

  Address address_;
  std::array<Class, kLargestBlock / kGranule + 1> classes_{};
  std::size_t live_ = 0;
};

/// Order-maintenance list with two levels; a group is as long as its labels allow.
template <class R>
class Timeline {
 public:
  using P = Pool<typename R::Address>;
  using Stamp = typename R::Stamp;
  using Group = typename R::Group;
  using StampRef = typename P::template Ref<Stamp>;
  using GroupRef = typename P::template Ref<Group>;

  explicit Timeline(P& pool) : pool_(pool), first_(pool.template make<Stamp>()) {
    stamp(first_)->group = pool_.template make<Group>();
  }
  StampRef first() const { return first_; }

  bool precedes(StampRef a, StampRef b) const {
    const Stamp *x = stamp(a), *y = stamp(b);
    if (x->group == y->group) return x->label < y->label;
    return group(x->group)->label < group(y->group)->label;
  }

  void insert_after(StampRef where, StampRef fresh) {
    while (!give_label(where, fresh)) split(stamp(where)->group, where);
    Stamp *w = stamp(where), *f = stamp(fresh);
    f->prev = where;
    f->next = std::exchange(w->next, fresh);
    if (f->next) stamp(f->next)->prev = fresh;
  }

  void erase(StampRef s) {
    const Stamp* x = stamp(s);
    stamp(x->prev)->next = x->next;
    if (x->next) stamp(x->next)->prev = x->prev;
    const bool alone = stamp(x->prev)->group != x->group &&
                       (!x->next || stamp(x->next)->group != x->group);
    if (alone) erase_group(x->group);
  }

 private:
  using Label = decltype(Stamp::label);
  static constexpr Label kLast = std::numeric_limits<Label>::max();
  static constexpr Label kStep = kLast / 1024;           // 1024 appends fill a group
  static constexpr std::uint64_t kGroupStep = 1ull << 40;  // 2^24 groups appended
  static constexpr unsigned kSplitRun = 64;              // stamps in a group after a split

  Stamp* stamp(StampRef r) const { return pool_.template at<Stamp>(r); }
  Group* group(GroupRef r) const { return pool_.template at<Group>(r); }

  /// False when the group of `where` has no label left between it and its successor.
  bool give_label(StampRef where, StampRef fresh) {
    const Stamp* w = stamp(where);
    const bool last = !w->next || stamp(w->next)->group != w->group;
    if (last) return append(where, fresh), true;
    const Label gap = stamp(w->next)->label - w->label;
    if (gap < 2) return false;
    stamp(fresh)->group = w->group;
    stamp(fresh)->label = w->label + gap / 2;
    return true;
  }
  void append(StampRef where, StampRef fresh) {
    const Stamp* w = stamp(where);
    const bool full = w->label > kLast - kStep;
    stamp(fresh)->group = full ? new_group_after(w->group) : w->group;
    stamp(fresh)->label = full ? 0 : w->label + kStep;
  }
  void split(GroupRef g, StampRef s) {
    while (stamp(s)->prev && stamp(stamp(s)->prev)->group == g) s = stamp(s)->prev;
    GroupRef to = g;
    for (unsigned i = 0; s && stamp(s)->group == g; ++i, s = stamp(s)->next) {
      if (i % kSplitRun == 0 && i) to = new_group_after(to);
      stamp(s)->label = (i % kSplitRun) * (kLast / kSplitRun);
      stamp(s)->group = to;
      if (to == g) continue;
    }
  }
  GroupRef new_group_after(GroupRef g) {
    if (group(g)->next && group(group(g)->next)->label - group(g)->label < 2) relabel_groups();
    GroupRef fresh = pool_.template make<Group>();
    Group *x = group(g), *f = group(fresh);
    f->label = x->next ? x->label + (group(x->next)->label - x->label) / 2 : x->label + kGroupStep;
    f->prev = g;
    f->next = std::exchange(x->next, fresh);
    if (f->next) group(f->next)->prev = fresh;
    return fresh;
  }
  /// All of them, evenly: with gaps of 2^40 it does not happen in these workloads.
  void relabel_groups() {
    std::uint64_t label = 0;
    for (GroupRef g = stamp(first_)->group; g; g = group(g)->next, label += kGroupStep)
      group(g)->label = label;
  }
  void erase_group(GroupRef g) {
    group(group(g)->prev)->next = group(g)->next;  // the first group holds `first_`, never empty
    if (group(g)->next) group(group(g)->next)->prev = group(g)->prev;
    pool_.template drop<Group>(g);
  }

  P& pool_;
  StampRef first_;
};

std::uint64_t mixed(std::uint64_t x) {  // the finaliser of SplitMix64
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

template <class R>
class Trace {
 public:
  using P = Pool<typename R::Address>;
  using Call = typename R::Call;
  using Edge = typename R::Edge;
  using Mod = typename R::Mod;
  using Stamp = typename R::Stamp;
  using CallRef = typename P::template Ref<Call>;
  using EdgeRef = typename P::template Ref<Edge>;
  using ModRef = typename P::template Ref<Mod>;
  using StampRef = typename P::template Ref<Stamp>;

  Trace(P& pool, std::size_t mods, bool memo) : pool_(pool), time_(pool), memo_(memo) {
    for (std::size_t i = 0; i < mods; ++i) mods_.push_back(pool_.template make<Mod>());
    if (memo_) buckets_.resize(1024);
  }

  /// First run: true enters the next call, false leaves the innermost.
  std::vector<CallRef> run(const std::vector<char>& enters) {
    std::vector<CallRef> calls, open;
    calls.reserve(enters.size() / 2);
    StampRef now = time_.first();
    for (const char enter : enters) {
      if (enter) {
        open.push_back(make_call(now, calls.size()));
        calls.push_back(open.back());
        now = start(open.back());
      } else {
        now = finish(open.back(), now);
        open.pop_back();
      }
    }
    return calls;
  }

  bool precedes(CallRef a, CallRef b) const { return time_.precedes(start(a), start(b)); }

  /// Sum of the args of all calls that read or write what `c` reads or writes.
  std::uint64_t sum_of_neighbours(CallRef c) const {
    std::uint64_t sum = 0;
    for (EdgeRef e = call(c)->edges; e; e = edge(e)->next_in_call)
      for (EdgeRef f = mod(edge(e)->mod)->edges; f; f = edge(f)->next)
        sum += call(edge(f)->call)->args;
    return sum;
  }

  /// A new call with the same label in the place of `c`, then `c` is discarded.
  CallRef recreate(CallRef c) {
    CallRef fresh = make_call(start(c), call(c)->args);
    if (call(c)->end) call(fresh)->end = new_stamp_after(call(c)->end);
    discard(c);
    return fresh;
  }

  std::size_t memo_bytes() const { return buckets_.size() * sizeof(CallRef); }

 private:
  Call* call(CallRef r) const { return pool_.template at<Call>(r); }
  Edge* edge(EdgeRef r) const { return pool_.template at<Edge>(r); }
  Mod* mod(ModRef r) const { return pool_.template at<Mod>(r); }

  StampRef start(CallRef c) const {
    if constexpr (R::kEmbedded)
      return R::Address::template cast<Stamp>(c);
    else
      return call(c)->start;
  }
  StampRef new_stamp_after(StampRef where) {
    StampRef s = pool_.template make<Stamp>();
    time_.insert_after(where, s);
    return s;
  }

  CallRef make_call(StampRef where, std::uint64_t args) {
    CallRef c = pool_.template make<Call>();
    call(c)->function = &kFunction;
    call(c)->args = args;
    if constexpr (R::kEmbedded)
      time_.insert_after(where, start(c));
    else
      call(c)->start = new_stamp_after(where);
    if (memo_) remember(c);
    add_edge(c, mods_[args]);
    add_edge(c, mods_[args + 1]);
    return c;
  }
  StampRef finish(CallRef c, StampRef now) {
    if (R::kEmbedded && now == start(c)) return now;  // a leaf's end is itself
    return call(c)->end = new_stamp_after(now);
  }
  void discard(CallRef c) {
    for (EdgeRef e = call(c)->edges; e;) drop_edge(std::exchange(e, edge(e)->next_in_call));
    if (memo_) forget(c);
    if (call(c)->end) drop_stamp(call(c)->end);
    if constexpr (R::kEmbedded)
      time_.erase(start(c));
    else
      drop_stamp(start(c));
    pool_.template drop<Call>(c);
  }
  void drop_stamp(StampRef s) {
    time_.erase(s);
    pool_.template drop<Stamp>(s);
  }

  void add_edge(CallRef c, ModRef m) {
    EdgeRef e = pool_.template make<Edge>();
    Edge* x = edge(e);
    x->call = c;
    x->mod = m;
    x->next_in_call = std::exchange(call(c)->edges, e);
    x->next = std::exchange(mod(m)->edges, e);
    if (x->next) edge(x->next)->prev = e;
  }
  void drop_edge(EdgeRef e) {
    const Edge* x = edge(e);
    (x->prev ? edge(x->prev)->next : mod(x->mod)->edges) = x->next;
    if (x->next) edge(x->next)->prev = x->prev;
    pool_.template drop<Edge>(e);
  }

  /// B, C, D have the hash in the record; A makes it again from the args.
  std::uint32_t hash(CallRef c) const {
    if constexpr (R::kEmbedded)
      return call(c)->hash;
    else
      return static_cast<std::uint32_t>(mixed(call(c)->args));
  }
  CallRef& bucket(std::uint32_t hash) { return buckets_[hash & (buckets_.size() - 1)]; }
  void remember(CallRef c) {
    if constexpr (R::kEmbedded) call(c)->hash = static_cast<std::uint32_t>(mixed(call(c)->args));
    if (++remembered_ > buckets_.size()) grow_memo();
    equal_labels_ += find_equal(c);
    call(c)->memo_next = std::exchange(bucket(hash(c)), c);
  }
  bool find_equal(CallRef c) {
    for (CallRef d = bucket(hash(c)); d; d = call(d)->memo_next)
      if (hash(d) == hash(c) && call(d)->args == call(c)->args) return true;
    return false;
  }
  void forget(CallRef c) {
    CallRef* link = &bucket(hash(c));
    while (*link != c) link = &call(*link)->memo_next;
    *link = call(c)->memo_next;
    --remembered_;
  }
  void grow_memo() {
    std::vector<CallRef> old(buckets_.size() * 2);
    old.swap(buckets_);
    for (CallRef c : old)
      while (c) {
        CallRef next = call(c)->memo_next;
        call(c)->memo_next = std::exchange(bucket(hash(c)), c);
        c = next;
      }
  }

  P& pool_;
  Timeline<R> time_;
  bool memo_;
  std::vector<ModRef> mods_;
  std::vector<CallRef> buckets_;
  std::size_t remembered_ = 0, equal_labels_ = 0;
};

// ---- Workloads --------------------------------------------------------------------------------

struct Workload {
  std::size_t n;
  std::string shape;
  std::vector<char> enters;                                     // 2n, see Trace::run
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  // 2 * kOperations of call indices
};

void enter_tree(std::vector<char>& enters, std::size_t n) {
  if (n == 0) return;
  enters.push_back(true);
  enter_tree(enters, (n - 1) / 2);
  enter_tree(enters, n - 1 - (n - 1) / 2);
  enters.push_back(false);
}

/// leaves: no call has a child; tree: binary, half have; chain: all have, as in a tail loop.
Workload make_workload(std::size_t n, std::string_view shape) {
  Workload w{n, std::string(shape), {}, {}};
  if (shape == "tree") enter_tree(w.enters, n);
  for (std::size_t i = 0; shape != "tree" && i < 2 * n; ++i)
    w.enters.push_back(shape == "chain" ? i < n : i % 2 == 0);
  for (std::uint64_t i = 1; i <= 2 * kOperations; ++i) {
    const std::uint64_t r = mixed(i * 0x9e3779b97f4a7c15);
    w.pairs.emplace_back((r >> 32) % n, (r & 0xffffffff) % n);
  }
  return w;
}

double cpu_ns() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

/// (figure, unit, candidate) -> one value per round
using Samples = std::map<std::tuple<std::string, std::string, char>, std::vector<double>>;

template <class R>
class Round {
 public:
  Round(char candidate, const Workload& w, bool huge, Samples& samples)
      : candidate_(candidate), w_(w), pool_(huge), samples_(samples) {}

  /// Returns a checksum of every answer, equal for all candidates.
  std::uint64_t measure() {
    first_run("first_run", true);
    pool_.rewind();
    first_run("first_run_without_memo_touched_pages", false);
    pool_.rewind();
    first_run("first_run_touched_pages", true);
    account();
    queries("");
    timed("discard_recreate", kOperations, "ns", [&] {
      for (std::size_t i = 0; i < kOperations; ++i) {
        CallRef& c = calls_[w_.pairs[i].first];
        c = trace_->recreate(c);
      }
    });
    queries("_aged");
    return sum_;
  }

 private:
  using CallRef = typename Trace<R>::CallRef;

  template <class Body>
  void timed(const std::string& figure, std::size_t operations, const char* unit, Body body) {
    const double begin = cpu_ns();
    body();
    note(figure, unit, (cpu_ns() - begin) / static_cast<double>(operations));
  }
  void note(const std::string& figure, const char* unit, double value) {
    samples_[{figure, unit, candidate_}].push_back(value);
  }

  void first_run(const char* figure, bool memo) {
    trace_ = std::make_unique<Trace<R>>(pool_, w_.n + 1, memo);
    before_ = pool_.live_bytes();
    timed(figure, w_.n, "ns", [&] { calls_ = trace_->run(w_.enters); });
  }
  void account() {
    const double n = static_cast<double>(w_.n);
    note("bytes_per_call_with_two_edges", "B", static_cast<double>(pool_.live_bytes() - before_) / n);
    note("memo_bytes_per_call", "B", static_cast<double>(trace_->memo_bytes()) / n);
  }

  void queries(const std::string& suffix) {
    std::vector<std::pair<CallRef, CallRef>> pairs;
    for (auto [a, b] : w_.pairs) pairs.emplace_back(calls_[a], calls_[b]);
    timed("compare" + suffix, kOperations, "ns", [&] {
      for (std::size_t i = 0; i < kOperations; ++i)
        sum_ += trace_->precedes(pairs[i].first, pairs[i].second);
    });
    timed("compare_dependent" + suffix, kOperations, "ns", [&] {
      for (std::size_t i = 0, at = 0; i < kOperations; ++i)  // at < 2 * kOperations
        sum_ += at += trace_->precedes(pairs[at].first, pairs[at].second) + i % 2;
    });
    timed("walk_edges" + suffix, kOperations, "ns", [&] {
      for (std::size_t i = 0; i < kOperations; ++i)
        sum_ += trace_->sum_of_neighbours(pairs[i].first);
    });
  }

  char candidate_;
  const Workload& w_;
  Pool<typename R::Address> pool_;
  Samples& samples_;
  std::unique_ptr<Trace<R>> trace_;
  std::vector<CallRef> calls_;
  std::size_t before_ = 0;
  std::uint64_t sum_ = 0;
};

void run_round(const Workload& w, bool huge, Samples& samples) {
  const std::uint64_t a = Round<Separate>('A', w, huge, samples).measure();
  const std::uint64_t b = Round<Embedded<RangeHandles>>('B', w, huge, samples).measure();
  const std::uint64_t c = Round<Wide>('C', w, huge, samples).measure();
  const std::uint64_t d = Round<Embedded<ChunkHandles>>('D', w, huge, samples).measure();
  if (a != b || a != c || a != d) throw std::logic_error("the candidates disagree");
}

void print(const Workload& w, bool huge, Samples& samples) {
  for (auto& [key, values] : samples) {
    const auto& [figure, unit, candidate] = key;
    std::sort(values.begin(), values.end());
    std::printf("{\"bench\":\"representation\",\"figure\":\"%s\",\"candidate\":\"%c\","
                "\"shape\":\"%s\",\"n\":%zu,\"huge_pages\":%s,\"unit\":\"%s\","
                "\"median\":%.2f,\"min\":%.2f,\"max\":%.2f}\n",
                figure.c_str(), candidate, w.shape.c_str(), w.n, huge ? "true" : "false",
                unit.c_str(), values[values.size() / 2], values.front(), values.back());
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  bool huge = false;
  std::vector<std::size_t> sizes;
  for (const std::string_view arg : std::vector<std::string_view>(argv + 1, argv + argc))
    if (arg == "--huge")
      huge = true;
    else
      sizes.push_back(std::strtoull(arg.data(), nullptr, 10));
  if (sizes.empty()) sizes = {100'000, 1'000'000};
  for (const std::size_t n : sizes)
    for (const char* shape : {"leaves", "tree", "chain"}) {
      const Workload w = make_workload(n, shape);
      Samples samples;
      for (int i = 0; i < kRounds; ++i) run_round(w, huge, samples);
      print(w, huge, samples);
    }
}
