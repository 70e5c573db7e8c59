// A sorted index: the posted calls of an agenda, the versions of a modifiable, the readers of a
// version, the calls of one label. A B+-tree whose single leaf, while entries are few, is a small
// array that grows by doubling.
//
// Entries are plain data; the caller gives their order with every search: `before(a, b)`. It is
// called for existing entries and the one searched for. If it throws, or memory runs out, the
// entries are as before.
//
// A leaf has entries. A node above has children, and beside each a copy of the first entry below
// it: a search reads only entries, at every height. Nodes with no room are divided on the way down,
// so that there is always room for one more above.
//
// Guarantees:
// (1) insert, erase, and searches take O(log n) comparisons and moves, wherever the entry lies.
// (2) append takes O(1) amortised, and calls no comparison.
// (3) Memory is proportional to the number of entries: neighbours with few entries are merged.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

namespace sac {

template <class Entry>
class SortedIndex {
  static_assert(std::is_trivially_copyable_v<Entry>);

 public:
  SortedIndex() = default;
  SortedIndex(SortedIndex&& other) noexcept
      : root_(std::exchange(other.root_, nullptr)), size_(std::exchange(other.size_, 0)) {}
  SortedIndex& operator=(SortedIndex&& other) noexcept {
    std::swap(root_, other.root_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~SortedIndex() { clear(); }

  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Requires: not empty.
  [[nodiscard]] const Entry& first() const noexcept { return entries(root_)[0]; }
  [[nodiscard]] const Entry& last() const noexcept {
    const Node* const leaf = last_leaf();
    return entries(leaf)[leaf->count - 1];
  }

  /// Adds an entry behind all others. Requires: it belongs there. Throws: std::bad_alloc.
  void append(const Entry& entry) {
    put(entry, kFill + kMoved, kFill, [](const Node& node) { return node.count; });
  }
  /// Throws: std::bad_alloc, and what `before` throws.
  template <class Before>
  void insert(const Entry& entry, Before&& before) {
    put(entry, kCapacity, kCapacity / 2,
        [&](const Node& node) { return position(node, entry, before); });
  }
  /// Requires: the entry is there.
  template <class Before>
  void erase(const Entry& entry, Before&& before) {
    take([&](const Node& node) { return position(node, entry, before) - 1; });
  }
  /// Takes out the first entry for which `is_it`, looking at all: for where `before` fails.
  /// Requires: it is there. Cost: O(n).
  template <class IsIt>
  void erase_if(IsIt&& is_it) noexcept {
    take([&](const Node& node) {
      std::uint32_t i = 0;
      while (node.height > 0 ? !any_below(children(&node)[i], is_it) : !is_it(entries(&node)[i])) {
        ++i;
      }
      return i;
    });
  }
  /// Takes out the first entry. Requires: not empty.
  Entry pop_first() noexcept {
    const Entry entry = first();
    take([](const Node&) { return 0u; });
    return entry;
  }
  void clear() noexcept {
    if (root_ != nullptr) free_tree(std::exchange(root_, nullptr));
    size_ = 0;
  }

  /// What a probe lies between: an entry, which may be there or not, or something else of which
  /// `before(probe, entry)` tells whether it comes before an entry. Null: nothing. Valid until a
  /// change.
  struct Place {
    const Entry* before = nullptr;  // the last that does not come behind it
    const Entry* behind = nullptr;  // the first that does
  };
  template <class Probe, class Before>
  [[nodiscard]] Place place_of(const Probe& probe, Before&& before) const {
    Place place;
    for (const Node* node = root_; node != nullptr;) {
      const std::uint32_t i = position(*node, probe, before);
      if (i > 0) place.before = entries(node) + i - 1;
      if (i < node->count) place.behind = entries(node) + i;
      node = node->height > 0 ? children(node)[i > 0 ? i - 1 : 0] : nullptr;
    }
    return place;
  }
  /// The last entry that comes before `entry`; null if there is none.
  template <class Before>
  [[nodiscard]] const Entry* predecessor(const Entry& entry, Before&& before) const {
    return place_of(entry, [&](const Entry& a, const Entry& b) { return !before(b, a); }).before;
  }
  /// The first entries that come behind `entry`, as many as lie together; empty: there are none.
  /// Valid until a change.
  template <class Before>
  [[nodiscard]] std::span<const Entry> behind(const Entry& entry, Before&& before) const {
    const Node* next = nullptr;  // what comes behind the node
    const Node* node = root_;
    while (node != nullptr && node->height > 0) {
      const std::uint32_t i = position(*node, entry, before);
      if (i < node->count) next = children(node)[i];
      node = children(node)[i > 0 ? i - 1 : 0];
    }
    const std::uint32_t i = node != nullptr ? position(*node, entry, before) : 0;
    return node != nullptr && i < node->count ? rest(node, i) : first_of(next);
  }
  /// The same for the first entries of all.
  [[nodiscard]] std::span<const Entry> front() const noexcept { return first_of(root_); }

  /// The last n entries, if they lie together; else empty. Requires: not empty.
  [[nodiscard]] std::span<const Entry> back(std::size_t n) const noexcept {
    const Node* const leaf = last_leaf();
    if (n > leaf->count) return {};
    return rest(leaf, leaf->count - static_cast<std::uint32_t>(n));
  }

  template <class Visit>
  void for_each(Visit&& visit) const {
    for_each_node(root_, [&](const Node* node) {
      if (node->height == 0) std::for_each(entries(node), entries(node) + node->count, visit);
    });
  }

  /// Beside the object itself. Cost: O(n / 30).
  [[nodiscard]] std::size_t bytes() const noexcept {
    std::size_t total = 0;
    for_each_node(root_,
                  [&](const Node* node) { total += bytes_of(node->height, node->capacity); });
    return total;
  }

 private:
  static constexpr std::uint32_t kFirst = 4;  // entries of a new index
  static constexpr std::uint32_t kCapacity = 32;
  static constexpr std::uint32_t kFill = 28;   // appending leaves room for the edits to come
  static constexpr std::uint32_t kMoved = 2;   // and begins a node with so many of the last one
  static constexpr std::uint32_t kMerge = 20;  // neighbours of so few in all become one

  // Its entries lie behind, then, above the leaves, its children: at least 2, with room for one
  // more than it ever has, but while neighbours are made equal.
  struct Node {
    std::uint16_t count = 0;
    std::uint16_t capacity = 0;
    std::uint32_t height = 0;  // 0: a leaf
  };
  static constexpr std::size_t kEntries = std::max(sizeof(Node), alignof(Entry));
  static constexpr std::size_t kChildren =
      (kEntries + (kCapacity + 1) * sizeof(Entry) + alignof(Node*) - 1) / alignof(Node*) *
      alignof(Node*);

  static Entry* entries(const Node* node) noexcept {
    return reinterpret_cast<Entry*>(reinterpret_cast<std::uintptr_t>(node) + kEntries);
  }
  static Node** children(const Node* node) noexcept {
    return reinterpret_cast<Node**>(reinterpret_cast<std::uintptr_t>(node) + kChildren);
  }
  static std::size_t bytes_of(std::uint32_t height, std::uint32_t capacity) noexcept {
    return height > 0 ? kChildren + (kCapacity + 1) * sizeof(Node*)
                      : kEntries + capacity * sizeof(Entry);
  }
  static Node* new_node(std::uint32_t height, std::uint32_t capacity) {
    return ::new (::operator new(bytes_of(height, capacity)))
        Node{0, static_cast<std::uint16_t>(capacity), height};
  }
  static void free_tree(Node* node) noexcept {
    for (std::uint32_t i = 0; node->height > 0 && i < node->count; ++i) {
      free_tree(children(node)[i]);
    }
    ::operator delete(node);
  }

  // --- Searching

  // The number of entries of `node` that are not behind the probe.
  template <class Probe, class Before>
  static std::uint32_t position(const Node& node, const Probe& probe, Before& before) {
    const Entry* const begin = entries(&node);
    return static_cast<std::uint32_t>(std::upper_bound(begin, begin + node.count, probe, before) -
                                      begin);
  }
  [[nodiscard]] const Node* last_leaf() const noexcept {
    const Node* node = root_;
    while (node->height > 0) node = children(node)[node->count - 1];
    return node;
  }
  static std::span<const Entry> rest(const Node* leaf, std::uint32_t i) noexcept {
    return {entries(leaf) + i, entries(leaf) + leaf->count};
  }
  static std::span<const Entry> first_of(const Node* node) noexcept {
    while (node != nullptr && node->height > 0) node = children(node)[0];
    return node != nullptr ? rest(node, 0) : std::span<const Entry>();
  }
  template <class Visit>
  static void for_each_node(const Node* node, Visit&& visit) {
    if (node == nullptr) return;
    visit(node);
    for (std::uint32_t i = 0; node->height > 0 && i < node->count; ++i) {
      for_each_node(children(node)[i], visit);
    }
  }
  template <class IsIt>
  static bool any_below(const Node* node, IsIt& is_it) {
    if (node->height == 0) return std::any_of(entries(node), entries(node) + node->count, is_it);
    return std::any_of(children(node), children(node) + node->count,
                       [&](const Node* child) { return any_below(child, is_it); });
  }

  // --- Changing nodes

  static void insert_at(Node* node, std::uint32_t i, const Entry& entry, Node* child) noexcept {
    const auto open = [&](auto* column, auto value) {
      std::copy_backward(column + i, column + node->count, column + node->count + 1);
      column[i] = value;
    };
    open(entries(node), entry);
    if (node->height > 0) open(children(node), child);
    ++node->count;
  }
  static void remove_at(Node* node, std::uint32_t i) noexcept {
    const auto close = [&](auto* column) {
      std::copy(column + i + 1, column + node->count, column + i);
    };
    close(entries(node));
    if (node->height > 0) close(children(node));
    --node->count;
  }
  // Appends what `from` has from its entry `first` on to `to`.
  static void move(Node* from, std::uint32_t first, Node* to) noexcept {
    const auto move_column = [&](auto* source, auto* target) {
      std::copy(source + first, source + from->count, target + to->count);
    };
    move_column(entries(from), entries(to));
    if (from->height > 0) move_column(children(from), children(to));
    to->count = static_cast<std::uint16_t>(to->count + from->count - first);
    from->count = static_cast<std::uint16_t>(first);
  }

  // --- Adding

  // A node of `full` entries keeps `kept` of them before one more goes into it or below it.
  // `place(node)` is the number of its entries that are not behind the new one.
  template <class PlaceIn>
  void put(const Entry& entry, std::uint32_t full, std::uint32_t kept, PlaceIn&& place) {
    raise_root(full);
    Node* node = root_;
    std::uint32_t i = place(*node);
    while (node->height > 0) {
      const std::uint32_t child = i > 0 ? i - 1 : 0;
      if (children(node)[child]->count >= full) {
        divide(node, child, kept);
        i = place(*node);
        continue;
      }
      node = children(node)[child];
      i = place(*node);
    }
    insert_at(node, i, entry, nullptr);
    ++size_;
    if (i > 0) return;
    for (node = root_; node->height > 0; node = children(node)[0]) entries(node)[0] = entry;
  }
  // Makes a root with room.
  void raise_root(std::uint32_t full) {
    if (root_ == nullptr) root_ = new_node(0, kFirst);
    if (root_->count < std::min<std::uint32_t>(root_->capacity, full)) return;
    const bool grows = root_->capacity < kCapacity;
    Node* const larger =
        grows ? new_node(0, 2 * root_->capacity) : new_node(root_->height + 1, kCapacity);
    if (grows) {
      move(root_, 0, larger);
      ::operator delete(root_);
    } else {
      insert_at(larger, 0, entries(root_)[0], root_);
    }
    root_ = larger;
  }
  static void divide(Node* parent, std::uint32_t i, std::uint32_t kept) {
    Node* const left = children(parent)[i];
    Node* const right = new_node(left->height, kCapacity);
    move(left, kept, right);
    insert_at(parent, i + 1, entries(right)[0], right);
  }

  // --- Taking out

  // `choose(node)` is the number of the child to go to, and of the entry in the leaf.
  template <class Choose>
  void take(Choose&& choose) {
    take_below(root_, choose);
    --size_;
    while (root_->height > 0 && root_->count == 1) {
      ::operator delete(std::exchange(root_, children(root_)[0]));
    }
    if (size_ == 0) clear();
  }
  template <class Choose>
  static void take_below(Node* node, Choose& choose) {
    const std::uint32_t i = choose(*node);
    if (node->height == 0) return remove_at(node, i);
    take_below(children(node)[i], choose);
    if (node->count > 1) tend(node, i);
    entries(node)[0] = entries(children(node)[0])[0];
  }
  // Something is gone below child i: it and one beside it become one if they are small, or alike
  // if it is too small.
  static void tend(Node* node, std::uint32_t i) noexcept {
    Node** const child = children(node);
    const auto few = [&](std::uint32_t left) {
      return child[left]->count + child[left + 1]->count <= static_cast<int>(kMerge);
    };
    const std::uint32_t at = i > 0 && (i + 1 == node->count || few(i - 1)) ? i - 1 : i;
    Node* const left = child[at];
    Node* const right = child[at + 1];
    if (few(at)) {
      move(right, 0, left);
      ::operator delete(right);
      remove_at(node, at + 1);
    } else if (child[i]->count <= (left->height > 0 ? 1 : 0)) {
      move(right, 0, left);
      move(left, left->count / 2, right);
      entries(node)[at + 1] = entries(right)[0];
    } else {
      entries(node)[i] = entries(child[i])[0];
    }
    entries(node)[at] = entries(left)[0];
  }

  Node* root_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace sac
