// Mergesort of a list with one element to a call.
//
// Coins flipped by the ids of elements decide what is merged with what, as in mergesort.hpp, but
// the lowest groups are single elements: a group of a level begins with a group of the level below
// whose first element has one more head, and merges its members.
//
// A step of a merge takes the lesser of the first elements of what is left of two lists. The node
// for it is an object keyed by the element and by the list that is merged in; a modifiable names
// what is left. If nodes were keyed by that, an insertion would make new ones for the elements of
// the other list up to the place where it is merged, and on all levels above.
//
// From scratch O(n log n). An inserted or deleted element is in O(log n) lists, and expected O(1)
// steps of each merge have it before them. With probability 1/k it begins a group of k elements,
// and the group is merged again: O(log n) calls expected.
// Source: [Aca05], which has a pass for each level of dividing.
#pragma once

#include <tuple>

#include "list.hpp"

namespace examples {

/// A node of a list that is a merge of two.
template <class S>
struct MergedNode : Node<S> {
  /// What the merge has left: the elements behind `taken`, and those from `other` on.
  struct Rest {
    const Node<S>* taken;
    const Node<S>* other;
    friend bool operator==(const Rest&, const Rest&) = default;
    friend void label_bytes(sac::LabelSink& sink, const Rest& r) {
      sac::label_arguments(sink, std::tie(r.taken, r.other));
    }
  };
  typename S::template CellType<Rest> rest;
};

/// A group of elements.
template <class S>
struct Stretch {
  struct State {
    const Node<S>* list;  // the header of its elements, sorted
    const Stretch* next;  // the group behind
    friend bool operator==(const State&, const State&) = default;
    friend void label_bytes(sac::LabelSink& sink, const State& s) {
      sac::label_arguments(sink, std::tie(s.list, s.next));
    }
  };
  int height = 0;  // the number of levels above that begin a group with it
  typename S::template CellType<State> state;
  MergedNode<S> merged;  // the header where it is merged into those before it
};

/// A group of the lowest level: an element, or none.
template <class S>
struct Single : Stretch<S> {
  Node<S> header;
  Node<S> node;
};

// --- Merging two lists -----------------------------------------------------------------------

/// The node for an element where `added` is merged in, and those behind.
struct TakeNode {
  static constexpr std::string_view kName = "take_node";
  template <class S>
  void operator()(S& s, MergedNode<S>& self, Element element, const Stretch<S>* added) const;
};
inline constexpr TakeNode take_node{};

/// Links `self` to the lesser of the first nodes of two lists, and those behind.
template <class S>
void take_lesser(S& s, const MergedNode<S>& self, const Node<S>* a, const Node<S>* b,
                 const Stretch<S>* added) {
  if (a == nullptr || b == nullptr) return s.write(self.next, a == nullptr ? b : a);
  if (b->element < a->element) std::swap(a, b);
  const auto& taken = s.template tail_make<MergedNode<S>, take_node>(a->element, added);
  s.write(taken.rest, {a, b});
  s.write(self.next, &taken);
}

template <class S>
void TakeNode::operator()(S& s, MergedNode<S>& self, Element element,
                          const Stretch<S>* added) const {
  self.element = element;
  const auto [taken, other] = s.read(self.rest);
  take_lesser(s, self, s.read(taken->next), other, added);
}

/// Merges the two lists whose headers `added.merged` names.
struct MergeLists {
  static constexpr std::string_view kName = "merge_lists";
  template <class S>
  void operator()(S& s, const Stretch<S>* added) const {
    const auto [a, b] = s.read(added->merged.rest);
    take_lesser(s, added->merged, s.read(a->next), s.read(b->next), added);
  }
};
inline constexpr MergeLists merge_lists{};

// --- Groups ----------------------------------------------------------------------------------

/// The group of one element, and those behind.
struct SingleGroup {
  static constexpr std::string_view kName = "single_group";
  template <class S>
  void operator()(S& s, Single<S>& self, const Node<S>* in) const;
};
inline constexpr SingleGroup single_group{};

template <class S>
void SingleGroup::operator()(S& s, Single<S>& self, const Node<S>* in) const {
  const bool is_header = in->element.id == 0;
  self.height = heads(in->element.id);
  self.node.element = in->element;
  const Node<S>* const next = s.read(in->next);
  s.write(self.header.next, is_header ? nullptr : &self.node);
  if (!is_header) s.write(self.node.next, nullptr);
  s.write(self.state,
          {&self.header,
           next == nullptr ? nullptr : &s.template tail_make<Single<S>, single_group>(next)});
}

/// Merges the group that begins with `first`, and those behind.
struct JoinGroups {
  static constexpr std::string_view kName = "join_groups";
  template <class S>
  void operator()(S& s, Stretch<S>& self, const Stretch<S>* first) const;
};
inline constexpr JoinGroups join_groups{};

template <class S>
void JoinGroups::operator()(S& s, Stretch<S>& self, const Stretch<S>* first) const {
  self.height = first->height - 1;
  auto [list, next] = s.read(first->state);
  std::uint64_t members = 1;
  for (; next != nullptr && next->height == 0; ++members) {
    const auto member = s.read(next->state);
    s.write(next->merged.rest, {list, member.list});
    s.template call<merge_lists>(next);
    list = &next->merged;
    next = member.next;
  }
  s.weigh(members);
  s.write(self.state,
          {list, next == nullptr ? nullptr : &s.template tail_make<Stretch<S>, join_groups>(next)});
}

/// Joins groups until one is left.
struct JoinAll {
  static constexpr std::string_view kName = "join_all";
  template <class S>
  void operator()(S& s, const Stretch<S>* first, NodeMod<S> result) const;
};
inline constexpr JoinAll join_all{};

template <class S>
void JoinAll::operator()(S& s, const Stretch<S>* first, NodeMod<S> result) const {
  const auto [list, next] = s.read(first->state);
  if (next == nullptr) return s.write(result, list);
  const Stretch<S>* const up = &s.template make<Stretch<S>, join_groups>(first);
  s.template tail<join_all>(up, result);
}

/// Writes the header of `list` sorted to `result`.
struct MergesortElements {
  static constexpr std::string_view kName = "mergesort_elements";
  template <class S>
  void operator()(S& s, const Node<S>* list, NodeMod<S> result) const {
    const Stretch<S>* const groups = &s.template make<Single<S>, single_group>(list);
    s.template tail<join_all>(groups, result);
  }
};
inline constexpr MergesortElements mergesort_elements{};

}  // namespace examples
