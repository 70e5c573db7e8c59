// What a call may ask of a map: the questions, each with its answer and its span, the interval of
// keys on which the answer depends. Traced and plain maps answer them alike (map.hpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "sac/agenda.hpp"
#include "sac/internal/same.hpp"
#include "sac/label.hpp"

namespace sac {

/// An interval of keys, for example `{.from = 3, .below = 7}`; what is not given is not bounded.
template <class K>
struct Interval {
  std::optional<K> from{};   ///< at least
  std::optional<K> above{};  ///< more than
  std::optional<K> to{};     ///< at most
  std::optional<K> below{};  ///< less than
};

namespace detail {

template <class K>
bool same_key(const K& a, const K& b) {
  return !(a < b) && !(b < a);
}

// An interval with at most one bound on each side.
template <class K>
struct Span {
  std::optional<K> low{};
  std::optional<K> high{};
  bool low_open = false;
  bool high_open = false;

  static Span everything() { return {}; }
  static Span from(K low) { return {.low = std::move(low)}; }
  static Span up_to(K high) { return {.high = std::move(high)}; }
  static Span of(const K& key) { return {.low = key, .high = key}; }

  [[nodiscard]] bool is_below(const K& key) const {  // the key is
    return low && (low_open ? !(*low < key) : key < *low);
  }
  [[nodiscard]] bool is_above(const K& key) const {
    return high && (high_open ? !(key < *high) : *high < key);
  }
  [[nodiscard]] bool contains(const K& key) const { return !is_below(key) && !is_above(key); }

  // Whether this begins before `other`.
  [[nodiscard]] bool begins_before(const Span& other) const {
    if (!low || !other.low) return !low && other.low;
    if (*low < *other.low) return true;
    return !(*other.low < *low) && !low_open && other.low_open;
  }
  [[nodiscard]] bool ends_before(const Span& other) const {
    if (!high || !other.high) return high.has_value() && !other.high;
    if (*high < *other.high) return true;
    return !(*other.high < *high) && high_open && !other.high_open;
  }
  friend bool operator==(const Span& a, const Span& b) {
    return !a.begins_before(b) && !b.begins_before(a) && !a.ends_before(b) && !b.ends_before(a);
  }
};

// Of two bounds on one side, the tighter one.
template <class K>
Span<K> span_of(const Interval<K>& i) {
  Span<K> span;
  span.low_open = i.above && (!i.from || !(*i.above < *i.from));
  span.low = span.low_open ? i.above : i.from;
  span.high_open = i.below && (!i.to || !(*i.to < *i.below));
  span.high = span.high_open ? i.below : i.to;
  return span;
}

// An entry of a map; null: there is none.
template <class K, class V>
struct EntryView {
  const K* key = nullptr;
  const V* value = nullptr;
  [[nodiscard]] std::optional<std::pair<K, V>> copy() const {
    return key != nullptr ? std::optional(std::pair<K, V>(*key, *value)) : std::nullopt;
  }
};

// --- Answers -------------------------------------------------------------------------------------

template <class T>
bool same_answer(const T& a, const T& b) {
  return identical(a, b);
}
template <class K, class V>
bool same_answer(const std::pair<K, V>& a, const std::pair<K, V>& b) {
  return identical(a.first, b.first) && identical(a.second, b.second);
}
template <class T>
bool same_answer(const std::optional<T>& a, const std::optional<T>& b) {
  return a.has_value() == b.has_value() && (!a || same_answer(*a, *b));
}
template <class T>
bool same_answer(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const T& x, const T& y) { return same_answer(x, y); });
}

template <class T>
void name_answer(LabelSink& sink, const T& answer) {
  name_argument(sink, answer);
}
template <class T>
void name_answer(LabelSink& sink, const std::optional<T>& answer) {
  sink.number(answer.has_value());
  if (answer) name_argument(sink, *answer);
}

template <class T>
void print_answer(std::ostream& out, const T& answer) {
  print_argument(out, answer);
}
template <class K, class V>
void print_answer(std::ostream& out, const std::pair<K, V>& answer) {
  print_argument(out, answer.first);
  out << ": ";
  print_argument(out, answer.second);
}
template <class T>
void print_answer(std::ostream& out, const std::optional<T>& answer) {
  answer ? print_answer(out, *answer) : void(out << "nothing");
}
template <class T>
void print_answer(std::ostream& out, const std::vector<T>& answer) {
  out << answer.size() << " entries";
}

// --- Questions -----------------------------------------------------------------------------------
//
//   using Answer;  static constexpr std::string_view kName;
//   template <class Contents> Answer of(const Contents&) const;
//   Span<K> span(const Answer&) const;      // of two that give the same answer, the same

template <class K, class V>
struct QuestionsOf {
  using Pair = std::pair<K, V>;
  using Pairs = std::vector<Pair>;

  struct OfKey {
    K key;
    friend bool operator==(const OfKey& a, const OfKey& b) { return same_key(a.key, b.key); }
  };
  struct OfSpan {
    Span<K> asked;
    friend bool operator==(const OfSpan&, const OfSpan&) = default;
  };
  struct OfRank {
    std::size_t rank;
    friend bool operator==(const OfRank&, const OfRank&) = default;
  };

