// Quicksort of a list with one element to a call.
//
// The first element of a part is its pivot; the others go to the part of the less or to that of the
// greater elements, whose first one is the pivot there. A call (element, pivot) is one comparison.
// The comparisons are those of a quicksort that divides part after part, but in the order of the
// elements: each is sifted through the pivots before it. So no part is a list, which would hold its
// elements once for each level; and where a pivot comes or goes, an element of its part makes one
// comparison more or fewer, and keeps the others.
//
// For a random order of the elements: from scratch O(n log n). An inserted or deleted element is
// sifted through O(log n) pivots, and is the pivot of a part of O(log n) elements expected: O(log
// n) calls. Source: quicksort [Aca05], and its equality with insertion into a binary search tree.
#pragma once

#include "list.hpp"

namespace examples {

/// A node of the result, and the pivot of a part.
template <class S>
struct Pivot : Node<S> {
  typename S::template CellType<const Pivot*> less;     // the pivot of the lesser ones; null: none
  typename S::template CellType<const Pivot*> greater;  // that of the greater ones
};

/// Compares `self` with a pivot. The first element of a part becomes its pivot.
struct Sift {
  static constexpr std::string_view kName = "sift";
  template <class S>
  void operator()(S& s, const Pivot<S>* self, const Pivot<S>* pivot) const;
};
inline constexpr Sift sift{};

template <class S>
void Sift::operator()(S& s, const Pivot<S>* self, const Pivot<S>* pivot) const {
  const auto& part = self->element < pivot->element ? pivot->less : pivot->greater;
  const Pivot<S>* const first = s.read(part);
  if (first == nullptr) return s.write(part, self);
  s.template tail<sift>(self, first);
}

/// Puts the element of `in` into its part below `root`, and those behind.
struct SiftNode {
  static constexpr std::string_view kName = "sift_node";
  template <class S>
  void operator()(S& s, Pivot<S>& self, const Node<S>* in, const Pivot<S>* root) const;
};
inline constexpr SiftNode sift_node{};

template <class S>
void SiftNode::operator()(S& s, Pivot<S>& self, const Node<S>* in, const Pivot<S>* root) const {
  self.element = in->element;
  s.write(self.less, nullptr);
  s.write(self.greater, nullptr);
  const Node<S>* const next = s.read(in->next);
  s.template call<sift>(static_cast<const Pivot<S>*>(&self), root);
  if (next != nullptr) s.template tail_make<Pivot<S>, sift_node>(next, root);
}

/// Links the pivots of a part, which lies between two nodes of the result.
struct LinkPart {
  static constexpr std::string_view kName = "link_part";
  template <class S>
  void operator()(S& s, const Pivot<S>* pivot, const Node<S>* before, const Node<S>* after) const;
};
inline constexpr LinkPart link_part{};

template <class S>
void LinkPart::operator()(S& s, const Pivot<S>* pivot, const Node<S>* before,
                          const Node<S>* after) const {
  const Pivot<S>* const less = s.read(pivot->less);
  const Pivot<S>* const greater = s.read(pivot->greater);
  if (less == nullptr) s.write(before->next, pivot);
  if (greater == nullptr) s.write(pivot->next, after);
  if (less != nullptr) {
    s.template call<link_part>(less, before, static_cast<const Node<S>*>(pivot));
  }
  if (greater != nullptr) {
    s.template tail<link_part>(greater, static_cast<const Node<S>*>(pivot), after);
  }
}

/// Writes the header of `list` sorted to `result`.
struct QuicksortElements {
  static constexpr std::string_view kName = "quicksort_elements";
  template <class S>
  void operator()(S& s, const Node<S>* list, NodeMod<S> result) const;
};
inline constexpr QuicksortElements quicksort_elements{};

/// The header of the result, the pivot that is less than all.
struct SiftList {
  static constexpr std::string_view kName = "sift_list";
  template <class S>
  void operator()(S& s, Pivot<S>& self, const Node<S>* list) const;
};
inline constexpr SiftList sift_list{};

template <class S>
void SiftList::operator()(S& s, Pivot<S>& self, const Node<S>* list) const {
  s.write(self.greater, nullptr);
  const Node<S>* const first = s.read(list->next);
  if (first == nullptr) return;
  s.template tail_make<Pivot<S>, sift_node>(first, static_cast<const Pivot<S>*>(&self));
}

/// Links what is greater than the header.
struct LinkAll {
  static constexpr std::string_view kName = "link_all";
  template <class S>
  void operator()(S& s, const Pivot<S>* header) const {
    const Pivot<S>* const first = s.read(header->greater);
    if (first == nullptr) return s.write(header->next, nullptr);
    s.template tail<link_part>(first, static_cast<const Node<S>*>(header),
                               static_cast<const Node<S>*>(nullptr));
  }
};
inline constexpr LinkAll link_all{};

template <class S>
void QuicksortElements::operator()(S& s, const Node<S>* list, NodeMod<S> result) const {
  const Pivot<S>& header = s.template make<Pivot<S>, sift_list>(list);
  s.write(result, &header);
  s.template tail<link_all>(&header);
}

}  // namespace examples
