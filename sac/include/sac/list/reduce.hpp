// Computes one value from a list, by random contraction: reduce, map_reduce, size, find_if; fetch.
//
// On the level above the list, there is a group for every element of height 1 or more, which is one
// in eight; it represents that element and those of height 0 behind it, up to the next group.
// Groups are contracted in the same way, with heights reduced by one, until one group is left.
// Heights come from the ids of elements, so an edit changes O(1) expected groups on each level, and
// O(log n) in all; propagation stops at a group whose value does not change. A group is an object
// keyed by its first member.
//
// From scratch O(n). An insertion, an erasure or another value costs O(log n) expected, and calls
// the functions for the members of each group, eight expected. Source: [Aca05, §8.2.3], with groups
// of 8 on average instead of 2.
//
// Functions may take a scope as their first argument (list/operations.hpp), and read through it.
// The result is a modifiable that a child of the caller has written, so only later calls can read
// it. The caller itself can fetch the value, and runs again when it changes:
//
//   s.write(total, sac::fetch(s, sac::reduce<std::plus<>{}>(s, list, 0)));
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "sac/internal/same.hpp"
#include "sac/list/list.hpp"

namespace sac {

namespace detail {

// A Rule defines the computation:
//   using Value; static constexpr std::string_view kName, kGroupName, kLevelName;
//   static Value of(S&, const ListNode<T, S>&);
//   static Value join(S&, const Value&, const Value&);  // associative

template <class Rule, class S>
struct Group {
  struct State {
    std::optional<typename Rule::Value> value;  // none: the group of the header, which stands alone
    const Group* next = nullptr;
    friend bool operator==(const State& a, const State& b) {
      return a.next == b.next && a.value.has_value() == b.value.has_value() &&
             (!a.value.has_value() || identical(*a.value, *b.value));
    }
    friend void label_bytes(LabelSink& sink, const State& s) {
      label_arguments(sink, std::tuple(s.value.has_value(), s.next));
      if (s.value) label_arguments(sink, std::tie(*s.value));
    }
  };
  int height = 0;
  typename S::template CellType<State> state;
};

// Logarithm of the mean number of members of a group.
inline constexpr int kHeightBits = 3;

// The number of levels above its own that a member reaches; a header reaches all of them.
template <class T, class S>
[[nodiscard]] int height_of(const ListNode<T, S>& node) noexcept {
  return heads(node) / kHeightBits;
}
template <class Rule, class S>
[[nodiscard]] int height_of(const Group<Rule, S>& group) noexcept {
  return group.height;
}

template <class Rule, class S, class T>
std::optional<typename Rule::Value> value_of(S& s, const ListNode<T, S>& node) {
  if (!node.holds()) return std::nullopt;
  return Rule::of(s, node);
}

// Makes the group of `first` and the members of height 0 behind it, and the groups behind.
template <class Rule>
struct Contract {
  static constexpr std::string_view kName = Rule::kGroupName;

  template <class S, class Member>
  void operator()(S& s, Group<Rule, S>& self, const Member* first) const {
    self.height = height_of(*first) - 1;
    auto [value, next] = read(s, *first);
    while (next != nullptr && height_of(*next) == 0) {
      const auto [more, behind] = read(s, *next);
      value = value ? Rule::join(s, *value, *more) : more;
      next = behind;
    }
    using G = Group<Rule, S>;
    const G* const behind = next == nullptr ? nullptr : &s.template tail_make<G, Contract{}>(next);
    s.write(self.state, {std::move(value), behind});
  }

