// Folding a list with an associative operation, by random contraction.
//
// On the level above the list, there is a group for every element of height 1 or more, which is one
// in eight; it represents that element and those of height 0 behind it, up to the next group.
// Groups are contracted in the same way, with heights reduced by one, until one group is left.
// Heights come from the ids of elements, so an edit changes O(1) expected groups on each level, and
// O(log n) in all; propagation stops at a group whose fold does not change. A group is an object
// keyed by its first member.
//
// From scratch O(n). Source: [Aca05], with groups of 8 on average instead of 2.
//
// Op is a type with    using Value = ...;   static Value join(const Value&, const Value&);
//                      static Value of(const Element&);   for lists of nodes
// where join is associative and a header's value is neutral.
#pragma once

#include <cstdint>
#include <tuple>

#include "list.hpp"

namespace examples {

/// Log of the mean number of members of a group.
inline constexpr int kHeightBits = 3;

/// The number of levels above the lowest that the element reaches; a header reaches all.
[[nodiscard]] inline int height_of(std::uint32_t id) noexcept { return heads(id) / kHeightBits; }

template <class S, class Op>
struct Group {
  struct State {
    typename Op::Value value;
    const Group* next;
    friend bool operator==(const State&, const State&) = default;
    friend void label_bytes(sac::LabelSink& sink, const State& s) {
      sac::label_arguments(sink, std::tie(s.value, s.next));
    }
  };
  int height = 0;
  typename S::template CellType<State> state;
};

template <class Op, class S>
[[nodiscard]] typename Group<S, Op>::State read_group(S& s, const Group<S, Op>* group) {
  return s.read(group->state);
}
template <class S, class Op>
[[nodiscard]] int height(const Group<S, Op>& group) noexcept {
  return group.height;
}

/// A member of the lowest level is a node of the list.
template <class S, class Op>
struct NodeState {
  typename Op::Value value;
  const Node<S>* next;
};
template <class Op, class S>
[[nodiscard]] NodeState<S, Op> read_group(S& s, const Node<S>* node) {
  return {Op::of(node->element), s.read(node->next)};
}
template <class S>
[[nodiscard]] int height(const Node<S>& node) noexcept {
  return height_of(node.element.id);
}

/// Makes the group of `first` and the members of height 0 behind it, and the groups behind.
template <class Op>
struct Contract {
  template <class S, class Member>
  void operator()(S& s, Group<S, Op>& self, const Member* first) const;
};
template <class Op>
inline constexpr Contract<Op> contract{};

template <class Op>
template <class S, class Member>
void Contract<Op>::operator()(S& s, Group<S, Op>& self, const Member* first) const {
  self.height = height(*first) - 1;
  auto [value, next] = read_group<Op>(s, first);
  std::uint64_t members = 1;
  for (; next != nullptr && height(*next) == 0; ++members) {
    const auto member = read_group<Op>(s, next);
    value = Op::join(value, member.value);
    next = member.next;
  }
  s.weigh(members);
  using G = Group<S, Op>;
  const G* behind = next == nullptr ? nullptr : &s.template tail_make<G, contract<Op>>(next);
  s.write(self.state, {value, behind});
}

/// Contracts groups until one is left, and writes its value to `result`.
template <class Op>
struct ContractAll {
  template <class S>
  void operator()(S& s, const Group<S, Op>* header,
                  typename S::template ModType<typename Op::Value> result) const;
};
template <class Op>
inline constexpr ContractAll<Op> contract_all{};

template <class Op>
template <class S>
void ContractAll<Op>::operator()(S& s, const Group<S, Op>* header,
                                 typename S::template ModType<typename Op::Value> result) const {
  const auto state = s.read(header->state);
  if (state.next == nullptr) return s.write(result, state.value);
  const Group<S, Op>* up = &s.template make<Group<S, Op>, contract<Op>>(header);
  s.template tail<contract_all<Op>>(up, result);
}

/// Writes the fold of `list`, whose header is a node or another lowest member, to `result`.
template <class Op>
struct Fold {
  template <class S, class Member>
  void operator()(S& s, const Member* list,
                  typename S::template ModType<typename Op::Value> result) const {
    const Group<S, Op>* up = &s.template make<Group<S, Op>, contract<Op>>(list);
    s.template tail<contract_all<Op>>(up, result);
  }
};
template <class Op>
inline constexpr Fold<Op> fold{};

}  // namespace examples
