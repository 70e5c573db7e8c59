// The map of plain runs: what has been contributed, and which keys have been looked at. It refuses
// what a traced map refuses.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "sac/internal/map_api.hpp"
#include "sac/plain.hpp"

namespace sac::detail {

// A set of keys as disjoint intervals.
template <class K>
class KeySet {
 public:
  [[nodiscard]] bool contains(const K& key) const {
    const auto behind = spans_.upper_bound(Span<K>::from(key));
    return behind != spans_.begin() && std::prev(behind)->contains(key);
  }
  void add(Span<K> span) {
    auto at = spans_.lower_bound(span);
    if (at != spans_.begin() && meet(*std::prev(at), span)) --at;
    while (at != spans_.end() && (at->begins_before(span) || meet(span, *at))) {
      if (at->begins_before(span)) span.low = at->low, span.low_open = at->low_open;
      if (span.ends_before(*at)) span.high = at->high, span.high_open = at->high_open;
      at = spans_.erase(at);
    }
    spans_.insert(at, std::move(span));
  }

 private:
  struct Before {
    bool operator()(const Span<K>& a, const Span<K>& b) const { return a.begins_before(b); }
  };
  // Whether no key lies between. Requires: b does not begin before a.
  static bool meet(const Span<K>& a, const Span<K>& b) {
    if (!a.high || !b.low || *b.low < *a.high) return true;
    return !(*a.high < *b.low) && !(a.high_open && b.low_open);
  }
  std::set<Span<K>, Before> spans_;
};

template <class K, class V, class Group, class... M>
class PlainMap final : public MapApi<PlainMap<K, V, Group, M...>, K, V, PlainScope, M...> {
 public:
  static constexpr bool kSums = !std::is_void_v<Group>;

  PlainMap(PlainScope&, std::string name) : name_(std::move(name)) {}
  PlainMap(const PlainMap&) = delete;
  PlainMap& operator=(const PlainMap&) = delete;

  void set(const K& key, V value) {
    if constexpr (kSums) {
      const auto old = outside_.find(key);
      if (old != outside_.end()) erase(key);
      contribute(key, value);
    } else {
      entries_.insert_or_assign(key, value);
    }
    outside_.insert_or_assign(key, std::move(value));
    order_.clear();
  }
  void erase(const K& key) {
    const auto old = outside_.find(key);
    if (old == outside_.end()) throw UsageError("map: erase: the outside has not set this key");
    if constexpr (kSums) {
      const auto entry = entries_.find(key);
      entry->second.value = Group::minus(entry->second.value, old->second);
      if (--entry->second.parts == 0) entries_.erase(entry);
    } else {
      entries_.erase(key);
    }
    outside_.erase(old);
    order_.clear();
  }
  void put(PlainScope&, const K& key, const V& value) requires(!kSums) {
    require_unseen(key);
    contribute(key, value);
  }
  void add(PlainScope&, const K& key, const V& value) requires kSums {
    require_unseen(key);
    contribute(key, value);
  }

  using MapApi<PlainMap, K, V, PlainScope, M...>::find;
  using MapApi<PlainMap, K, V, PlainScope, M...>::size;
  [[nodiscard]] const V* find(const K& key) const { return at(key).value; }
  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }
  [[nodiscard]] std::vector<std::pair<K, V>> entries() const {
    return typename QuestionsOf<K, V>::Range{}.of(*this);
  }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

  // --- For the questions (map_queries.hpp)

