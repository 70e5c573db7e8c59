// Pool, timeline and trace of representation_bench: the same text for every candidate.
//
// `R` is one of the record sets of representation_records.hpp. The candidates differ here in two
// things: whether a start stamp is part of its call (`R::kEmbedded`), and whether a hash is kept.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <utility>
#include <vector>

#include "representation_records.hpp"

namespace representation {

constexpr std::size_t kLargestBlock = 128;

template <class Address>
class Pool {
 public:
  template <class T>
  using Ref = typename Address::template Ref<T>;
  explicit Pool(bool huge) : address_(huge) {}

  template <class T>
  T* at(Ref<T> r) const {
    return address_.at(r);
  }

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
    const bool alone =
        stamp(x->prev)->group != x->group && (!x->next || stamp(x->next)->group != x->group);
    if (alone) erase_group(x->group);
  }

 private:
  using Label = decltype(Stamp::label);
  static constexpr Label kLast = std::numeric_limits<Label>::max();
  static constexpr Label kStep = kLast / 1024;             // 1024 appends fill a group
  static constexpr std::uint64_t kGroupStep = 1ull << 40;  // 2^24 groups appended
  static constexpr unsigned kSplitRun = 64;                // stamps in a group after a split

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

inline std::uint64_t mixed(std::uint64_t x) {  // the finaliser of SplitMix64
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

  /// The same over the later calls alone: whom a write of `c` would invalidate.
  std::uint64_t sum_of_later_neighbours(CallRef c) const {
    std::uint64_t sum = 0;
    for (EdgeRef e = call(c)->edges; e; e = edge(e)->next_in_call)
      for (EdgeRef f = mod(edge(e)->mod)->edges; f; f = edge(f)->next)
        if (precedes(c, edge(f)->call)) sum += call(edge(f)->call)->args;
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

}  // namespace representation
