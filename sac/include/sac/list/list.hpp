// Lists of elements with ids: the form in which programs see a Sequence, and the arguments and
// results of the operations on lists (list/operations.hpp, list/reduce.hpp, list/sort.hpp).
//
// A list is given by its header, the node before the first. The links are modifiables. The content
// of a node, an element, is fixed: an element that gets another value gets another node. So as the
// key of a call, a pointer to a node stands for id and value.
//
// An element keeps its id from the sequence through all operations; the ids in a list are distinct.
// Operations that divide lists at random flip their coins by the id [Aca05, §8.1]: not by the
// position, which insertions change, nor by addresses, which differ between runs.
//
//   for (const auto& e : list.view(engine)) use(e.id(), e.value());      // from outside
//   for (auto* e = s.read(list.header()->next); e; e = s.read(e->next))  // in a traced function
#pragma once

#include <array>
#include <bit>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <new>
#include <ostream>
#include <string_view>
#include <type_traits>
#include <utility>

#include "sac/mod.hpp"
#include "sac/plain.hpp"

namespace sac {

/// The id of an element of a sequence; 0 is none.
struct ElementId {
  std::uint64_t value = 0;
  friend auto operator<=>(const ElementId&, const ElementId&) = default;
  friend std::uint64_t hash_value(const ElementId& id) noexcept { return id.value; }
  friend std::ostream& operator<<(std::ostream& out, const ElementId& id) {
    return out << '#' << id.value;
  }
};

/// An id and a value, or nothing.
template <class T>
class Element {
 public:
  static_assert(alignof(T) <= 8, "elements lie in the arena, which is aligned to 8 bytes");

  Element() noexcept {}
  Element(const Element&) = delete;
  Element& operator=(const Element&) = delete;
  ~Element() { drop(); }

  [[nodiscard]] bool holds() const noexcept { return id_.value != 0; }
  /// The id; 0 if it holds nothing.
  [[nodiscard]] ElementId id() const noexcept { return id_; }
  /// The value. Requires: holds().
  [[nodiscard]] const T& value() const noexcept { return value_; }

  /// Stores an id and a value. Requires: id is not 0. Throws: exceptions of T's constructor; the
  /// element then holds nothing.
  template <class Value>
  void hold(ElementId id, Value&& value) {
    drop();
    ::new (static_cast<void*>(&value_)) T(std::forward<Value>(value));
    id_ = id;
  }
  void drop() noexcept {
    if (holds()) value_.~T();
    id_ = {};
  }

 private:
  ElementId id_;
  union {
    T value_;
  };
};

/// An element and the link to the next node; a header holds nothing.
template <class T, class S = Scope>
struct ListNode : Element<T> {
  typename S::template CellType<const ListNode*> next;  ///< null: the end
};

namespace detail {

template <class Host>
struct ScopeOfHost {
  using type = Host;
};
template <>
struct ScopeOfHost<Engine> {
  using type = Scope;
};

}  // namespace detail

/// The scope of the programs of a host, which is an Engine or a PlainScope.
template <class Host>
using ScopeOf = typename detail::ScopeOfHost<Host>::type;

/// The elements of a list as a forward range, read from outside.
template <class Host, class Node>
class ListView {
 public:
  class iterator {
   public:
    using value_type = Node;
    using difference_type = std::ptrdiff_t;
    iterator() = default;
    iterator(Host& host, const Node* at) : host_(&host), at_(at) {}
    [[nodiscard]] const Node& operator*() const noexcept { return *at_; }
    [[nodiscard]] const Node* operator->() const noexcept { return at_; }
    iterator& operator++() {
      at_ = host_->get(at_->next);
      return *this;
    }
    iterator operator++(int) { return {*host_, std::exchange(at_, host_->get(at_->next))}; }
    friend bool operator==(const iterator& a, const iterator& b) noexcept { return a.at_ == b.at_; }

   private:
    Host* host_ = nullptr;
    const Node* at_ = nullptr;
  };

