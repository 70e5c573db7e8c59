// A sorted index: the posted calls of an agenda, the versions of a modifiable, the readers of a
// version, the calls of one label. A B+-tree whose single leaf, while entries are few, is a small
// array that grows by doubling.
//
// Entries are plain data; the caller gives their order with every search: `before(a, b)`. It is
// called for existing entries and the one searched for. If it throws, or memory runs out, nothing
// is changed.
//
// Guarantees:
// (1) insert, erase, and searches take O(log n) comparisons and moves, wherever the entry lies.
// (2) append takes O(1) amortised, and calls no comparison.
// (3) Memory is proportional to the number of entries: neighbours with few entries are merged.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace sac {

template <class Entry>
class SortedIndex {
  static_assert(std::is_trivially_copyable_v<Entry>);

 public:
  SortedIndex() = default;
  SortedIndex(SortedIndex&& other) noexcept
      : root_(std::exchange(other.root_, nullptr)),
        size_(std::exchange(other.size_, 0)),
        height_(std::exchange(other.height_, 0)) {}
  SortedIndex& operator=(SortedIndex&& other) noexcept {
    std::swap(root_, other.root_);
    std::swap(size_, other.size_);
    std::swap(height_, other.height_);
    return *this;
  }
  ~SortedIndex() { clear(); }

  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Requires: not empty.
  [[nodiscard]] const Entry& first() const noexcept { return entries(leaf_at_end(false))[0]; }
  [[nodiscard]] const Entry& last() const noexcept {
    const Node* leaf = leaf_at_end(true);
    return entries(leaf)[leaf->count - 1];
  }

  /// Adds an entry behind all others. Requires: it belongs there. Throws: std::bad_alloc.
  void append(const Entry& entry) {
    Path path;
    Node* leaf = descend(path, [](const Inner& node) { return node.count - 1; });
    put(path, leaf, leaf != nullptr ? leaf->count : 0, entry, true);
  }
  /// Throws: std::bad_alloc, and what `before` throws.
  template <class Before>
  void insert(const Entry& entry, Before&& before) {
    Path path;
    Node* leaf = find_leaf(path, entry, before);
    put(path, leaf, leaf != nullptr ? position(leaf, entry, before) : 0, entry, false);
  }
  /// Requires: the entry is there.
  template <class Before>
  void erase(const Entry& entry, Before&& before) {
    Path path;
    Node* leaf = find_leaf(path, entry, before);
    take(path, leaf, position(leaf, entry, before) - 1);
  }
  /// Takes out the first entry for which `is_it`, looking at all: for where `before` fails.
  /// Requires: it is there. Cost: O(n).
  template <class IsIt>
  void erase_if(IsIt&& is_it) noexcept {
    Path path;
    Node* leaf = descend(path, [](const Inner&) { return 0u; });
    for (;; leaf = next_leaf(path)) {
      const Entry* const end = entries(leaf) + leaf->count;
      const Entry* const found = std::find_if(entries(leaf), const_cast<Entry*>(end), is_it);
      if (found != end) return take(path, leaf, static_cast<std::uint32_t>(found - entries(leaf)));
    }
  }
  /// Takes out the first entry. Requires: not empty.
  Entry pop_first() noexcept {
    Path path;
    Node* leaf = descend(path, [](const Inner&) { return 0u; });
    const Entry entry = entries(leaf)[0];
    take(path, leaf, 0);
    return entry;
  }
  void clear() noexcept {
    if (root_ != nullptr) free_tree(root_, height_);
    root_ = nullptr;
    size_ = height_ = 0;
  }

  /// What an entry, which may be there or not, lies between; null: nothing.
  struct Place {
    const Entry* before = nullptr;  // the last that does not come behind it
    const Entry* behind = nullptr;  // the first that does
  };
  template <class Before>
  [[nodiscard]] Place place_of(const Entry& entry, Before&& before) const {
    Path path;
    Node* leaf = const_cast<SortedIndex*>(this)->find_leaf(path, entry, before);
    if (leaf == nullptr) return {};
    const std::uint32_t i = position(leaf, entry, before);
    Place place;
    if (i > 0) place.before = entries(leaf) + i - 1;
    if (i < leaf->count) {
      place.behind = entries(leaf) + i;
    } else if (const Node* next = next_leaf(path); next != nullptr) {
      place.behind = entries(next);
    }
    return place;
  }
  /// The last entry that comes before `entry`; null if there is none.
  template <class Before>
  [[nodiscard]] const Entry* predecessor(const Entry& entry, Before&& before) const {
    Path path;
    const auto not_before = [&](const Entry& a, const Entry& b) { return !before(b, a); };
    const Node* leaf = const_cast<SortedIndex*>(this)->find_leaf(path, entry, not_before);
    if (leaf == nullptr) return nullptr;
    const std::uint32_t i = position(leaf, entry, not_before);
    return i > 0 ? entries(leaf) + i - 1 : nullptr;
  }

