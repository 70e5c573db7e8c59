// Operations on lists, for traced functions: for_each, map, filter, reverse.
//
//   auto images = sac::map<image>(s, sac::filter<is_kept>(s, list));
//
// f and p are functions without state, of (value), (scope, value) or (scope, id, value), and of the
// parameters that the operation is given: sac::filter<is_below>(s, list, 10) keeps the elements for
// which is_below(value, 10) holds. Parameters are arguments of all of its calls: with another one
// the operation is made anew. What changes often is better read through the scope. f and p may read
// and write modifiables and make child calls, but no tail calls. The result of an operation is
// complete when it returns, and up to date after every propagation.
//
// Cost, in calls. From scratch: one for each element; map with an f that takes a scope: two. An
// edit makes the call before its position run again, and creates or discards that of the element;
// setting a value does both:
//   for_each, map, reverse   at most 2 executed, 1 created, 1 discarded
//   map in a scope           at most 3 executed, 2 created, 2 discarded
//   filter                   as map, and one created and discarded for each element passed over
//                            behind a kept element that is inserted or erased: O(1) expected if a
//                            constant fraction is kept
// When a modifiable changes that f reads through its scope, the calls that have read it run again.
//
// Labels. The label of a call has the operation, its functions, and the nodes of its list: `map
// image`. The same operation on the same list twice makes calls with equal labels; use the result
// of the first.
#pragma once

#include <string_view>
#include <type_traits>
#include <utility>

#include "sac/list/list.hpp"