  ListView(Host& host, const Node& header) : host_(host), header_(header) {}
  [[nodiscard]] iterator begin() const { return {host_, host_.get(header_.next)}; }
  [[nodiscard]] iterator end() const noexcept { return {}; }

 private:
  Host& host_;
  const Node& header_;
};

/// A list, given by its header: 8 bytes, cheap to copy; it can be an argument of calls and a value
/// of modifiables. It is valid while the sequence or the call that made it exists.
template <class T, class S = Scope>
class List {
 public:
  using Value = T;
  using Node = ListNode<T, S>;

  /// Null: no list.
  List() = default;
  explicit List(const Node& header) noexcept : header_(&header) {}

  [[nodiscard]] const Node* header() const noexcept { return header_; }
  explicit operator bool() const noexcept { return header_ != nullptr; }
  /// The elements, read from outside while the host does not run. Requires: the list is not null.
  template <class Host>
  [[nodiscard]] ListView<Host, Node> view(Host& host) const {
    return {host, *header_};
  }

  friend bool operator==(const List&, const List&) = default;
  friend std::uint64_t hash_value(const List& list) noexcept { return hash_argument(list.header_); }
  friend void label_bytes(LabelSink& sink, const List& list) { sink.address(list.header_); }
  friend void print_argument(std::ostream& out, const List& list, const void* neighbour) {
    sac::print_argument(out, list.header_, neighbour);
  }

 private:
  const Node* header_ = nullptr;
};

// --- Shared by the operations ----------------------------------------------------------------

namespace detail {

/// The number of heads in a row of the coin of an element: k with probability 1/2^(k+1); for a
/// header, always heads.
template <class T>
[[nodiscard]] int heads(const Element<T>& e) noexcept {
  return e.holds() ? std::countr_zero(mix(e.id().value)) : 1000;
}

/// Whether f takes only the value of an element, and the parameters: its result is then fixed.
template <auto f, class T, class... P>
inline constexpr bool kOfValueAlone = requires(const T& value, const P&... with) {
  f(value, with...);
};

/// Applies f to an element: f(value), f(scope, value) or f(scope, id, value), and the parameters.
template <auto f, class S, class T, class... P>
decltype(auto) apply(S& s, const Element<T>& e, const P&... with) {
  if constexpr (kOfValueAlone<f, T, P...>) {
    return f(e.value(), with...);
  } else if constexpr (requires { f(s, e.value(), with...); }) {
    return f(s, e.value(), with...);
  } else {
    return f(s, e.id(), e.value(), with...);
  }
}

/// Applies op to two values: op(a, b) or op(scope, a, b).
template <auto op, class S, class A, class B>
decltype(auto) apply_two(S& s, const A& a, const B& b) {
  if constexpr (requires { op(a, b); }) {
    return op(a, b);
  } else {
    return op(s, a, b);
  }
}

template <std::size_t N>
struct FixedText {
  char text[N];
  consteval FixedText(const char (&from)[N]) {
    for (std::size_t i = 0; i < N; ++i) text[i] = from[i];
  }
};

// `operation f`: the name of the operation with these functions, composed at compile time. It omits
// template arguments, which compilers spell differently.
template <FixedText Operation, auto... f>
struct OperationName {
  template <auto g>
  static constexpr std::string_view kShort =
      function_name<g>().substr(0, function_name<g>().find('<'));
  static constexpr std::string_view kOperation{Operation.text, sizeof(Operation.text) - 1};
  static constexpr auto kText = [] {
    std::array<char, (kOperation.size() + ... + (1 + kShort<f>.size()))> joined{};
    std::size_t n = 0;
    const auto add = [&](std::string_view part) {
      for (const char c : part) joined[n++] = c;
    };
    add(kOperation);
    ((add(" "), add(kShort<f>)), ...);
    return joined;
  }();
};
template <FixedText Operation, auto... f>
inline constexpr std::string_view kOperationName{OperationName<Operation, f...>::kText.data(),
                                                 OperationName<Operation, f...>::kText.size()};

}  // namespace detail

}  // namespace sac
