// A list that the client edits at any position from outside, and that traced functions process.
//
//   sac::Engine e;
//   sac::Sequence<int> numbers(e, {3, 1, 2});
//   const auto result = e.cell<sac::List<int>>();
//   e.run<sort_them>(numbers.list(), result);            // s.write(out, sac::sort<less>(s, in))
//   const sac::ElementId four = numbers.push_back(4);
//   numbers.insert_before(four, 0);
//   e.propagate();
//   for (const auto& element : e.get(result).view(e)) ...
//
// Guarantees:
// (1) An element has one id as long as it exists, which set() does not change. Ids count up and are
//     never reused.
// (2) An edit that throws leaves everything as before. Engine::undo_edits and failed propagations
//     undo edits.
// (3) An edit takes O(1) expected and invalidates the calls that have read one link.
// (4) The value of an erased element is destroyed at the end of the next propagation, and its
//     memory is then reused.
//
// A Sequence on a PlainScope is for programs that are generic over the scope; there all edits
// precede the run, and nothing is freed.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include "sac/check.hpp"
#include "sac/internal/same.hpp"
#include "sac/list/list.hpp"

namespace sac {

namespace detail {

// A hash table of entries by id, chained through the entries, so that erasing and reinserting
// cannot fail.
template <class Entry>
class EntryTable {
 public:
  /// Room for n entries. Throws: std::bad_alloc.
  void reserve(std::size_t n) {
    if (n <= chains_.size()) return;
    std::vector<Entry*> wider(std::bit_ceil(n + 15), nullptr);
    chains_.swap(wider);
    for (Entry* e : wider) {
      while (e != nullptr) insert(*std::exchange(e, e->chain));
    }
  }
  /// Requires: room.
  void insert(Entry& e) noexcept { e.chain = std::exchange(chain_of(e.id()), &e); }
  void erase(Entry& e) noexcept {
    Entry** link = &chain_of(e.id());
    while (*link != &e) link = &(*link)->chain;
    *link = e.chain;
  }
  [[nodiscard]] Entry* find(ElementId id) const noexcept {
    if (chains_.empty()) return nullptr;
    Entry* e = chains_[place_of(id)];
    while (e != nullptr && e->id() != id) e = e->chain;
    return e;
  }

 private:
  [[nodiscard]] std::size_t place_of(ElementId id) const noexcept {
    return mix(id.value) & (chains_.size() - 1);
  }
  [[nodiscard]] Entry*& chain_of(ElementId id) noexcept { return chains_[place_of(id)]; }

  std::vector<Entry*> chains_;  // a power of two of them
};

}  // namespace detail

/// A list of T that can be edited. Requires: copies of T are equal to their original; alignment of
/// T at most 8. Edits must be propagated or undone before the sequence is destroyed; its nodes live
/// as long as the host.
template <class T, class Host = Engine>
class Sequence {
 public:
  using S = ScopeOf<Host>;
  using Node = ListNode<T, S>;

  /// An element, for saving and loading a sequence.
  struct Saved {
    ElementId id;
    T value;
  };

  /// An empty sequence. Throws: UsageError if the engine runs; std::bad_alloc.
  explicit Sequence(Host& host) : host_(host) {
    create([] {});
  }
  Sequence(Host& host, std::initializer_list<T> values) : host_(host) {
    create([&] {
      for (const T& value : values) push_back(value);
    });
  }
  /// A sequence of these values, with ids from 1.
  template <std::ranges::input_range Range>
  requires std::convertible_to<std::ranges::range_reference_t<Range>, T> Sequence(Host& host,
                                                                                  Range&& values)
      : host_(host) {
    create([&] {
      for (auto&& value : values) push_back(std::forward<decltype(value)>(value));
    });
  }
  /// A sequence of these elements; new elements get ids above the greatest. Throws: UsageError if
  /// an id is 0, above 2^63, or occurs twice.
  Sequence(Host& host, const std::vector<Saved>& elements) : host_(host) {
    create([&] {
      for (const Saved& saved : elements) {
        if (saved.id.value == 0 || saved.id.value > kLastId || contains(saved.id)) {
          throw UsageError("sequence: an element's id is 0, above 2^63, or another's: " +
                           text(saved.id));
        }
        insert_behind(*header_->before, saved.id, saved.value);
        if (last_id_ < saved.id.value) last_id_ = saved.id.value;
      }
    });
  }
  Sequence(const Sequence&) = delete;
  Sequence& operator=(const Sequence&) = delete;

