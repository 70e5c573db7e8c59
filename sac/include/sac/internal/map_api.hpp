// The queries of maps for traced functions, the same for traced and plain maps.
#pragma once

#include <cstddef>
#include <optional>
#include <ostream>
#include <sstream>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "sac/internal/map_queries.hpp"
#include "sac/list/list.hpp"

namespace sac::detail {

// A map as an argument of a call.
template <class M>
struct MapRef {
  M* map = nullptr;
  M* operator->() const noexcept { return map; }
  friend bool operator==(const MapRef&, const MapRef&) = default;
  friend std::uint64_t hash_value(const MapRef& ref) noexcept { return ref.map->number(); }
  friend void label_bytes(LabelSink& sink, const MapRef& ref) { sink.text(ref.map->name()); }
  friend std::ostream& operator<<(std::ostream& out, const MapRef& ref) {
    return out << ref.map->name();
  }
};

template <auto f>
struct ForKeysFrom {
  static constexpr std::string_view kName = kOperationName<"for_each", f>;
  template <class S, class M, class K>
  void operator()(S& s, MapRef<M> map, const K& key) const {
    const std::optional<K> next = map->next_key(s, {.above = key});
    if constexpr (requires { f(s, key); }) {
      f(s, key);
    } else {
      f(s, key, map->get(s, key));
    }
    if (next) s.template tail<ForKeysFrom{}>(map, *next);
  }
};

template <auto f>
struct ForKeys {
  static constexpr std::string_view kName = kOperationName<"for_each", f>;
  template <class S, class M>
  void operator()(S& s, MapRef<M> map) const {
    if (const auto first = map->next_key(s, {})) s.template tail<ForKeysFrom<f>{}>(map, *first);
  }
};

// The node of an entry, and those behind. An entry that gets another value gets another node.
template <class K, class V>
struct ListEntry {
  static constexpr std::string_view kName = "list_entry";
  using Pair = std::pair<K, V>;
  template <class S, class M>
  void operator()(S& s, ListNode<Pair, S>& self, MapRef<M> map, const K& key,
                  const V& value) const {
    if (!self.holds()) {
      const std::uint64_t hash = hash_key(key);
      self.hold({hash != 0 ? hash : 1}, Pair(key, value));
    }
    link(s, self, map, map->first(s, {.above = key}));
  }
  template <class S, class M>
  static void link(S& s, ListNode<Pair, S>& self, MapRef<M> map, const std::optional<Pair>& next) {
    s.write(self.next, next ? &s.template tail_make<ListNode<Pair, S>, ListEntry{}>(
                                  map, next->first, next->second)
                            : nullptr);
  }
};

template <class K, class V>
struct ListOfMap {
  static constexpr std::string_view kName = "list";
  template <class S, class M>
  void operator()(S& s, ListNode<std::pair<K, V>, S>& self, MapRef<M> map) const {
    ListEntry<K, V>::link(s, self, map, map->first(s, {}));
  }
};

// Self: ask(s, question) returns the answer.
template <class Self, class K, class V, class S, class... M>
class MapApi {
  using Q = QuestionsOf<K, V>;

 public:
  using KeyType = K;
  using ValueType = V;
  using Pair = std::pair<K, V>;

  /// The value of a key, if there is one.
  [[nodiscard]] std::optional<V> find(S& s, const K& key) {
    return ask(s, typename Q::Find{{key}});
  }
  /// The value of a key. Throws: UsageError if there is none.
  [[nodiscard]] V get(S& s, const K& key) {
    const auto& found = ask(s, typename Q::Find{{key}});
    if (found) return *found;
    std::ostringstream text;
    text << "map '" << self().name() << "' has no key ";
    print_argument(text, key);
    if constexpr (S::kTraced) {
      s.guarded([&] { throw UsageError(text.str()); });
    }
    throw UsageError(text.str());
  }
  [[nodiscard]] bool contains(S& s, const K& key) { return ask(s, typename Q::Has{{key}}); }

  /// The number of entries; of those in an interval, for example `{.from = 3, .below = 7}`.
  [[nodiscard]] std::size_t size(S& s) { return count(s, {}); }
  [[nodiscard]] std::size_t count(S& s, const Interval<K>& keys) {
    return ask(s, typename Q::Count{{span_of(keys)}});
  }
  /// The number of entries before a key.
  [[nodiscard]] std::size_t rank(S& s, const K& key) { return count(s, {.below = key}); }
  /// The entry that `r` others come before, if there is one.
  [[nodiscard]] std::optional<Pair> nth(S& s, std::size_t r) {
    return ask(s, typename Q::Nth{{r}});
  }

  /// The first and last entry in an interval, if there is one; of all, or beside a key.
  [[nodiscard]] std::optional<Pair> first(S& s, const Interval<K>& keys = {}) {
    return ask(s, typename Q::First{{span_of(keys)}});
  }
  [[nodiscard]] std::optional<Pair> last(S& s, const Interval<K>& keys = {}) {
    return ask(s, typename Q::Last{{span_of(keys)}});
  }
  [[nodiscard]] std::optional<Pair> next(S& s, const K& key) { return first(s, {.above = key}); }
  [[nodiscard]] std::optional<Pair> previous(S& s, const K& key) { return last(s, {.below = key}); }
  /// The first key in an interval: its value may change.
  [[nodiscard]] std::optional<K> next_key(S& s, const Interval<K>& keys) {
    return ask(s, typename Q::FirstKey{{span_of(keys)}});
  }

  /// The entries of the `n` greatest keys, the greatest first; of the least, the least first.
  [[nodiscard]] std::vector<Pair> top(S& s, std::size_t n) { return ask(s, typename Q::Top{{n}}); }
  [[nodiscard]] std::vector<Pair> bottom(S& s, std::size_t n) {
    return ask(s, typename Q::Bottom{{n}});
  }
  /// The entries in an interval.
  [[nodiscard]] std::vector<Pair> range(S& s, const Interval<K>& keys) {
    return ask(s, typename Q::Range{{span_of(keys)}});
  }
  /// The entries in an interval joined by a monoid, one of those that the type of the map names.
  template <class Fold>
  [[nodiscard]] auto fold(S& s, const Interval<K>& keys) {
    static_assert((std::is_same_v<Fold, M> || ...),
                  "the type of a map names the monoids of its folds: Map<K, V, Fold>");
    return ask(s, typename Q::template FoldOf<Fold>{{span_of(keys)}});
  }

  /// Calls f(scope, key) or f(scope, key, value) for every entry, in order of the keys, each in a
  /// traced call of its own, which comes and goes with its key.
  template <auto f>
  void for_each(S& s) {
    s.template call<ForKeys<f>{}>(MapRef<Self>{&self()});
  }
  /// The entries as a list of pairs (list/operations.hpp), in order of the keys. Values need a
  /// hash.
  [[nodiscard]] List<Pair, S> list(S& s) {
    return List<Pair, S>(
        s.template make<ListNode<Pair, S>, ListOfMap<K, V>{}>(MapRef<Self>{&self()}));
  }

 private:
  Self& self() noexcept { return static_cast<Self&>(*this); }
  template <class Question>
  decltype(auto) ask(S& s, Question question) {
    return self().ask(s, std::move(question));
  }
};

}  // namespace sac::detail