  template <class Visit>
  void for_each(Visit&& visit) const {
    for_each_node([&](const Node* node, std::uint32_t height) {
      if (height == 0) std::for_each(entries(node), entries(node) + node->count, visit);
    });
  }

  /// Beside the object itself. Cost: O(n / 30).
  [[nodiscard]] std::size_t bytes() const noexcept {
    std::size_t total = 0;
    for_each_node([&](const Node* node, std::uint32_t height) {
      total += height == 0 ? kEntries + node->capacity * sizeof(Entry) : sizeof(Inner);
    });
    return total;
  }

 private:
  static constexpr std::uint32_t kFirst = 4;  // entries of a new index
  static constexpr std::uint32_t kCapacity = 32;
  static constexpr std::uint32_t kFill = 28;   // appending leaves room for the edits to come
  static constexpr std::uint32_t kMerge = 20;  // neighbours of so few in all become one
  // Two neighbours have more than kMerge together: 2^32 entries need 10 levels at most.
  static constexpr std::size_t kMostLevels = 12;

  struct Node {
    std::uint32_t count = 0;
    std::uint32_t capacity = 0;
  };
  struct Inner : Node {
    std::array<Entry, kCapacity> firsts;  // the first entry below each child
    std::array<Node*, kCapacity> children;
  };
  // A leaf is a Node with its entries behind it.
  static constexpr std::size_t kEntries =
      (sizeof(Node) + alignof(Entry) - 1) / alignof(Entry) * alignof(Entry);
  static Entry* entries(Node* leaf) noexcept {
    return reinterpret_cast<Entry*>(reinterpret_cast<std::byte*>(leaf) + kEntries);
  }
  static const Entry* entries(const Node* leaf) noexcept {
    return entries(const_cast<Node*>(leaf));
  }

  struct Step {
    Inner* node;
    std::uint32_t child;
  };
  struct Path {  // from the root to the node above a leaf
    std::array<Step, kMostLevels> steps;
    std::uint32_t depth = 0;
  };

  static Node* new_leaf(std::uint32_t capacity) {
    void* const memory = ::operator new(kEntries + capacity * sizeof(Entry));
    return ::new (memory) Node{0, capacity};
  }
  static void free_leaf(Node* leaf) noexcept { ::operator delete(leaf); }
  static void free_tree(Node* node, std::uint32_t height) noexcept {
    if (height == 0) return free_leaf(node);
    auto* const inner = static_cast<Inner*>(node);
    for (std::uint32_t i = 0; i < inner->count; ++i) free_tree(inner->children[i], height - 1);
    delete inner;
  }

  // --- Searching