  using View = EntryView<K, V>;
  [[nodiscard]] View at(const K& key) const { return view(entries_.find(key)); }
  [[nodiscard]] View first_in(const Span<K>& span) const {
    const auto at = begin_of(span);
    return at != entries_.end() && !span.is_above(at->first) ? view(at) : View{};
  }
  [[nodiscard]] View last_in(const Span<K>& span) const {
    const auto end = end_of(span);
    if (end == entries_.begin()) return {};
    const auto at = std::prev(end);
    return !span.is_below(at->first) ? view(at) : View{};
  }
  [[nodiscard]] std::size_t count_in(const Span<K>& span) const {
    const auto& order = in_order();
    const auto from = std::partition_point(order.begin(), order.end(),
                                           [&](auto at) { return span.is_below(at->first); });
    const auto to = std::partition_point(order.begin(), order.end(),
                                         [&](auto at) { return !span.is_above(at->first); });
    return to > from ? static_cast<std::size_t>(to - from) : 0;
  }
  [[nodiscard]] View at_rank(std::size_t r) const {
    return r < size() ? view(in_order()[r]) : View{};
  }
  template <class Visit>
  void for_each_in(const Span<K>& span, Visit&& visit) const {
    for (auto at = begin_of(span); at != entries_.end() && !span.is_above(at->first); ++at) {
      visit(at->first, at->second.value);
    }
  }
  // In the shape of the treap of the keys (map_entries.hpp): the parts on the stack have descending
  // priorities, and each has what lies to the left of its own key, and that.
  template <class Fold>
  [[nodiscard]] typename Fold::Value fold_in(const Span<K>& span) const {
    using Joined = typename Fold::Value;
    struct Part {
      std::uint64_t priority;
      Joined value;
    };
    std::vector<Part> stack;
    const auto join_until = [&](std::uint64_t priority) {
      std::optional<Joined> below;
      while (!stack.empty() && stack.back().priority < priority) {
        below = below ? Fold::join(stack.back().value, *below) : stack.back().value;
        stack.pop_back();
      }
      return below;
    };
    for_each_in(span, [&](const K& key, const V& value) {
      const std::uint64_t priority = hash_key(key);
      const std::optional<Joined> left = join_until(priority);
      Joined own = Fold::of(key, value);
      stack.push_back({priority, left ? Fold::join(*left, own) : std::move(own)});
    });
    if (stack.empty()) return Fold::none();
    Joined all = std::move(stack.back().value);
    for (stack.pop_back(); !stack.empty(); stack.pop_back()) {
      all = Fold::join(stack.back().value, all);
    }
    return all;
  }

 private:
  friend class MapApi<PlainMap, K, V, PlainScope, M...>;
  struct Value {
    V value;
    std::size_t parts = 1;
    Value(const V& v) : value(v) {}
  };
  using Entries = std::map<K, Value>;
  using At = typename Entries::const_iterator;

  template <class Q>
  typename Q::Answer ask(PlainScope&, const Q& question) {
    auto answer = question.of(*this);
    seen_.add(question.span(answer));
    return answer;
  }
  void require_unseen(const K& key) const {
    if (!seen_.contains(key)) return;
    throw UsageError("map '" + name_ + "': a key is put behind a query that depends on it");
  }
  void contribute(const K& key, const V& value) {
    const auto [at, fresh] = entries_.try_emplace(key, value);
    if (fresh) return order_.clear();
    if constexpr (kSums) {
      at->second.value = Group::plus(at->second.value, value);
      ++at->second.parts;
    } else if (!identical(at->second.value, value)) {
      throw UsageError("map '" + name_ + "': two values are put for one key");
    }
  }

  [[nodiscard]] View view(At at) const {
    return at != entries_.end() ? View{&at->first, &at->second.value} : View{};
  }
  [[nodiscard]] At begin_of(const Span<K>& span) const {
    if (!span.low) return entries_.begin();
    return span.low_open ? entries_.upper_bound(*span.low) : entries_.lower_bound(*span.low);
  }
  [[nodiscard]] At end_of(const Span<K>& span) const {
    if (!span.high) return entries_.end();
    return span.high_open ? entries_.lower_bound(*span.high) : entries_.upper_bound(*span.high);
  }
  [[nodiscard]] const std::vector<At>& in_order() const {
    if (order_.size() != entries_.size()) {
      order_.clear();
      for (auto at = entries_.begin(); at != entries_.end(); ++at) order_.push_back(at);
    }
    return order_;
  }

  std::string name_;
  Entries entries_;
  std::map<K, V> outside_;
  KeySet<K> seen_;
  mutable std::vector<At> order_;  // all entries; empty: not known
};

}  // namespace sac::detail