namespace sac {

namespace detail {

// --- for_each --------------------------------------------------------------------------------

template <auto f>
struct ForEach {
  static constexpr std::string_view kName = kOperationName<"for_each", f>;
  template <class S, class T, class... P>
  void operator()(S& s, const ListNode<T, S>* at, const P&... with) const {
    const auto* const next = s.read(at->next);
    if (at->holds()) apply<f>(s, *at, with...);
    if (next != nullptr) s.template tail<ForEach{}>(next, with...);
  }
};

// --- map -------------------------------------------------------------------------------------

// Makes the image of a node, keyed by the node, and those behind. Its value is a function of the
// key, so it is computed once.
template <auto f>
struct Map {
  static constexpr std::string_view kName = kOperationName<"map", f>;
  template <class S, class T, class U, class... P>
  void operator()(S& s, ListNode<U, S>& self, const ListNode<T, S>* in, const P&... with) const {
    if (in->holds() && !self.holds()) self.hold(in->id(), f(in->value(), with...));
    const auto* const next = s.read(in->next);
    s.write(self.next, next == nullptr
                           ? nullptr
                           : &s.template tail_make<ListNode<U, S>, Map{}>(next, with...));
  }
};

// If f takes a scope, the image of an element may change while its node does not: a node of the
// result is keyed by its content, and another call links it.
template <auto f>
struct Image {
  static constexpr std::string_view kName = kOperationName<"image", f>;
  template <class S, class T, class U>
  void operator()(S&, ListNode<U, S>& self, const ListNode<T, S>* in, const U& value) const {
    self.hold(in->id(), value);
  }
};

template <auto f>
struct MapBehind {
  static constexpr std::string_view kName = kOperationName<"map_behind", f>;
  template <class S, class T, class U, class... P>
  void operator()(S& s, const ListNode<T, S>* in, ListNode<U, S>* before, const P&... with) const {
    const auto* const next = s.read(in->next);
    if (next == nullptr) return s.write(before->next, nullptr);
    U value = apply<f>(s, *next, with...);
    auto& image = s.template make<ListNode<U, S>, Image<f>{}>(next, std::move(value));
    s.write(before->next, &image);
    s.template tail<MapBehind{}>(next, &image, with...);
  }
};

template <auto f>
struct MapInScope {
  static constexpr std::string_view kName = kOperationName<"map", f>;
  template <class S, class T, class U, class... P>
  void operator()(S& s, ListNode<U, S>& self, const ListNode<T, S>* header,
                  const P&... with) const {
    s.template tail<MapBehind<f>{}>(header, &self, with...);
  }
};

// --- filter ----------------------------------------------------------------------------------

template <auto p>
struct FilterBehind;

// Makes the copy of a kept node, and those behind.
template <auto p>
struct Filter {
  static constexpr std::string_view kName = kOperationName<"filter", p>;
  template <class S, class T, class... P>
  void operator()(S& s, ListNode<T, S>& self, const ListNode<T, S>* in, const P&... with) const {
    if (in->holds() && !self.holds()) self.hold(in->id(), in->value());
    FilterBehind<p>{}(s, &self, in, with...);
  }
};

// Links `kept` to the copy of the first kept node behind `at`.
template <auto p>
struct FilterBehind {
  static constexpr std::string_view kName = kOperationName<"filter_behind", p>;
  template <class S, class T, class... P>
  void operator()(S& s, ListNode<T, S>* kept, const ListNode<T, S>* at, const P&... with) const {
    const auto* const next = s.read(at->next);
    if (next == nullptr) {
      s.write(kept->next, nullptr);
    } else if (apply<p>(s, *next, with...)) {
      s.write(kept->next, &s.template tail_make<ListNode<T, S>, Filter<p>{}>(next, with...));
    } else {
      s.template tail<FilterBehind{}>(kept, next, with...);
    }
  }
};

// --- reverse ---------------------------------------------------------------------------------

// Makes the copy of a node; the caller links it to the node before, and the last copy is the first
// of `header`.
struct ReverseNode {
  static constexpr std::string_view kName = "reverse_node";
  template <class S, class T>
  void operator()(S& s, ListNode<T, S>& self, const ListNode<T, S>* in,
                  ListNode<T, S>* header) const {
    if (!self.holds()) self.hold(in->id(), in->value());
    const auto* const next = s.read(in->next);
    if (next == nullptr) return s.write(header->next, &self);
    auto& before = s.template tail_make<ListNode<T, S>, ReverseNode{}>(next, header);
    s.write(before.next, &self);
  }
};

struct Reverse {
  static constexpr std::string_view kName = "reverse";
  template <class S, class T>
  void operator()(S& s, ListNode<T, S>& self, const ListNode<T, S>* list) const {
    const auto* const first = s.read(list->next);
    if (first == nullptr) return s.write(self.next, nullptr);
    auto& last = s.template tail_make<ListNode<T, S>, ReverseNode{}>(first, &self);
    s.write(last.next, nullptr);
  }
};

}  // namespace detail

/// Calls f for every element, in order, each in a traced call of its own.
template <auto f, class S, class T, class... P>
void for_each(S& s, List<T, S> list, const P&... with) {
  s.template call<detail::ForEach<f>{}>(list.header(), with...);
}

/// The list of the results of f for every element. If f takes a scope, its result must be hashable,
/// as an argument. An f of the value alone is called once for each element.
template <auto f, class S, class T, class... P>
[[nodiscard]] auto map(S& s, List<T, S> list, const P&... with) {
  using U = std::decay_t<decltype(detail::apply<f>(s, *list.header(), with...))>;
  using Node = ListNode<U, S>;
  if constexpr (detail::kOfValueAlone<f, T, P...>) {
    return List<U, S>(s.template make<Node, detail::Map<f>{}>(list.header(), with...));
  } else {
    return List<U, S>(s.template make<Node, detail::MapInScope<f>{}>(list.header(), with...));
  }
}

/// The list of the elements for which p holds.
template <auto p, class S, class T, class... P>
[[nodiscard]] List<T, S> filter(S& s, List<T, S> list, const P&... with) {
  return List<T, S>(s.template make<ListNode<T, S>, detail::Filter<p>{}>(list.header(), with...));
}

/// The reversed list.
template <class S, class T>
[[nodiscard]] List<T, S> reverse(S& s, List<T, S> list) {
  return List<T, S>(s.template make<ListNode<T, S>, detail::Reverse{}>(list.header()));
}

}  // namespace sac