  template <class Choose>
  Node* descend(Path& path, Choose&& choose) const {
    Node* node = root_;
    for (std::uint32_t h = height_; h > 0; --h) {
      auto* const inner = static_cast<Inner*>(node);
      const std::uint32_t child = choose(*inner);
      path.steps[path.depth++] = {inner, child};
      node = inner->children[child];
    }
    return node;
  }
  template <class Before>
  Node* find_leaf(Path& path, const Entry& entry, Before& before) {
    return descend(path, [&](const Inner& node) {
      const Entry* const begin = node.firsts.data();
      const Entry* const behind = std::upper_bound(begin + 1, begin + node.count, entry, before);
      return static_cast<std::uint32_t>(behind - begin) - 1;
    });
  }
  // The number of entries of `leaf` that are not behind `entry`.
  template <class Before>
  static std::uint32_t position(const Node* leaf, const Entry& entry, Before& before) {
    const Entry* const begin = entries(leaf);
    return static_cast<std::uint32_t>(std::upper_bound(begin, begin + leaf->count, entry, before) -
                                      begin);
  }
  // The leaf behind the one that `path` leads to, and the path to it; null if that is the last.
  static Node* next_leaf(Path& path) noexcept {
    std::uint32_t up = path.depth;
    while (up > 0 && path.steps[up - 1].child + 1 == path.steps[up - 1].node->count) --up;
    if (up == 0) return nullptr;
    Node* node = path.steps[up - 1].node->children[++path.steps[up - 1].child];
    for (; up < path.depth; ++up) {
      path.steps[up] = {static_cast<Inner*>(node), 0};
      node = path.steps[up].node->children[0];
    }
    return node;
  }
  [[nodiscard]] const Node* leaf_at_end(bool last) const noexcept {
    Path path;
    return descend(path, [last](const Inner& node) { return last ? node.count - 1 : 0u; });
  }
  template <class Visit>
  void for_each_node(Visit&& visit) const {
    if (root_ != nullptr) for_each_node_of(root_, height_, visit);
  }
  template <class Visit>
  static void for_each_node_of(const Node* node, std::uint32_t height, Visit& visit) {
    visit(node, height);
    if (height == 0) return;
    const auto* const inner = static_cast<const Inner*>(node);
    for (std::uint32_t i = 0; i < inner->count; ++i) {
      for_each_node_of(inner->children[i], height - 1, visit);
    }
  }

  // --- Adding

  void put(Path& path, Node* leaf, std::uint32_t i, const Entry& entry, bool at_end) {
    if (leaf == nullptr) leaf = root_ = new_leaf(kFirst);
    if (leaf->count == leaf->capacity && leaf->capacity < kCapacity) leaf = grow_root_leaf();
    if (leaf->count == kCapacity || (at_end && leaf->count >= kFill)) {
      return put_in_halves(path, leaf, i, entry, at_end);
    }
    insert_at(leaf, i, entry);
    ++size_;
    if (i == 0) first_changed(path, entry);
  }
  static void insert_at(Node* leaf, std::uint32_t i, const Entry& entry) noexcept {
    Entry* const begin = entries(leaf);
    std::copy_backward(begin + i, begin + leaf->count, begin + leaf->count + 1);
    begin[i] = entry;
    ++leaf->count;
  }
  Node* grow_root_leaf() {
    Node* const larger = new_leaf(2 * root_->capacity);
    std::copy(entries(root_), entries(root_) + root_->count, entries(larger));
    larger->count = root_->count;
    free_leaf(std::exchange(root_, larger));
    return larger;
  }

  // Room for what a split needs, taken before anything changes.
  struct Spares {
    std::array<std::unique_ptr<Inner>, kMostLevels> inner;
    std::size_t count = 0;
    Inner* take() noexcept { return inner[--count].release(); }
  };
  void reserve_splits(const Path& path, Spares& spares) const {
    std::uint32_t d = path.depth;
    for (; d > 0 && path.steps[d - 1].node->count == kCapacity; --d) {
      spares.inner[spares.count++] = std::make_unique<Inner>();
    }
    if (d == 0) spares.inner[spares.count++] = std::make_unique<Inner>();  // a new root
  }

  // `leaf` is full: half of it goes to a new one behind it, or nothing at the end of all.
  void put_in_halves(Path& path, Node* leaf, std::uint32_t i, const Entry& entry, bool at_end) {
    Spares spares;
    reserve_splits(path, spares);
    Node* const right = new_leaf(kCapacity);
    const std::uint32_t kept = at_end ? leaf->count : leaf->count / 2;
    std::copy(entries(leaf) + kept, entries(leaf) + leaf->count, entries(right));
    right->count = leaf->count - kept;
    leaf->count = kept;
    const bool goes_right = i > kept || at_end;
    insert_at(goes_right ? right : leaf, goes_right ? i - kept : i, entry);
    ++size_;
    if (i == 0) first_changed(path, entry);
    add_child(path, entries(right)[0], right, spares, at_end);
  }

