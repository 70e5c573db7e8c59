// A treap of nodes in an arena: a search tree that is a heap of priorities. Its shape is a function
// of the nodes and their priorities alone, and not of the order in which they came.
//
// The caller finds the place of a new node; here it is linked, unlinked, and what a node knows of
// those below it is kept. Nothing allocates or compares keys, so nothing fails. O(log n) expected.
//
//   struct Tree {
//     using Node = ...;                                  // with a member `TreapLinks<Node> links`
//     Node& node(Ref<Node>) const;
//     std::uint64_t priority(Ref<Node>) const;           // of equal ones the left node is above
//     bool update(Node&) const noexcept;                 // from the children's: has it changed?
//     bool names(const Node&, Ref<Node>) const noexcept;  // whether what a node knows is a node
//   };
#pragma once

#include <cstdint>
#include <utility>

#include "sac/arena.hpp"
#include "sac/check.hpp"

namespace sac::detail {

template <class Node>
struct TreapLinks {
  Ref<Node> parent{};
  Ref<Node> left{};
  Ref<Node> right{};
};

template <class Tree>
struct Treap {
  using Node = typename Tree::Node;

  /// Links `h` below `parent`, which has no child on that side; parent null: as the only node.
  static void link(const Tree& tree, Ref<Node>& root, Ref<Node> parent, bool right,
                   Ref<Node> h) noexcept {
    tree.node(h).links = {.parent = parent};
    if (parent == nullptr) {
      root = h;
    } else {
      (right ? links(tree, parent).right : links(tree, parent).left) = h;
    }
    tree.update(tree.node(h));
    while (links(tree, h).parent != nullptr && is_above(tree, h, links(tree, h).parent)) {
      rotate_up(tree, root, h);
    }
    refresh(tree, links(tree, h).parent);
  }

  static void unlink(const Tree& tree, Ref<Node>& root, Ref<Node> h) noexcept {
    const Ref<Node> above = links(tree, h).parent;
    for (TreapLinks<Node>& l = links(tree, h); l.left != nullptr || l.right != nullptr;) {
      const bool left =
          l.right == nullptr || (l.left != nullptr && !goes_above(tree, l.right, l.left));
      rotate_up(tree, root, left ? l.left : l.right);
    }
    const Ref<Node> parent = links(tree, h).parent;
    child_of(tree, root, parent, h) = nullptr;
    links(tree, h) = {};
    Ref<Node> up = parent;
    for (; up != above; up = links(tree, up).parent) tree.update(tree.node(up));
    // Those who name the node stand in a row from here on: each had it from the one below.
    for (bool goes_on = true; up != nullptr && goes_on; up = links(tree, up).parent) {
      const bool names_it = tree.names(tree.node(up), h);
      goes_on = tree.update(tree.node(up)) || names_it;
    }
  }

  /// What `h` may know has changed: it looks again, and those above it, as long as it has.
  /// Null: nothing.
  static void refresh(const Tree& tree, Ref<Node> h) noexcept {
    while (h != nullptr && tree.update(tree.node(h))) h = links(tree, h).parent;
  }

  /// The first and last node of the tree below `h`; null if h is null.
  [[nodiscard]] static Ref<Node> first(const Tree& tree, Ref<Node> h) noexcept {
    while (h != nullptr && links(tree, h).left != nullptr) h = links(tree, h).left;
    return h;
  }
  [[nodiscard]] static Ref<Node> last(const Tree& tree, Ref<Node> h) noexcept {
    while (h != nullptr && links(tree, h).right != nullptr) h = links(tree, h).right;
    return h;
  }
  /// The neighbours of `h`; null: none.
  [[nodiscard]] static Ref<Node> next(const Tree& tree, Ref<Node> h) noexcept {
    if (links(tree, h).right != nullptr) return first(tree, links(tree, h).right);
    Ref<Node> up = links(tree, h).parent;
    while (up != nullptr && links(tree, up).right == h)
      h = std::exchange(up, links(tree, up).parent);
    return up;
  }
  [[nodiscard]] static Ref<Node> previous(const Tree& tree, Ref<Node> h) noexcept {
    if (links(tree, h).left != nullptr) return last(tree, links(tree, h).left);
    Ref<Node> up = links(tree, h).parent;
    while (up != nullptr && links(tree, up).left == h)
      h = std::exchange(up, links(tree, up).parent);
    return up;
  }

  /// Throws: InvariantError. Returns the number of nodes below `h`.
  static std::size_t check_invariants(const Tree& tree, Ref<Node> h, Ref<Node> parent = {}) {
    if (h == nullptr) return 0;
    const TreapLinks<Node>& l = links(tree, h);
    SAC_INVARIANT(l.parent == parent);
    SAC_INVARIANT(parent == nullptr || !is_above(tree, h, parent));
    return 1 + check_invariants(tree, l.left, h) + check_invariants(tree, l.right, h);
  }

 private:
  static TreapLinks<Node>& links(const Tree& tree, Ref<Node> h) noexcept {
    return tree.node(h).links;
  }

  // Whether the left of two siblings stays below the right one.
  static bool goes_above(const Tree& tree, Ref<Node> right, Ref<Node> left) noexcept {
    return tree.priority(right) > tree.priority(left);
  }
  // Whether a child belongs above its parent.
  static bool is_above(const Tree& tree, Ref<Node> child, Ref<Node> parent) noexcept {
    const auto own = tree.priority(child);
    const auto other = tree.priority(parent);
    return own > other || (own == other && links(tree, parent).left == child);
  }
  static Ref<Node>& child_of(const Tree& tree, Ref<Node>& root, Ref<Node> parent,
                             Ref<Node> h) noexcept {
    if (parent == nullptr) return root;
    return links(tree, parent).left == h ? links(tree, parent).left : links(tree, parent).right;
  }
  static void rotate_up(const Tree& tree, Ref<Node>& root, Ref<Node> h) noexcept {
    TreapLinks<Node>& own = links(tree, h);
    const Ref<Node> parent = own.parent;
    TreapLinks<Node>& old = links(tree, parent);
    child_of(tree, root, old.parent, parent) = h;
    const bool is_left = old.left == h;
    Ref<Node>& inner = is_left ? own.right : own.left;
    (is_left ? old.left : old.right) = inner;
    if (inner != nullptr) links(tree, inner).parent = parent;
    inner = parent;
    own.parent = std::exchange(old.parent, h);
    tree.update(tree.node(parent));
    tree.update(tree.node(h));
  }
};

}  // namespace sac::detail
