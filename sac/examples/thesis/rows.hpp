// A traceable data type: lists of rows by key, which calls put, and which calls read one by one.
//
// The thesis's map P from quadtree cells to points is one; so is the tree itself (a cell that is
// split has a row), and the way back from points to cells.
//
// (1) A row is there from the earliest call on that puts it, while one does; a call does not see
//     what it puts itself.
// (2) A call that reads the first row, or the row behind another, runs again only if that answer
//     changes: a row put into a list of n makes one reader run again, not n.
// (3) The rows of a key have a canonical order (Order). That a row comes costs O(log) of the list,
//     and O(1) for each row behind it that was put later: an order that has the newest first makes
//     this O(1).
// A call that has children puts the same rows each time it runs: what such a call has not yet put
// again is not hidden from them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "sac/presence.hpp"
#include "sac/sac.hpp"

namespace examples::thesis {

/// `Order::descends(key)`: whether the rows of that key are in descending order of `<`.
template <class Item, class Order>
struct RowsBefore {
  bool descends;
  bool operator()(const Item& a, const Item& b) const { return descends ? b < a : a < b; }
};

template <class Key>
struct HashKey {
  std::size_t operator()(const Key& key) const { return sac::hash_argument(key); }
};

/// Key: == and hash_value. Item: <, ==, trivially destructible.
template <class S, class Key, class Item, class Order>
class Rows;

/// An object of this type outlives the trace.
template <class Key, class Item, class Order>
class Rows<sac::Scope, Key, Item, Order> final : public sac::Structure {
 public:
  explicit Rows(sac::Engine& engine)
      : engine_(engine), presences_(engine), id_(engine.add_structure(*this)) {}
  Rows(const Rows&) = delete;
  Rows& operator=(const Rows&) = delete;

  /// Throws: std::bad_alloc.
  void put(sac::Scope& s, const Key& key, const Item& item);
  [[nodiscard]] std::optional<Item> first(sac::Scope& s, const Key& key) {
    return look(s, key, nullptr);
  }
  [[nodiscard]] std::optional<Item> behind(sac::Scope& s, const Key& key, const Item& item) {
    return look(s, key, &item);
  }
  /// Nobody will read the rows of `key` any more. The trace keeps them.
  void forget(sac::Scope&, const Key&) noexcept {}

  /// Calls visit(key, item) for all rows that are there, for the outside; keys in no order.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const auto& [key, list] : lists_) {
      for (const auto& [item, row] : list.rows) {
        if (row.presence.there()) visit(key, item);
      }
    }
  }

  void retract(sac::Call& call, sac::Edge& edge) noexcept override;
  void finished() noexcept override;
  void label(const sac::Call& call, const sac::Edge& edge, sac::LabelSink& sink) const override;
  void print(const sac::Call& call, const sac::Edge& edge, std::ostream& out) const override;
  void check_invariants() const override;

 private:
  struct Look;
  struct Row {
    sac::Presence presence;
    Look* looks = nullptr;  // that have seen it
  };
  using Map = std::map<Item, Row, RowsBefore<Item, Order>>;
  using Place = typename Map::iterator;
  struct List {
    explicit List(const Key& key) : rows({Order::descends(key)}) {}
    Map rows;
    Look* ends = nullptr;  // looks that have seen no row
  };
  struct Put : sac::ProducerEdge {
    List* list;
    Place row;
  };
  struct Look : sac::Edge {
    sac::Place place;
    List* list;
    Place saw;  // the end: no row
    Look* next;
    Look** link;  // that leads here
    bool from_first;
    Item after;  // else
  };
  static constexpr std::uint8_t kPut = 0;
  static constexpr std::uint8_t kLook = 1;

  [[nodiscard]] List& list_of(const Key& key) { return lists_.try_emplace(key, key).first->second; }
  [[nodiscard]] std::optional<Item> look(sac::Scope& s, const Key& key, const Item* after);
  [[nodiscard]] Look& ask(sac::Scope& s, List& list, const Item* after);
  [[nodiscard]] Place first_seen(List& list, const Item* after, sac::Place by) const;
  [[nodiscard]] static Look*& looks_at(List& list, Place row) {
    return row == list.rows.end() ? list.ends : row->second.looks;
  }
  static void join(Look& look, Place saw) noexcept;
  static void leave(Look& look) noexcept;
  void came(List& list, Place row, const sac::Window& window) noexcept;
  void went(Place row, const sac::Window& window) noexcept;
  void drop_what_is_gone() noexcept;

  sac::Engine& engine_;
  sac::Presences presences_;
  std::uint8_t id_;
  std::unordered_map<Key, List, HashKey<Key>> lists_;
  std::size_t rows_ = 0, gone_ = 0;  // all rows, and those that nobody puts
};

