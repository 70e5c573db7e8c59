// A treap of nodes in an arena: a search tree that is a heap of priorities. Its shape is a function
// of the nodes and their priorities alone, and not of the order in which they came.
//
// The caller finds the place of a new node; here it is linked, unlinked, and what a node knows of
// those below it is kept. Nothing allocates or compares keys, so nothing fails. O(log n) expected.
//
//   struct Tree {
//     using Node = ...;                                  // with a member `TreapLinks links`
//     Node& node(Handle) const;
//     std::uint64_t priority(Handle) const;              // of equal ones the left node is above
//     bool update(Node&) const noexcept;                 // from the children's: has it changed?
//     bool names(const Node&, Handle) const noexcept;    // whether what a node knows is a node
//   };
#pragma once

#include <cstdint>
#include <utility>

#include "sac/arena.hpp"
#include "sac/check.hpp"

namespace sac::detail {

struct TreapLinks {
  Handle parent = 0;
  Handle left = 0;
  Handle right = 0;
};

template <class Tree>
struct Treap {
  /// Links `h` below `parent`, which has no child on that side; parent 0: as the only node.
  static void link(const Tree& tree, Handle& root, Handle parent, bool right, Handle h) noexcept {
    tree.node(h).links = {.parent = parent};
    if (parent == 0) {
      root = h;
    } else {
      (right ? links(tree, parent).right : links(tree, parent).left) = h;
    }
    tree.update(tree.node(h));
    while (links(tree, h).parent != 0 && is_above(tree, h, links(tree, h).parent)) {
      rotate_up(tree, root, h);
    }
    refresh(tree, links(tree, h).parent);
  }

  static void unlink(const Tree& tree, Handle& root, Handle h) noexcept {
    const Handle above = links(tree, h).parent;
    for (TreapLinks& l = links(tree, h); l.left != 0 || l.right != 0;) {
      const bool left = l.right == 0 || (l.left != 0 && !goes_above(tree, l.right, l.left));
      rotate_up(tree, root, left ? l.left : l.right);
    }
    const Handle parent = links(tree, h).parent;
    child_of(tree, root, parent, h) = 0;
    links(tree, h) = {};
    Handle up = parent;
    for (; up != above; up = links(tree, up).parent) tree.update(tree.node(up));
    // Those who name the node stand in a row from here on: each had it from the one below.
    for (bool goes_on = true; up != 0 && goes_on; up = links(tree, up).parent) {
      const bool names_it = tree.names(tree.node(up), h);
      goes_on = tree.update(tree.node(up)) || names_it;
    }
  }

  /// What `h` may know has changed: it looks again, and those above it, as long as it has. 0:
  /// nothing.
  static void refresh(const Tree& tree, Handle h) noexcept {
    while (h != 0 && tree.update(tree.node(h))) h = links(tree, h).parent;
  }

  /// The first and last node of the tree below `h`; 0 if h is 0.
  [[nodiscard]] static Handle first(const Tree& tree, Handle h) noexcept {
    while (h != 0 && links(tree, h).left != 0) h = links(tree, h).left;
    return h;
  }
  [[nodiscard]] static Handle last(const Tree& tree, Handle h) noexcept {
    while (h != 0 && links(tree, h).right != 0) h = links(tree, h).right;
    return h;
  }
  /// The neighbours of `h`; 0: none.
  [[nodiscard]] static Handle next(const Tree& tree, Handle h) noexcept {
    if (links(tree, h).right != 0) return first(tree, links(tree, h).right);
    Handle up = links(tree, h).parent;
    while (up != 0 && links(tree, up).right == h) h = std::exchange(up, links(tree, up).parent);
    return up;
  }
  [[nodiscard]] static Handle previous(const Tree& tree, Handle h) noexcept {
    if (links(tree, h).left != 0) return last(tree, links(tree, h).left);
    Handle up = links(tree, h).parent;
    while (up != 0 && links(tree, up).left == h) h = std::exchange(up, links(tree, up).parent);
    return up;
  }

  /// Throws: InvariantError. Returns the number of nodes below `h`.
  static std::size_t check_invariants(const Tree& tree, Handle h, Handle parent = 0) {
    if (h == 0) return 0;
    const TreapLinks& l = links(tree, h);
    SAC_INVARIANT(l.parent == parent);
    SAC_INVARIANT(parent == 0 || !is_above(tree, h, parent));
    return 1 + check_invariants(tree, l.left, h) + check_invariants(tree, l.right, h);
  }

 private:
  static TreapLinks& links(const Tree& tree, Handle h) noexcept { return tree.node(h).links; }

  // Whether the left of two siblings stays below the right one.
  static bool goes_above(const Tree& tree, Handle right, Handle left) noexcept {
    return tree.priority(right) > tree.priority(left);
  }
  // Whether a child belongs above its parent.
  static bool is_above(const Tree& tree, Handle child, Handle parent) noexcept {
    const auto own = tree.priority(child);
    const auto other = tree.priority(parent);
    return own > other || (own == other && links(tree, parent).left == child);
  }
  static Handle& child_of(const Tree& tree, Handle& root, Handle parent, Handle h) noexcept {
    if (parent == 0) return root;
    return links(tree, parent).left == h ? links(tree, parent).left : links(tree, parent).right;
  }
  static void rotate_up(const Tree& tree, Handle& root, Handle h) noexcept {
    TreapLinks& own = links(tree, h);
    const Handle parent = own.parent;
    TreapLinks& old = links(tree, parent);
    child_of(tree, root, old.parent, parent) = h;
    const bool is_left = old.left == h;
    Handle& inner = is_left ? own.right : own.left;
    (is_left ? old.left : old.right) = inner;
    if (inner != 0) links(tree, inner).parent = parent;
    inner = parent;
    own.parent = std::exchange(old.parent, h);
    tree.update(tree.node(parent));
    tree.update(tree.node(h));
  }
};

}  // namespace sac::detail
