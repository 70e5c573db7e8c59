// The value of an expression tree whose numbers, operators and subtrees change.
//
// Idea: each operator has a call that requests the values of its operands, and after it one that
// combines them. A new number re-runs the combinations on the path to the root, up to the first
// unchanged value; the requests are not repeated.
//
// Source: the benchmark `exptrees` of Hammer, Acar, Chen, *CEAL: a C-based language for
// self-adjusting computation* (PLDI 2009).
// Cost of an update: O(depth), plus the new part. Native recursion is as deep as the tree: for
// balanced trees; tree_contraction.hpp is for others. Stable because: two calls an operator, named
// by it, the left operand's before the right one's. Not monotone under moves: a subtree put
// elsewhere is computed anew.
#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>

#include "sac/sac.hpp"

namespace examples::expression_tree {

template <class S>
using NumberMod = typename S::template ModType<std::uint64_t>;

template <class S>
struct Node;

/// An operator's term, or else a number, which is an input.
template <class S>
struct Operand {
  const Node<S>* node = nullptr;
  NumberMod<S> number;  // if there is no node
  friend bool operator==(const Operand&, const Operand&) = default;
  friend void label_bytes(sac::LabelSink& sink, const Operand& o) {
    sac::label_arguments(sink, std::tie(o.node, o.number));
  }
};

template <class S>
struct Term {
  char op = '+';  ///< '+', '-' or '*', modulo 2^64
  Operand<S> left, right;
  friend bool operator==(const Term&, const Term&) = default;
  friend void label_bytes(sac::LabelSink& sink, const Term& t) {
    sac::label_arguments(sink, std::tie(t.op, t.left, t.right));
  }
};

/// An operator: edits set its term.
template <class S>
struct Node {
  typename S::template CellType<Term<S>> term;
};

/// The value of an operator's term.
template <class S>
struct Value {
  typename S::template CellType<std::uint64_t> number;
};

struct Combine {
  static constexpr std::string_view kName = "combine";
  template <class S, class M>
  void operator()(S& s, M out, char op, M left, M right) const {
    const std::uint64_t x = s.read(left);
    const std::uint64_t y = s.read(right);
    s.write(out, op == '+' ? x + y : op == '-' ? x - y : x * y);
  }
};
inline constexpr Combine combine{};

// The body of a value.
struct Evaluate {
  static constexpr std::string_view kName = "evaluate";
  template <class S>
  void operator()(S& s, Value<S>& self, const Node<S>* node) const;
};
inline constexpr Evaluate evaluate{};

template <class S>
NumberMod<S> value_of(S& s, const Operand<S>& operand) {
  if (operand.node == nullptr) return operand.number;
  return s.template make<Value<S>, evaluate>(operand.node).number;
}

template <class S>
void Evaluate::operator()(S& s, Value<S>& self, const Node<S>* node) const {
  const Term<S>& term = s.read(node->term);
  const NumberMod<S> left = value_of(s, term.left);
  const NumberMod<S> right = value_of(s, term.right);
  s.template tail<combine>(NumberMod<S>(self.number), term.op, left, right);
}

struct Copy {
  static constexpr std::string_view kName = "copy";
  template <class S, class M>
  void operator()(S& s, M from, M to) const {
    s.write(to, s.read(from));
  }
};
inline constexpr Copy copy{};

/// The program: writes the value of the tree at `root` to `out`. Requires: a tree.
struct Total {
  static constexpr std::string_view kName = "total";
  template <class S>
  void operator()(S& s, const Node<S>* root, NumberMod<S> out) const {
    s.template tail<copy>(value_of(s, Operand<S>{root, {}}), out);
  }
};
inline constexpr Total total{};

}  // namespace examples::expression_tree
