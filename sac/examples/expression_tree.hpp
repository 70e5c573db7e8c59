// The value of an expression tree whose numbers, operators and subtrees change.
//
// Idea: the value of a node is the result of a call. A call runs again if its node changes or if
// the value of a child does; so an edit runs again the path from the node to the root, up to the
// first value that stays what it was.
//
// Source: the benchmark `exptrees` of Hammer, Acar, Chen, *CEAL: a C-based language for
// self-adjusting computation* (PLDI 2009).
// Cost of an update: O(depth of the node); native recursion is as deep as the tree, so balanced
// trees only: tree_contraction.hpp is for the others.
// Stable because: one call a node, named by the node, the left operand's before the right one's. A
// subtree that is moved to another place is computed anew.
#pragma once

#include <cstdint>
#include <string_view>

namespace examples::expression_tree {

template <class S>
struct Node;

/// What stands at a node: an operator with its operands, or a number.
template <class S>
struct Term {
  char op = 0;  ///< '+', '-' or '*', modulo 2^64; 0: a number
  std::uint64_t number = 0;
  const Node<S>* left = nullptr;
  const Node<S>* right = nullptr;
  friend bool operator==(const Term&, const Term&) = default;
};

/// An input: edits set its term.
template <class S>
struct Node {
  typename S::template CellType<Term<S>> term;
};

struct Value {
  static constexpr std::string_view kName = "value";
  template <class S>
  std::uint64_t operator()(S& s, const Node<S>* node) const;
};
inline constexpr Value value{};

template <class S>
std::uint64_t Value::operator()(S& s, const Node<S>* node) const {
  const Term<S>& term = s.read(node->term);
  if (term.op == 0) return term.number;
  const std::uint64_t left = s.template call<value>(term.left);
  const std::uint64_t right = s.template call<value>(term.right);
  switch (term.op) {
    case '+':
      return left + right;
    case '-':
      return left - right;
    default:
      return left * right;
  }
}

/// The program: the value of the tree at `root`. Requires: a tree.
struct Total {
  static constexpr std::string_view kName = "total";
  template <class S>
  void operator()(S& s, const Node<S>* root,
                  typename S::template ModType<std::uint64_t> out) const {
    s.write(out, s.template call<value>(root));
  }
};
inline constexpr Total total{};

}  // namespace examples::expression_tree