template <class Key, class Item, class Order>
void Rows<sac::Scope, Key, Item, Order>::put(sac::Scope& s, const Key& key, const Item& item) {
  s.guarded([&] {
    List& list = list_of(key);
    const auto same = [&](const Put& p) { return p.list == &list && p.row->first == item; };
    if (s.recall<Put>(id_, kPut, same) != nullptr) return;
    const auto [row, fresh] = list.rows.try_emplace(item);
    if (fresh) ++rows_, ++gone_;
    Put& edge = s.effect<Put>(id_, kPut);
    edge.list = &list;
    edge.row = row;
    if (!row->second.presence.there()) --gone_;
    const auto window = presences_.produced(row->second.presence, edge, s.place());
    if (window) came(list, row, *window);
  });
}

template <class Key, class Item, class Order>
std::optional<Item> Rows<sac::Scope, Key, Item, Order>::look(sac::Scope& s, const Key& key,
                                                             const Item* after) {
  return s.guarded([&]() -> std::optional<Item> {
    List& list = list_of(key);
    Look& look = ask(s, list, after);
    join(look, first_seen(list, after, look.place));
    if (look.saw == list.rows.end()) return std::nullopt;
    return look.saw->first;
  });
}

// The edge of the question, not joined to an answer.
template <class Key, class Item, class Order>
auto Rows<sac::Scope, Key, Item, Order>::ask(sac::Scope& s, List& list, const Item* after)
    -> Look& {
  const auto same = [&](const Look& l) {
    return l.list == &list && l.from_first == (after == nullptr) &&
           (after == nullptr || l.after == *after);
  };
  if (Look* const old = s.recall<Look>(id_, kLook, same, 64)) {
    leave(*old);
    return *old;
  }
  Look& look = s.observe<Look>(id_, kLook);
  look.place = s.place();
  look.list = &list;
  look.from_first = after == nullptr;
  if (after != nullptr) look.after = *after;
  return look;
}

template <class Key, class Item, class Order>
auto Rows<sac::Scope, Key, Item, Order>::first_seen(List& list, const Item* after,
                                                    sac::Place by) const -> Place {
  Place row = after == nullptr ? list.rows.begin() : list.rows.upper_bound(*after);
  while (row != list.rows.end() && !presences_.seen_at(row->second.presence, by)) ++row;
  return row;
}

template <class Key, class Item, class Order>
void Rows<sac::Scope, Key, Item, Order>::join(Look& look, Place saw) noexcept {
  Look*& head = looks_at(*look.list, saw);
  look.saw = saw;
  look.next = head;
  look.link = &head;
  if (head != nullptr) head->link = &look.next;
  head = &look;
}
template <class Key, class Item, class Order>
void Rows<sac::Scope, Key, Item, Order>::leave(Look& look) noexcept {
  *look.link = look.next;
  if (look.next != nullptr) look.next->link = look.link;
}

// `row` is seen in the window: who looked past it there saw a row behind it, and none behind one
// that was there before the window.
template <class Key, class Item, class Order>
void Rows<sac::Scope, Key, Item, Order>::came(List& list, Place row,
                                              const sac::Window& window) noexcept {
  for (Place at = std::next(row);; ++at) {
    for (Look* l = looks_at(list, at); l != nullptr; l = l->next) {
      const bool past = l->from_first || list.rows.key_comp()(l->after, row->first);
      if (past && window.contains(engine_, engine_.time(l->place))) {
        engine_.invalidate(l->place, l);
      }
    }
    if (at == list.rows.end()) return;
    const sac::Place birth = at->second.presence.birth();
    if (birth != nullptr && !engine_.precedes(*window.after, engine_.time(birth))) return;
  }
}
template <class Key, class Item, class Order>
void Rows<sac::Scope, Key, Item, Order>::went(Place row, const sac::Window& window) noexcept {
  for (Look* l = row->second.looks; l != nullptr; l = l->next) {
    if (window.contains(engine_, engine_.time(l->place))) engine_.invalidate(l->place, l);
  }
}