  struct Find : OfKey {
    static constexpr std::string_view kName = "find";
    using Answer = std::optional<V>;
    template <class Contents>
    Answer of(const Contents& c) const {
      const auto e = c.at(this->key);
      return e.key != nullptr ? Answer(*e.value) : std::nullopt;
    }
    Span<K> span(const Answer&) const { return Span<K>::of(this->key); }
  };
  struct Has : OfKey {
    static constexpr std::string_view kName = "contains";
    using Answer = bool;
    template <class Contents>
    Answer of(const Contents& c) const {
      return c.at(this->key).key != nullptr;
    }
    Span<K> span(const Answer&) const { return Span<K>::of(this->key); }
  };
  struct Count : OfSpan {
    static constexpr std::string_view kName = "count";
    using Answer = std::size_t;
    template <class Contents>
    Answer of(const Contents& c) const {
      return c.count_in(this->asked);
    }
    Span<K> span(const Answer&) const { return this->asked; }
  };
  struct First : OfSpan {
    static constexpr std::string_view kName = "first";
    using Answer = std::optional<Pair>;
    template <class Contents>
    Answer of(const Contents& c) const {
      return c.first_in(this->asked).copy();
    }
    Span<K> span(const Answer& a) const { return up_to(this->asked, a ? &a->first : nullptr); }
  };
  struct FirstKey : OfSpan {
    static constexpr std::string_view kName = "first key";
    using Answer = std::optional<K>;
    template <class Contents>
    Answer of(const Contents& c) const {
      const auto e = c.first_in(this->asked);
      return e.key != nullptr ? Answer(*e.key) : std::nullopt;
    }
    Span<K> span(const Answer& a) const { return up_to(this->asked, a ? &*a : nullptr); }
  };
  struct Last : OfSpan {
    static constexpr std::string_view kName = "last";
    using Answer = std::optional<Pair>;
    template <class Contents>
    Answer of(const Contents& c) const {
      return c.last_in(this->asked).copy();
    }
    Span<K> span(const Answer& a) const {
      Span<K> s = this->asked;
      if (a) s.low = a->first, s.low_open = false;
      return s;
    }
  };
  struct Nth : OfRank {
    static constexpr std::string_view kName = "nth";
    using Answer = std::optional<Pair>;
    template <class Contents>
    Answer of(const Contents& c) const {
      return c.at_rank(this->rank).copy();
    }
    Span<K> span(const Answer& a) const {
      return a ? Span<K>::up_to(a->first) : Span<K>::everything();
    }
  };
  // The `rank` least entries, or the greatest.
  template <bool kGreatest>
  struct Extremes : OfRank {
    static constexpr std::string_view kName = kGreatest ? "top" : "bottom";
    using Answer = Pairs;
    template <class Contents>
    Answer of(const Contents& c) const {
      Pairs pairs;
      for (std::size_t i = 0; i < this->rank && i < c.size(); ++i) {
        pairs.push_back(*c.at_rank(kGreatest ? c.size() - 1 - i : i).copy());
      }
      return pairs;
    }
    Span<K> span(const Answer& a) const {
      if (a.empty() || a.size() != this->rank) return Span<K>::everything();
      return kGreatest ? Span<K>::from(a.back().first) : Span<K>::up_to(a.back().first);
    }
  };
  using Bottom = Extremes<false>;
  using Top = Extremes<true>;
  struct Range : OfSpan {
    static constexpr std::string_view kName = "range";
    using Answer = Pairs;
    template <class Contents>
    Answer of(const Contents& c) const {
      Pairs pairs;
      c.for_each_in(this->asked,
                    [&](const K& key, const V& value) { pairs.emplace_back(key, value); });
      return pairs;
    }
    Span<K> span(const Answer&) const { return this->asked; }
  };
  template <class M>
  struct FoldOf : OfSpan {
    static constexpr std::string_view kName = "fold";
    using Answer = typename M::Value;
    template <class Contents>
    Answer of(const Contents& c) const {
      return c.template fold_in<M>(this->asked);
    }
    Span<K> span(const Answer&) const { return this->asked; }
  };

 private:
  static Span<K> up_to(Span<K> s, const K* end) {
    if (end != nullptr) s.high = *end, s.high_open = false;
    return s;
  }
};

/// All questions, in the order of their numbers.
template <class K, class V, class... M>
using Questions = std::tuple<typename QuestionsOf<K, V>::Find, typename QuestionsOf<K, V>::Has,
                             typename QuestionsOf<K, V>::Count, typename QuestionsOf<K, V>::First,
                             typename QuestionsOf<K, V>::FirstKey, typename QuestionsOf<K, V>::Last,
                             typename QuestionsOf<K, V>::Nth, typename QuestionsOf<K, V>::Bottom,
                             typename QuestionsOf<K, V>::Top, typename QuestionsOf<K, V>::Range,
                             typename QuestionsOf<K, V>::template FoldOf<M>...>;

template <class T, class Tuple>
inline constexpr std::size_t kIndexOf = 0;
template <class T, class... Rest>
inline constexpr std::size_t kIndexOf<T, std::tuple<T, Rest...>> = 0;
template <class T, class First, class... Rest>
inline constexpr std::size_t kIndexOf<T, std::tuple<First, Rest...>> =
    1 + kIndexOf<T, std::tuple<Rest...>>;

// --- The options of a map ------------------------------------------------------------------------

template <class O, class V>
concept GroupOf = requires(const V& a, const V& b) {
  { O::plus(a, b) } -> std::convertible_to<V>;
  { O::minus(a, b) } -> std::convertible_to<V>;
};
template <class O, class K, class V>
concept MonoidOf = requires(const K& key, const V& value, const typename O::Value& part) {
  { O::none() } -> std::convertible_to<typename O::Value>;
  { O::of(key, value) } -> std::convertible_to<typename O::Value>;
  { O::join(part, part) } -> std::convertible_to<typename O::Value>;
};

// The priority of a key in canonical folds, a function of the key alone.
template <class T>
std::uint64_t hash_key(const T& key) {
  return mix(hash_argument(key) + 0x9e3779b97f4a7c15u);
}

}  // namespace detail

}  // namespace sac