  // Puts `child` behind the node that `path` leads to.
  void add_child(Path& path, Entry first, Node* child, Spares& spares, bool at_end) noexcept {
    while (path.depth > 0) {
      auto [node, i] = path.steps[--path.depth];
      if (node->count < kCapacity) return insert_child(*node, i + 1, first, child);
      Inner* const right = spares.take();
      const std::uint32_t kept = at_end ? kFill : kCapacity / 2;
      move_children(*node, kept, *right);
      i + 1 > kept ? insert_child(*right, i + 1 - kept, first, child)
                   : insert_child(*node, i + 1, first, child);
      first = right->firsts[0];
      child = right;
    }
    Inner* const root = spares.take();
    const Entry first_of_all =
        height_ == 0 ? entries(root_)[0] : static_cast<Inner*>(root_)->firsts[0];
    insert_child(*root, 0, first_of_all, root_);
    insert_child(*root, 1, first, child);
    root_ = root;
    ++height_;
  }
  static void insert_child(Inner& node, std::uint32_t i, const Entry& first, Node* child) noexcept {
    const auto open_gap = [&](auto* column) {
      std::copy_backward(column + i, column + node.count, column + node.count + 1);
    };
    open_gap(node.firsts.data());
    open_gap(node.children.data());
    node.firsts[i] = first;
    node.children[i] = child;
    ++node.count;
  }
  // Appends the children of `from` from `first` on to `to`.
  static void move_children(Inner& from, std::uint32_t first, Inner& to) noexcept {
    std::copy(from.firsts.data() + first, from.firsts.data() + from.count,
              to.firsts.data() + to.count);
    std::copy(from.children.data() + first, from.children.data() + from.count,
              to.children.data() + to.count);
    to.count += from.count - first;
    from.count = first;
  }
  // The first entry below the node that `path` leads to is `entry` now.
  static void first_changed(const Path& path, const Entry& entry) noexcept {
    for (std::uint32_t d = path.depth; d > 0; --d) {
      path.steps[d - 1].node->firsts[path.steps[d - 1].child] = entry;
      if (path.steps[d - 1].child != 0) return;
    }
  }

  // --- Taking out

  void take(Path& path, Node* leaf, std::uint32_t i) noexcept {
    Entry* const begin = entries(leaf);
    std::copy(begin + i + 1, begin + leaf->count, begin + i);
    --leaf->count;
    --size_;
    if (leaf->count == 0) {
      free_leaf(leaf);
      return remove_child(path);
    }
    if (i == 0) first_changed(path, begin[0]);
    if (path.depth > 0)
      join_neighbours(path, [](Node* left, Node* right) {
        std::copy(entries(right), entries(right) + right->count, entries(left) + left->count);
        left->count += right->count;
        free_leaf(right);
      });
  }

  // The node that `path` leads to is gone.
  void remove_child(Path& path) noexcept {
    while (path.depth > 0) {
      const auto [node, i] = path.steps[--path.depth];
      forget_child(*node, i);
      if (node->count == 0) {
        delete node;
        continue;
      }
      if (i == 0) first_changed(path, node->firsts[0]);
      if (path.depth > 0) {
        join_neighbours(path, [](Node* left, Node* right) {
          move_children(static_cast<Inner&>(*right), 0, static_cast<Inner&>(*left));
          delete static_cast<Inner*>(right);
        });
      } else {
        lower_root();
      }
      return;
    }
    root_ = nullptr;
    height_ = 0;
  }
  static void forget_child(Inner& node, std::uint32_t i) noexcept {
    const auto close_gap = [&](auto* column) {
      std::copy(column + i + 1, column + node.count, column + i);
    };
    close_gap(node.firsts.data());
    close_gap(node.children.data());
    --node.count;
  }
  // The node that `path` leads to and one beside it become one if they are small.
  template <class Join>
  void join_neighbours(Path& path, Join&& join) noexcept {
    const auto [node, i] = path.steps[path.depth - 1];
    const auto fits = [&, node = node](std::uint32_t left) {
      return left + 1 < node->count &&
             node->children[left]->count + node->children[left + 1]->count <= kMerge;
    };
    std::uint32_t left = i;
    if (!fits(left) && (i == 0 || !fits(--left))) return;
    join(node->children[left], node->children[left + 1]);
    path.steps[path.depth - 1].child = left + 1;
    remove_child(path);
  }
  void lower_root() noexcept {
    while (height_ > 0 && root_->count == 1) {
      auto* const old = static_cast<Inner*>(root_);
      root_ = old->children[0];
      --height_;
      delete old;
    }
  }

  Node* root_ = nullptr;
  std::size_t size_ = 0;
  std::uint32_t height_ = 0;  // 0: the root is a leaf
};

}  // namespace sac