  /// The list for programs.
  [[nodiscard]] List<T, S> list() const noexcept { return List<T, S>(*header_); }

  // --- Edits -------------------------------------------------------------------------------
  // All of them throw: UsageError if there is no such element or the engine runs; std::bad_alloc;
  // exceptions of copying a T.

  ElementId push_back(T value) { return insert_new(*header_->before, std::move(value)); }
  ElementId push_front(T value) { return insert_new(*header_, std::move(value)); }
  ElementId insert_before(ElementId place, T value) {
    return insert_new(*entry(place).before, std::move(value));
  }
  ElementId insert_after(ElementId place, T value) {
    return insert_new(entry(place), std::move(value));
  }
  void erase(ElementId id) { erase_entry(entry(id)); }
  /// Sets the value of an element; the same value changes nothing (equality as in mod.hpp).
  void set(ElementId id, T value) {
    Entry& old = entry(id);
    if constexpr (std::equality_comparable<T>) {
      if (detail::identical(old.value(), value)) return;
    }
    together([&] {
      erase_entry(old);
      insert_behind(*old.before, id, std::move(value));
    });
  }

  // --- Queries -----------------------------------------------------------------------------

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] bool contains(ElementId id) const noexcept { return table_.find(id) != nullptr; }
  /// The value of an element; valid until the element is erased or set. Throws: UsageError.
  [[nodiscard]] const T& at(ElementId id) const { return entry(id).value(); }
  /// Neighbours and ends; 0 if there is none. Throws: UsageError.
  [[nodiscard]] ElementId before(ElementId id) const { return entry(id).before->id(); }
  [[nodiscard]] ElementId after(ElementId id) const { return entry(id).after->id(); }
  [[nodiscard]] ElementId first() const noexcept { return header_->after->id(); }
  [[nodiscard]] ElementId last() const noexcept { return header_->before->id(); }

  class iterator;
  /// Nodes, each with id() and value(). An edit invalidates the iterators to nodes that it removes.
  [[nodiscard]] iterator begin() const noexcept { return iterator(header_->after); }
  [[nodiscard]] iterator end() const noexcept { return iterator(header_); }

  /// Throws: InvariantError. Cost: O(size).
  void check_invariants() const;

 private:
  // A node with its neighbours; the header closes the circle. An unused entry has its successor in
  // `after`; an erased entry keeps its neighbours, for undoing.
  struct Entry : Node {
    Entry* before = this;
    Entry* after = this;
    Entry* chain = nullptr;  // in the table
  };

  static std::string text(ElementId id) { return '#' + std::to_string(id.value); }
  [[nodiscard]] Entry& entry(ElementId id) const {
    if (Entry* e = table_.find(id)) return *e;
    throw UsageError("sequence: there is no element " + text(id));
  }
  // The node that programs see behind `e`.
  [[nodiscard]] const Node* link_behind(const Entry& e) const noexcept {
    return e.after == header_ ? nullptr : e.after;
  }

  template <class Body>
  void together(Body&& body) {
    if constexpr (S::kTraced) {
      host_.edit_together(body);
    } else {
      body();
    }
  }
  void on_rollback([[maybe_unused]] auto undo) {
    if constexpr (S::kTraced) host_.on_rollback(undo);
  }

  template <class Fill>
  void create(Fill&& fill) {
    together([&] {
      header_ = &host_.template make<Entry>();
      host_.set(header_->next, static_cast<const Node*>(nullptr));
      fill();
    });
  }