template <class Key, class Item, class Order>
void Rows<sac::Scope, Key, Item, Order>::retract(sac::Call&, sac::Edge& edge) noexcept {
  if (edge.kind == kLook) return leave(static_cast<Look&>(edge));
  auto& put = static_cast<Put&>(edge);
  auto& presence = put.row->second.presence;
  const auto window = presences_.retracted(presence, put);
  if (window) went(put.row, *window);
  if (!presence.there()) ++gone_;
}

template <class Key, class Item, class Order>
void Rows<sac::Scope, Key, Item, Order>::finished() noexcept {
  if (gone_ > 1000 && 2 * gone_ > rows_) drop_what_is_gone();
}
template <class Key, class Item, class Order>
void Rows<sac::Scope, Key, Item, Order>::drop_what_is_gone() noexcept {
  for (auto list = lists_.begin(); list != lists_.end();) {
    auto& rows = list->second.rows;
    std::erase_if(rows, [&](const auto& at) {
      const bool gone = !at.second.presence.there() && at.second.looks == nullptr;
      if (gone) --rows_, --gone_;
      return gone;
    });
    list = rows.empty() && list->second.ends == nullptr ? lists_.erase(list) : std::next(list);
  }
}

template <class Key, class Item, class Order>
void Rows<sac::Scope, Key, Item, Order>::label(const sac::Call&, const sac::Edge& edge,
                                               sac::LabelSink& sink) const {
  if (edge.kind != kLook) return;
  const auto& look = static_cast<const Look&>(edge);
  const bool some = look.saw != look.list->rows.end();
  sink.number(some ? 1 : 0);
  if (some) sac::label_arguments(sink, std::tie(look.saw->first));
}
template <class Key, class Item, class Order>
void Rows<sac::Scope, Key, Item, Order>::print(const sac::Call&, const sac::Edge& edge,
                                               std::ostream& out) const {
  if (edge.kind == kPut) {
    out << "puts ";
    return sac::print_argument(out, static_cast<const Put&>(edge).row->first);
  }
  const auto& look = static_cast<const Look&>(edge);
  if (look.saw == look.list->rows.end()) {
    out << "sees the end of a list";
  } else {
    out << "sees ";
    sac::print_argument(out, look.saw->first);
  }
}

template <class Key, class Item, class Order>
void Rows<sac::Scope, Key, Item, Order>::check_invariants() const {
  std::size_t rows = 0, gone = 0;
  const auto check = [&](const Look* looks, auto row) {
    for (const Look* l = looks; l != nullptr; l = l->next) {
      const Item* const after = l->from_first ? nullptr : &l->after;
      SAC_INVARIANT(l->saw == row);
      SAC_INVARIANT(first_seen(*l->list, after, l->place) == row);
    }
  };
  for (const auto& [key, list] : lists_) {
    check(list.ends, list.rows.end());
    for (auto row = list.rows.begin(); row != list.rows.end(); ++row) {
      ++rows;
      if (!row->second.presence.there()) ++gone;
      presences_.check_invariants(row->second.presence);
      check(row->second.looks, row);
    }
  }
  SAC_INVARIANT(rows == rows_ && gone == gone_);
}

/// In a plain run a row is there once it has been put.
template <class Key, class Item, class Order>
class Rows<sac::PlainScope, Key, Item, Order> {
 public:
  explicit Rows(sac::PlainScope&) {}

  void put(sac::PlainScope&, const Key& key, const Item& item) {
    lists_.try_emplace(key, RowsBefore<Item, Order>{Order::descends(key)})
        .first->second.insert(item);
  }
  [[nodiscard]] std::optional<Item> first(sac::PlainScope&, const Key& key) const {
    const auto list = lists_.find(key);
    if (list == lists_.end() || list->second.empty()) return std::nullopt;
    return *list->second.begin();
  }
  [[nodiscard]] std::optional<Item> behind(sac::PlainScope&, const Key& key,
                                           const Item& item) const {
    const auto list = lists_.find(key);
    if (list == lists_.end()) return std::nullopt;
    const auto row = list->second.upper_bound(item);
    return row == list->second.end() ? std::nullopt : std::optional(*row);
  }
  void forget(sac::PlainScope&, const Key& key) { lists_.erase(key); }

  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const auto& [key, list] : lists_) {
      for (const Item& item : list) visit(key, item);
    }
  }

 private:
  std::unordered_map<Key, std::set<Item, RowsBefore<Item, Order>>, HashKey<Key>> lists_;
};

}  // namespace examples::thesis