 private:
  // The value of a member, and the next one.
  template <class S, class T>
  static auto read(S& s, const ListNode<T, S>& node) {
    const ListNode<T, S>* const next = s.read(node.next);
    return std::pair(value_of<Rule>(s, node), next);
  }
  template <class S>
  static auto read(S& s, const Group<Rule, S>& group) {
    const auto& state = s.read(group.state);
    return std::pair(state.value, state.next);
  }
};

template <class Value, class S>
struct Reduced {
  typename S::template CellType<Value> value;
};

// Contracts groups until one is left, whose value goes to `result`.
template <class Rule>
struct ContractAll {
  static constexpr std::string_view kName = Rule::kLevelName;
  template <class S, class Init>
  void operator()(S& s, const Group<Rule, S>* first, Reduced<Init, S>* result,
                  const Init& init) const {
    const auto& state = s.read(first->state);
    if (state.next == nullptr) {
      return s.write(result->value, state.value ? Rule::join(s, init, *state.value) : init);
    }
    const auto* const up = &s.template make<Group<Rule, S>, Contract<Rule>{}>(first);
    s.template tail<ContractAll{}>(up, result, init);
  }
};

template <class Rule>
struct Reduce {
  static constexpr std::string_view kName = Rule::kName;
  template <class S, class T, class Init>
  void operator()(S& s, Reduced<Init, S>& self, const ListNode<T, S>* list,
                  const Init& init) const {
    const auto* const groups = &s.template make<Group<Rule, S>, Contract<Rule>{}>(list);
    s.template tail<ContractAll<Rule>{}>(groups, &self, init);
  }
};

template <class Rule, class S, class T>
[[nodiscard]] auto reduce_by(S& s, List<T, S> list, typename Rule::Value init) {
  using Value = typename Rule::Value;
  auto& result = s.template make<Reduced<Value, S>, Reduce<Rule>{}>(list.header(), std::move(init));
  return typename S::template ModType<Value>(result.value);
}

// --- Rules -----------------------------------------------------------------------------------

template <auto op, class V>
struct ReduceRule {
  using Value = V;
  static constexpr std::string_view kName = kOperationName<"reduce", op>;
  static constexpr std::string_view kGroupName = kOperationName<"reduce_group", op>;
  static constexpr std::string_view kLevelName = kOperationName<"reduce_level", op>;
  template <class S, class T>
  static Value of(S&, const ListNode<T, S>& node) {
    return Value(node.value());
  }
  template <class S>
  static Value join(S& s, const Value& a, const Value& b) {
    return apply_two<op>(s, a, b);
  }
};

template <auto f, auto op, class V>
struct MapReduceRule : ReduceRule<op, V> {
  static constexpr std::string_view kName = kOperationName<"map_reduce", f, op>;
  static constexpr std::string_view kGroupName = kOperationName<"map_reduce_group", f, op>;
  static constexpr std::string_view kLevelName = kOperationName<"map_reduce_level", f, op>;
  template <class S, class T>
  static V of(S& s, const ListNode<T, S>& node) {
    return V(apply<f>(s, node));
  }
};

struct SizeRule {
  using Value = std::size_t;
  static constexpr std::string_view kName = "size";
  static constexpr std::string_view kGroupName = "size_group";
  static constexpr std::string_view kLevelName = "size_level";
  template <class S, class T>
  static Value of(S&, const ListNode<T, S>&) {
    return 1;
  }
  template <class S>
  static Value join(S&, Value a, Value b) {
    return a + b;
  }
};

template <auto p, class T, class S>
struct FindRule {
  using Value = const ListNode<T, S>*;
  static constexpr std::string_view kName = kOperationName<"find_if", p>;
  static constexpr std::string_view kGroupName = kOperationName<"find_if_group", p>;
  static constexpr std::string_view kLevelName = kOperationName<"find_if_level", p>;
  static Value of(S& s, const ListNode<T, S>& node) { return apply<p>(s, node) ? &node : nullptr; }
  static Value join(S&, Value a, Value b) { return a != nullptr ? a : b; }
};

struct Fetch {
  static constexpr std::string_view kName = "fetch";
  template <class S, class M>
  auto operator()(S& s, M mod) const {
    return s.read(mod);
  }
};

}  // namespace detail

/// The value of a modifiable that a child of this call has written, as a result of a child of its
/// own: the caller needs no time stamp behind the child. It depends on the value, as by read().
template <class S, class M>
[[nodiscard]] decltype(auto) fetch(S& s, M mod) {
  return s.template call<detail::Fetch{}>(mod);
}

/// A modifiable with op(init, op(x1, op(x2, ...))), with any brackets; `init` if the list is empty.
/// The elements are converted to the type of `init`, which must be hashable, as an argument.
/// Requires: op is associative.
template <auto op, class S, class T, class V>
[[nodiscard]] auto reduce(S& s, List<T, S> list, V init) {
  return detail::reduce_by<detail::ReduceRule<op, V>>(s, list, std::move(init));
}

/// As reduce(), of the results of f for the elements.
template <auto f, auto op, class S, class T, class V>
[[nodiscard]] auto map_reduce(S& s, List<T, S> list, V init) {
  return detail::reduce_by<detail::MapReduceRule<f, op, V>>(s, list, std::move(init));
}

/// A modifiable with the number of elements.
template <class S, class T>
[[nodiscard]] auto size(S& s, List<T, S> list) {
  return detail::reduce_by<detail::SizeRule>(s, list, 0);
}

/// A modifiable with the first element for which p holds, as a pointer to its node; null: none.
template <auto p, class S, class T>
[[nodiscard]] auto find_if(S& s, List<T, S> list) {
  return detail::reduce_by<detail::FindRule<p, T, S>>(s, list, nullptr);
}

}  // namespace sac