  ElementId insert_new(Entry& before, T value) {
    const ElementId id{last_id_ + 1};
    insert_behind(before, id, std::move(value));
    last_id_ = id.value;
    return id;
  }

  // An unused entry; it remains the first of them.
  Entry& unused_entry() {
    if (unused_ == nullptr) {
      unused_ = &host_.template make<Entry>();
      unused_->after = nullptr;
    }
    return *unused_;
  }

  void insert_behind(Entry& before, ElementId id, T value) {
    together([&] {
      table_.reserve(size_ + 1);
      Entry& e = unused_entry();
      e.hold(id, std::move(value));
      on_rollback([this, &e] { undo_insertion(e); });
      unused_ = e.after;
      put_in(e, before);
      set_link(e, link_behind(e));
      set_link(before, &e);
    });
  }

  // Sets a link of the header or of an entry; who does it has recorded how to undo it. One record
  // for each insertion: many are made before a first run.
  void set_link(const Entry& from, const Node* to) {
    if constexpr (S::kTraced) {
      host_.set_unrecorded(from.next, to);
    } else {
      host_.set(from.next, to);
    }
  }
  void undo_insertion(Entry& e) {
    if constexpr (S::kTraced) {
      host_.set_unrecorded(e.before->next, link_behind(e));
      host_.unset_unrecorded(e.next);
    }
    take_out(e);
    e.after = std::exchange(unused_, &e);
  }

  void erase_entry(Entry& e) {
    together([&] {
      on_rollback([this, &e] { put_in(e, *e.before); });
      take_out(e);
      host_.set(e.before->next, link_behind(e));
      if constexpr (S::kTraced) host_.release(e);
    });
  }

  void put_in(Entry& e, Entry& before) noexcept {
    e.before = &before;
    e.after = std::exchange(before.after, &e);
    e.after->before = &e;
    table_.insert(e);
    ++size_;
  }
  void take_out(Entry& e) noexcept {
    e.before->after = e.after;
    e.after->before = e.before;
    table_.erase(e);
    --size_;
  }

  Host& host_;
  Entry* header_ = nullptr;
  Entry* unused_ = nullptr;  // from insertions that have been undone
  detail::EntryTable<Entry> table_;
  std::size_t size_ = 0;
  static constexpr std::uint64_t kLastId = std::uint64_t{1} << 63;  // of saved elements: new ones
                                                                    // have room behind it
  std::uint64_t last_id_ = 0;
};

template <class T, class Host>
class Sequence<T, Host>::iterator {
 public:
  using value_type = Node;
  using difference_type = std::ptrdiff_t;
  iterator() = default;
  [[nodiscard]] const Node& operator*() const noexcept { return *at_; }
  [[nodiscard]] const Node* operator->() const noexcept { return at_; }
  iterator& operator++() noexcept {
    at_ = at_->after;
    return *this;
  }
  iterator operator++(int) noexcept { return iterator(std::exchange(at_, at_->after)); }
  iterator& operator--() noexcept {
    at_ = at_->before;
    return *this;
  }
  iterator operator--(int) noexcept { return iterator(std::exchange(at_, at_->before)); }
  friend bool operator==(const iterator&, const iterator&) = default;

 private:
  friend class Sequence;
  explicit iterator(const Entry* at) noexcept : at_(at) {}
  const Entry* at_ = nullptr;
};

template <class T, class Host>
void Sequence<T, Host>::check_invariants() const {
  std::size_t count = 0;
  for (const Entry* e = header_->after; e != header_; e = e->after) {
    SAC_INVARIANT(e->before->after == e && e->after->before == e);
    SAC_INVARIANT(e->holds() && e->id().value <= last_id_ && table_.find(e->id()) == e);
    SAC_INVARIANT(host_.get(e->before->next) == e);
    ++count;
  }
  SAC_INVARIANT(host_.get(header_->before->next) == nullptr && !header_->holds());
  SAC_INVARIANT(count == size_);
}

}  // namespace sac
