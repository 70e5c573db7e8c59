// Map: an ordered map from keys to values that calls fill and query, and that the outside edits.
//
//   sac::Map<int, Order> orders(e, "orders");                  // edited from outside: set, erase
//   sac::Map<std::string, long, sac::Sum> totals(e, "totals");  // calls add to its entries
//   void order(sac::Scope& s, int id, const Order& o) { totals.add(s, o.city, o.amount); }
//   orders.for_each<order>(s);                                 // one call for each entry
//   s.write(best, totals.top(s, 3));                           // the three greatest keys
//
// A query depends on an interval of keys, its span, and on nothing else: a call runs again if an
// entry in the span of one of its queries has changed so that the answer is another one.
//
// (1) A map is filled, then queried, interval by interval: what calls contribute at a key comes
//     before every query whose span contains the key; else it is a UsageError that names both
//     calls. A program may fill keys in an order, and query those before.
// (2) An entry is there as long as something contributes to it. Two puts of one key must have the
//     same value. What is added to a key is summed by a group, which must be exact: sums come in
//     any order. Use integers, not floating-point numbers.
// (3) Keys are in the order of <. The value of a fold is computed in a shape that depends on the
//     keys in its span alone, so it is the same, bit for bit, as from scratch, and in a plain run.
// (4) Cost: O(log) of the entries and queries for each operation; top, bottom, range: for each
//     entry that they return, too. A change at a key puts those calls in doubt whose spans contain
//     the key; each computes its answer anew and compares it.
// (5) Keys need <, ==, a hash and copies; keys that are equal by < are one, and any may be shown;
// values ==. Comparisons of keys, and the functions of a
//     group, should not throw: an exception in the middle of an undo ends the program.
//
// A map must be destroyed before its engine, and not before the engine's last use.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "sac/internal/map_api.hpp"
#include "sac/internal/map_entries.hpp"
#include "sac/internal/plain_map.hpp"
#include "sac/structure.hpp"

namespace sac {

namespace detail {

template <class K, class V, class Group, class... M>
class TracedMap final : public Structure,
                        public MapApi<TracedMap<K, V, Group, M...>, K, V, Scope, M...> {
 public:
  static constexpr bool kSums = !std::is_void_v<Group>;

  /// An empty map. Throws: UsageError if the engine runs, or has too many structures.
  TracedMap(Engine& engine, std::string name)
      : engine_(engine), name_(std::move(name)), entries_(engine), lookers_{engine} {
    engine_.begin_edit("a new map");
    id_ = engine_.add_structure(*this);
  }
  TracedMap(const TracedMap&) = delete;
  TracedMap& operator=(const TracedMap&) = delete;
  ~TracedMap() override;

  // --- Edits from outside
  // All of them throw: UsageError if the engine runs; std::bad_alloc; exceptions of copies.

  /// Gives a key a value; in a map of sums: the part of the outside.
  void set(const K& key, V value);
  /// Undoes set(). Throws: UsageError if the outside has not set the key.
  void erase(const K& key);

  // --- Effects of calls
  // All of them throw: UsageError by (1) and (2); std::bad_alloc; exceptions of copies.

  /// The entry (key, value) is there. The same value may be put more than once.
  void put(Scope& s, const K& key, V value) requires(!kSums) {
    s.guarded([&] { contribute(s, key, std::move(value)); });
  }
  /// Adds to the value of a key.
  void add(Scope& s, const K& key, V value) requires kSums {
    s.guarded([&] { contribute(s, key, std::move(value)); });
  }

  // --- Queries of the outside
  // Throw: UsageError while the engine runs, and between an edit of a key at which calls have put
  // something and its propagation.

  /// The value of a key; null: there is none. Valid until the map changes.
  [[nodiscard]] const V* find(const K& key) const { return settled().at(key).value; }
  [[nodiscard]] std::size_t size() const { return settled().size(); }
  /// All entries.
  [[nodiscard]] std::vector<std::pair<K, V>> entries() const {
    return typename QuestionsOf<K, V>::Range{}.of(settled());
  }

  using MapApi<TracedMap, K, V, Scope, M...>::find;
  using MapApi<TracedMap, K, V, Scope, M...>::size;

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] std::uint8_t number() const noexcept { return id_; }

  // --- As a structure

  void retract(Call& call, Edge& edge) noexcept override;
  bool unchanged(Call& call, Edge& edge) override;
  void label(const Call& call, const Edge& edge, LabelSink& sink) const override;
  void print(const Call& call, const Edge& edge, std::ostream& out) const override;
  void finished() noexcept override { hides_calls_ = false; }
  void check_invariants() const override;

 private:
  static_assert(!kSums || !std::is_floating_point_v<V>,
                "sums of floating-point numbers depend on the order in which they are made: add "
                "integers, or put the parts under keys of their own and fold them");
  static_assert(std::is_nothrow_move_constructible_v<K>, "a key that may throw when it is moved");
  static_assert(std::is_nothrow_move_constructible_v<V> && std::is_nothrow_move_assignable_v<V>,
                "a value that may throw when it is moved would be lost: hold it by a pointer");
  static_assert(!IsOrderedByAddress<K>::value,
                "the order of addresses is another one in every run: use a number that names the "
                "object as the key");
  friend class MapApi<TracedMap, K, V, Scope, M...>;

  struct Contribution;
  using Entries = MapEntries<K, V, Contribution, M...>;
  using Entry = typename Entries::Entry;
  struct Nothing {};

  // A put, an add, or a set, which is in no call's list. One that is set aside does not count: it
  // lies behind a query that has come before it, and its call will run again.
  struct Contribution : Edge {
    Place place;       // null: of the outside
    Ref<Entry> entry;  // null: memory ran out before it had one
    TreapLinks<Contribution> links;
    bool counts;
    [[no_unique_address]] std::conditional_t<kSums, Raw<V>, Nothing> amount;
  };
  // A query, by its span.
  struct Looker : Edge {
    Place place;
    TreapLinks<Looker> links;
    Ref<Looker> reach;  // the one below, or itself, whose span ends last; null: not known
    bool made;          // its span and what follows are there
    bool linked;
    Raw<Span<K>> span;
  };
  template <class Q>
  struct Query : Looker {
    struct Body {
      Q question;
      typename Q::Answer answer;
    };
    Raw<Body> body;

    static const Body& of(const Looker& l) { return static_cast<const Query&>(l).body.get(); }
    static bool unchanged(TracedMap& map, Looker& l) {
      return same_answer(map.answer_at(of(l).question, l.place), of(l).answer);
    }
    static void end(Looker& l) noexcept { static_cast<Query&>(l).body.end(); }
    static void label(const Looker& l, LabelSink& sink) { name_answer(sink, of(l).answer); }
    static void print(const Looker& l, std::ostream& out) {
      out << Q::kName << ": ";
      print_answer(out, of(l).answer);
    }
  };

  static constexpr std::uint8_t kContribution = 0;
  using All = Questions<K, V, M...>;
  template <class Q>
  static constexpr auto kKind = static_cast<std::uint8_t>(1 + kIndexOf<Q, All>);

  // What can be done with a query of any question.
  struct Kind {
    bool (*unchanged)(TracedMap&, Looker&);
    void (*end)(Looker&) noexcept;
    void (*label)(const Looker&, LabelSink&);
    void (*print)(const Looker&, std::ostream&);
  };
  [[nodiscard]] static const Kind& kind_of(const Edge& edge) {
    static constexpr auto kKinds = []<class... Q>(std::tuple<Q...>*) {
      return std::array<Kind, sizeof...(Q)>{
          Kind{&Query<Q>::unchanged, &Query<Q>::end, &Query<Q>::label, &Query<Q>::print}...};
    }(static_cast<All*>(nullptr));
    return kKinds[edge.kind - 1u];
  }

  // The contributions of an entry, by place, as a Tree of Treap.
  struct Contributions {
    using Node = Contribution;
    Engine& engine;
    [[nodiscard]] Contribution& node(Ref<Contribution> c) const noexcept {
      return engine.arena()[c];
    }
    [[nodiscard]] static std::uint64_t priority(Ref<Contribution> c) noexcept {
      return mix(c.handle());
    }
    static bool update(Contribution&) noexcept { return false; }
    [[nodiscard]] static bool names(const Contribution&, Ref<Contribution>) noexcept {
      return false;
    }
  };
  using Parts = Treap<Contributions>;
  // The queries of all calls, by the beginnings of their spans: an interval tree.
  struct Lookers {
    using Node = Looker;
    Engine& engine;
    Ref<Looker> root{};
    Ref<Looker> last{};
    [[nodiscard]] Looker& node(Ref<Looker> l) const noexcept { return engine.arena()[l]; }
    [[nodiscard]] const Span<K>& span(Ref<Looker> l) const noexcept { return node(l).span.get(); }
    [[nodiscard]] static std::uint64_t priority(Ref<Looker> l) noexcept { return mix(l.handle()); }
    bool update(Looker& l) const noexcept {
      const Ref<Looker> reach = l.reach;
      try {
        l.reach = Arena::ref(l);
        for (const Ref<Looker> child : {l.links.left, l.links.right}) {
          if (child == nullptr || l.reach == nullptr) continue;
          const Ref<Looker> other = node(child).reach;
          if (other == nullptr || span(l.reach).ends_before(span(other))) l.reach = other;
        }
      } catch (...) {  // client code failed: all may end behind any key
        l.reach = nullptr;
      }
      return l.reach != reach;
    }
    [[nodiscard]] static bool names(const Looker& l, Ref<Looker> other) noexcept {
      return l.reach == other;
    }
    void link(Looker& l);
    void unlink(Looker& l) noexcept;
    template <class Visit>
    void at_key(Ref<Looker> h, const K& key, Visit& visit) const;
    template <class Visit>
    void all(Ref<Looker> h, Visit& visit) const;
  };
  using Links = Treap<Lookers>;

  [[nodiscard]] const Entries& settled() const {
    engine_.core().require_settled("a query of a map");
    if (hides_calls_) {
      throw UsageError("map '" + name_ + "': a query between an edit and its propagation");
    }
    return entries_;
  }
  [[nodiscard]] Contributions contributions() const noexcept { return {engine_}; }
  [[nodiscard]] Contribution& part(Ref<Contribution> c) const noexcept {
    return engine_.arena()[c];
  }
  // Whether `edge`, at `place`, is not there yet for the call that is at `now`.
  [[nodiscard]] bool is_behind(const Edge& edge, Place place, Place now) const noexcept {
    if (place != now) return entries_.comes_before(now, place);
    return now != nullptr && is_old(engine_.call_at(now), edge);
  }

  void contribute(Scope& s, const K& key, V&& value);
  void enter(Contribution& c, const K& key, V&& value);
  void give_entry(Contribution& c, const typename Entries::Place& place, const K& key, V&& value);
  void replace(Contribution& c, V&& value);
  void hide(Contribution& c) noexcept;
  void release(Contribution& c) noexcept;
  void link(Contribution& c) noexcept;
  void unlink(Contribution& c) noexcept;
  [[nodiscard]] Ref<Contribution> one_behind(Ref<Entry> entry, Place now) const noexcept;
  void set_aside(Contribution& c) noexcept;
  void tell_unless_seen(const K& key, Place now, bool changes);
  void tell(const K& key) noexcept;
  void doubt(const Looker& l) noexcept { engine_.doubt(l.place); }
  [[noreturn]] void fail_seen(const K& key, Place now, const Looker& seen) const;
  [[noreturn]] void fail_twice(const K& key, Place now, Ref<Entry> entry) const;
  [[nodiscard]] std::string who(Place place) const;

  void set_outside(const K& key, V&& value);
  void erase_outside(Contribution& c) noexcept;
  [[nodiscard]] Contribution* outside(const K& key) const;
  [[nodiscard]] const V& value_of(const Contribution& c) const noexcept;

  template <class Q>
  const typename Q::Answer& ask(Scope& s, Q question);
  template <class Q>
  [[nodiscard]] typename Q::Answer answer_at(const Q& question, Place now);
  template <class Q>
  void learn(Query<Q>& query, typename Q::Answer&& answer);

  Engine& engine_;
  std::string name_;
  std::uint8_t id_ = 0;
  Entries entries_;
  Lookers lookers_;
  std::size_t edges_ = 0;
  bool hides_calls_ = false;  // an edit has set contributions of calls aside
};

// --- Contributing --------------------------------------------------------------------------------

template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::contribute(Scope& s, const K& key, V&& value) {
  const auto same = [&](const Contribution& c) {
    return c.entry != nullptr && same_key(entries_.node(c.entry).key, key);
  };
  Contribution* c = s.recall<Contribution>(id_, kContribution, same, Scope::kMostRecalled);
  if (c == nullptr) {
    c = &s.effect<Contribution>(id_, kContribution);
    c->place = s.place();
    c->entry = nullptr;
    c->counts = false;
    ++edges_;
    enter(*c, key, std::move(value));
  } else if (!c->counts) {
    enter(*c, key, std::move(value));
  } else if (!identical(value_of(*c), value)) {
    replace(*c, std::move(value));
  }
}

// A contribution counts from now on. Its edge comes first: if this fails, there is nothing to undo.
template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::enter(Contribution& c, const K& key, V&& value) {
  auto place = entries_.place_of(key);
  bool changes = true;
  if constexpr (!kSums) {
    const Ref<Entry> found = place.found;
    changes = found == nullptr || !identical(entries_.node(found).value, value);
    if (found != nullptr && changes) {
      for (Ref<Contribution> b; (b = one_behind(found, c.place)) != nullptr;) set_aside(part(b));
      if (entries_.node(found).contributions != nullptr) fail_twice(key, c.place, found);
      place = entries_.place_of(key);
    }
  }
  tell_unless_seen(key, c.place, changes);
  give_entry(c, place, key, std::move(value));
  link(c);
}

// Gives it the entry of the key, with its value.
template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::give_entry(Contribution& c, const typename Entries::Place& place,
                                              const K& key, V&& value) {
  if constexpr (kSums) {
    V amount(value);
    if (place.found != nullptr) value = Group::plus(entries_.node(place.found).value, value);
    if (c.entry == nullptr && place.found == nullptr) {
      c.entry = entries_.make(key, std::move(value));
      ++entries_.node(c.entry).users;
      c.amount.make(std::move(amount));
      return entries_.link(c.entry, place);
    }
    c.entry == nullptr ? void(c.amount.make(std::move(amount)))
                       : void(c.amount.get() = std::move(amount));
  } else if (c.entry == nullptr && place.found == nullptr) {
    c.entry = entries_.make(key, std::move(value));
    ++entries_.node(c.entry).users;
    return entries_.link(c.entry, place);
  }
  if (place.found != nullptr && place.found != c.entry) {
    ++entries_.node(place.found).users;
    if (const Ref<Entry> old = std::exchange(c.entry, place.found);
        old != nullptr && --entries_.node(old).users == 0) {
      entries_.destroy(old);
    }
  }
  entries_.node(c.entry).value = std::move(value);
  if (place.found == nullptr) {
    entries_.link(c.entry, place);
  } else {
    entries_.value_changed(c.entry);
  }
}

// Another value in place of one that counts.
template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::replace(Contribution& c, V&& value) {
  Entry& e = entries_.node(c.entry);
  if constexpr (kSums) {
    V sum = Group::plus(Group::minus(e.value, c.amount.get()), value);
    e.value = std::move(sum);
    c.amount.get() = std::move(value);
  } else {
    const bool alone =
        e.contributions == Arena::ref(c) && c.links.left == nullptr && c.links.right == nullptr;
    if (!alone) {
      const K key = e.key;
      hide(c);
      return enter(c, key, std::move(value));
    }
    e.value = std::move(value);
  }
  entries_.value_changed(c.entry);
  tell(e.key);
}

// It counts no longer, but knows its entry.
template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::hide(Contribution& c) noexcept {
  Entry& e = entries_.node(c.entry);
  unlink(c);
  if (e.contributions == nullptr) {
    entries_.unlink(c.entry);
  } else if constexpr (kSums) {
    e.value = Group::minus(e.value, c.amount.get());
    entries_.value_changed(c.entry);
  } else {
    return;  // others put the same
  }
  tell(e.key);
}

// It ends.
template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::release(Contribution& c) noexcept {
  if (c.entry == nullptr) return;
  if constexpr (kSums) c.amount.end();
  if (--entries_.node(c.entry).users == 0) entries_.destroy(c.entry);
}

template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::link(Contribution& c) noexcept {
  Entry& e = entries_.node(c.entry);
  const Ref<Contribution> self = Arena::ref(c);
  const auto before = [&](Ref<Contribution> a) {
    const Place place = part(a).place;
    return place == c.place ? a.handle() < self.handle() : entries_.comes_before(place, c.place);
  };
  Ref<Contribution> parent;
  bool right = false;
  for (Ref<Contribution> h = e.contributions; h != nullptr;
       h = right ? part(h).links.right : part(h).links.left) {
    parent = h;
    right = before(h);
  }
  const bool is_first = e.contributions == nullptr;
  Parts::link(contributions(), e.contributions, parent, right, self);
  c.counts = true;
  if (c.place == nullptr) e.outside = self;
  if (is_first || entries_.comes_before(e.last, c.place)) {
    e.last = c.place;
    entries_.last_changed(c.entry);
  }
}

template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::unlink(Contribution& c) noexcept {
  Entry& e = entries_.node(c.entry);
  Parts::unlink(contributions(), e.contributions, Arena::ref(c));
  c.counts = false;
  if (c.place == nullptr) e.outside = nullptr;
  if (e.contributions == nullptr || c.place != e.last) return;
  const Place last = part(Parts::last(contributions(), e.contributions)).place;
  if (last == e.last) return;
  e.last = last;
  entries_.last_changed(c.entry);
}

// A contribution that is not there yet for who is at `now`; null: none.
template <class K, class V, class Group, class... M>
auto TracedMap<K, V, Group, M...>::one_behind(Ref<Entry> entry, Place now) const noexcept
    -> Ref<Contribution> {
  const Contributions parts = contributions();
  for (Ref<Contribution> h = Parts::last(parts, entries_.node(entry).contributions); h != nullptr;
       h = Parts::previous(parts, h)) {
    const Contribution& c = part(h);
    if (is_behind(c, c.place, now)) return h;
    if (c.place != now) return nullptr;
  }
  return nullptr;
}

// Its call comes later, in a trace of last time: it runs again, and is then refused if it still
// contributes.
template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::set_aside(Contribution& c) noexcept {
  hide(c);
  hides_calls_ = hides_calls_ || engine_.idle();
  if (!engine_.call_at(c.place).running()) engine_.invalidate(c.place, &c);
}

// --- Telling those who look ----------------------------------------------------------------------

// Refuses a contribution at `now` behind a query of its key; if it `changes` the entry, puts those
// who look later in doubt.
template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::tell_unless_seen(const K& key, Place now, bool changes) {
  const auto visit = [&](const Looker& l) {
    if (!is_behind(l, l.place, now)) fail_seen(key, now, l);
    if (changes) doubt(l);
  };
  lookers_.at_key(lookers_.root, key, visit);
}

template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::tell(const K& key) noexcept {
  const auto visit = [&](const Looker& l) { doubt(l); };
  try {
    lookers_.at_key(lookers_.root, key, visit);
  } catch (...) {  // client code failed: who may have seen the key is not known
    lookers_.all(lookers_.root, visit);
  }
}

template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::Lookers::link(Looker& l) {
  Ref<Looker> parent;
  bool right = true;
  if (last != nullptr && !l.span.get().begins_before(span(last))) {
    parent = last;
  } else {
    for (Ref<Looker> h = root; h != nullptr; h = right ? node(h).links.right : node(h).links.left) {
      parent = h;
      right = !l.span.get().begins_before(span(h));
    }
  }
  const Ref<Looker> self = Arena::ref(l);
  Links::link(*this, root, parent, right, self);
  if (parent == last && right) last = self;
  l.linked = true;
}

template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::Lookers::unlink(Looker& l) noexcept {
  const Ref<Looker> self = Arena::ref(l);
  if (last == self) last = Links::previous(*this, self);
  Links::unlink(*this, root, self);
  l.linked = false;
}

template <class K, class V, class Group, class... M>
template <class Visit>
void TracedMap<K, V, Group, M...>::Lookers::at_key(Ref<Looker> h, const K& key,
                                                   Visit& visit) const {
  while (h != nullptr) {
    const Looker& l = node(h);
    if (l.reach != nullptr && span(l.reach).is_above(key)) return;
    at_key(l.links.left, key, visit);
    if (l.span.get().is_below(key)) return;
    if (!l.span.get().is_above(key)) visit(l);
    h = l.links.right;
  }
}

template <class K, class V, class Group, class... M>
template <class Visit>
void TracedMap<K, V, Group, M...>::Lookers::all(Ref<Looker> h, Visit& visit) const {
  for (; h != nullptr; h = node(h).links.right) {
    all(node(h).links.left, visit);
    visit(node(h));
  }
}

template <class K, class V, class Group, class... M>
std::string TracedMap<K, V, Group, M...>::who(Place place) const {
  return place != nullptr ? Engine::describe(engine_.call_at(place)) : "the outside";
}

template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::fail_seen(const K& key, Place now, const Looker& seen) const {
  std::ostringstream text;
  text << "map '" << name_ << "': " << who(now) << (kSums ? " adds to key " : " puts key ");
  print_argument(text, key);
  text << " behind a query of " << who(seen.place)
       << " that depends on it: what is put comes before who looks";
  throw UsageError(text.str());
}

template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::fail_twice(const K& key, Place now, Ref<Entry> entry) const {
  std::ostringstream text;
  text << "map '" << name_ << "': " << who(now) << " puts another value for key ";
  print_argument(text, key);
  const Ref<Contribution> first = Parts::first(contributions(), entries_.node(entry).contributions);
  text << " than " << who(part(first).place);
  throw UsageError(text.str());
}

// --- The outside ---------------------------------------------------------------------------------

template <class K, class V, class Group, class... M>
auto TracedMap<K, V, Group, M...>::outside(const K& key) const -> Contribution* {
  const Ref<Entry> entry = entries_.find(key);
  const Ref<Contribution> c = entry != nullptr ? entries_.node(entry).outside : nullptr;
  return c != nullptr ? &part(c) : nullptr;
}

template <class K, class V, class Group, class... M>
const V& TracedMap<K, V, Group, M...>::value_of(const Contribution& c) const noexcept {
  if constexpr (kSums) {
    return c.amount.get();
  } else {
    return entries_.node(c.entry).value;
  }
}

template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::set(const K& key, V value) {
  engine_.begin_edit("set");
  if (const Contribution* c = outside(key)) {
    if (identical(value_of(*c), value)) return;
    engine_.on_rollback(
        [this, key, old = value_of(*c)]() mutable { set_outside(key, std::move(old)); });
    return set_outside(key, std::move(value));
  }
  set_outside(key, std::move(value));
  try {
    engine_.on_rollback([this, key] { erase_outside(*outside(key)); });
  } catch (...) {
    erase_outside(*outside(key));
    throw;
  }
}

template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::erase(const K& key) {
  engine_.begin_edit("erase");
  Contribution* const c = outside(key);
  if (c == nullptr) {
    std::ostringstream text;
    text << "map '" << name_ << "': erase: the outside has not set key ";
    print_argument(text, key);
    throw UsageError(text.str());
  }
  engine_.on_rollback(
      [this, key, old = value_of(*c)]() mutable { set_outside(key, std::move(old)); });
  erase_outside(*c);
}

template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::set_outside(const K& key, V&& value) {
  if (Contribution* known = outside(key)) return replace(*known, std::move(value));
  const Ref<Contribution> fresh = engine_.arena().template make<Contribution>();
  Contribution& c = part(fresh);
  c.counts = false;
  try {
    enter(c, key, std::move(value));
  } catch (...) {
    release(c);
    engine_.arena().release(fresh);
    throw;
  }
}

template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::erase_outside(Contribution& c) noexcept {
  hide(c);
  release(c);
  engine_.arena().release(Arena::ref(c));
}

// --- Asking --------------------------------------------------------------------------------------

template <class K, class V, class Group, class... M>
template <class Q>
auto TracedMap<K, V, Group, M...>::ask(Scope& s, Q question) -> const typename Q::Answer& {
  return s.guarded([&]() -> const typename Q::Answer& {
    const auto same = [&](const Query<Q>& q) {
      return q.made && q.body.get().question == question;
    };
    Query<Q>* query = s.recall<Query<Q>>(id_, kKind<Q>, same, Scope::kMostRecalled);
    if (query == nullptr) {
      query = &s.observe<Query<Q>>(id_, kKind<Q>);
      query->place = s.place();
      query->made = query->linked = false;
      ++edges_;
      auto answer = answer_at(question, query->place);
      Span<K> span = question.span(answer);
      query->span.make(std::move(span));
      query->body.make(typename Query<Q>::Body{std::move(question), std::move(answer)});
      query->made = true;
      lookers_.link(*query);
    } else {
      learn(*query, answer_at(question, query->place));
    }
    return query->body.get().answer;
  });
}

// The answer for who is at `now`. What is contributed behind, in a trace of last time, is set
// aside first.
template <class K, class V, class Group, class... M>
template <class Q>
auto TracedMap<K, V, Group, M...>::answer_at(const Q& question, Place now) -> typename Q::Answer {
  for (;;) {
    auto answer = question.of(entries_);
    if (engine_.appending()) return answer;
    Ref<Contribution> behind;
    entries_.any_reaching(now, question.span(answer), [&](Ref<Entry> entry) {
      behind = one_behind(entry, now);
      return behind != nullptr;
    });
    if (behind == nullptr) return answer;
    set_aside(part(behind));
  }
}

template <class K, class V, class Group, class... M>
template <class Q>
void TracedMap<K, V, Group, M...>::learn(Query<Q>& query, typename Q::Answer&& answer) {
  Span<K> span = query.body.get().question.span(answer);
  query.body.get().answer = std::move(answer);
  if (query.linked && span == query.span.get()) return;
  if (query.linked) lookers_.unlink(query);
  query.span.get() = std::move(span);
  lookers_.link(query);
}

// --- As a structure ------------------------------------------------------------------------------

template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::retract(Call&, Edge& edge) noexcept {
  --edges_;
  if (edge.kind == kContribution) {
    auto& c = static_cast<Contribution&>(edge);
    if (c.counts) hide(c);
    return release(c);
  }
  auto& looker = static_cast<Looker&>(edge);
  if (looker.linked) lookers_.unlink(looker);
  if (!looker.made) return;
  looker.span.end();
  kind_of(edge).end(looker);
}

template <class K, class V, class Group, class... M>
bool TracedMap<K, V, Group, M...>::unchanged(Call&, Edge& edge) {
  return edge.kind == kContribution || kind_of(edge).unchanged(*this, static_cast<Looker&>(edge));
}

template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::label(const Call&, const Edge& edge, LabelSink& sink) const {
  if (edge.kind != kContribution) kind_of(edge).label(static_cast<const Looker&>(edge), sink);
}

template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::print(const Call&, const Edge& edge, std::ostream& out) const {
  out << '\'' << name_ << "', ";
  if (edge.kind != kContribution) {
    const auto& looker = static_cast<const Looker&>(edge);
    return looker.made ? kind_of(edge).print(looker, out) : void();
  }
  const auto& c = static_cast<const Contribution&>(edge);
  if (c.entry == nullptr) return;
  out << (kSums ? "adds to " : "puts ");
  print_argument(out, entries_.node(c.entry).key);
  out << ": ";
  print_argument(out, value_of(c));
}

template <class K, class V, class Group, class... M>
void TracedMap<K, V, Group, M...>::check_invariants() const {
  entries_.check_invariants();
  entries_.for_each([&](Ref<Entry> h) {
    const Entry& e = entries_.node(h);
    const Contributions parts = contributions();
    SAC_INVARIANT(e.contributions != nullptr);
    SAC_INVARIANT(Parts::check_invariants(parts, e.contributions) == e.users);  // none is aside
    Ref<Contribution> before;
    for (Ref<Contribution> p = Parts::first(parts, e.contributions); p != nullptr;
         p = Parts::next(parts, p)) {
      SAC_INVARIANT(part(p).counts && part(p).entry == h);
      SAC_INVARIANT(before == nullptr || !entries_.comes_before(part(p).place, part(before).place));
      SAC_INVARIANT((part(p).place == nullptr) == (p == e.outside));
      before = p;
    }
    SAC_INVARIANT(part(before).place == e.last);
    const auto visit = [&](const Looker& l) {
      SAC_INVARIANT(l.place == e.last || entries_.comes_before(e.last, l.place));
    };
    lookers_.at_key(lookers_.root, e.key, visit);
  });
  SAC_INVARIANT(lookers_.last == Links::last(lookers_, lookers_.root));
  const std::size_t lookers = Links::check_invariants(lookers_, lookers_.root);
  std::size_t count = 0;
  Ref<Looker> previous;
  for (Ref<Looker> h = Links::first(lookers_, lookers_.root); h != nullptr;
       h = Links::next(lookers_, h)) {
    const Looker& l = lookers_.node(h);
    SAC_INVARIANT(engine_.is_live_place(l.place) && l.linked);
    Ref<Looker> up = l.reach;  // a node of the tree below
    while (up != nullptr && up != h) up = lookers_.node(up).links.parent;
    SAC_INVARIANT(l.reach == nullptr || up == h);
    SAC_INVARIANT(l.reach == nullptr || !lookers_.span(l.reach).ends_before(l.span.get()));
    for (const Ref<Looker> child : {l.links.left, l.links.right}) {
      if (child == nullptr || l.reach == nullptr) continue;
      const Ref<Looker> other = lookers_.node(child).reach;
      SAC_INVARIANT(other != nullptr && !lookers_.span(l.reach).ends_before(lookers_.span(other)));
    }
    SAC_INVARIANT(previous == nullptr || !lookers_.span(h).begins_before(lookers_.span(previous)));
    previous = h;
    ++count;
  }
  SAC_INVARIANT(count == lookers && lookers <= edges_);
}

// What the trace holds of the map is not retracted, but what needs destroying is destroyed.
template <class K, class V, class Group, class... M>
TracedMap<K, V, Group, M...>::~TracedMap() {
  const auto end_looker = [](Looker& l) {
    l.span.end();
    kind_of(l).end(l);
  };
  lookers_.all(lookers_.root, end_looker);
  entries_.for_each([&](Ref<Entry> h) {
    if constexpr (kSums) {
      const Contributions parts = contributions();
      for (Ref<Contribution> p = Parts::first(parts, entries_.node(h).contributions); p != nullptr;
           p = Parts::next(parts, p)) {
        part(p).amount.end();
      }
    }
    entries_.node(h).~Entry();
  });
  if (edges_ == 0) engine_.remove_structure(id_);
}

// --- The type of a map by its options ------------------------------------------------------------

template <class... T>
struct OptionList {};

template <class K, class V, class Host, class Group, class Folds, class... O>
struct MapWith {
  static_assert(sizeof...(O) == 0,
                "an option of a map is a scope, a group (static plus and minus), or the monoid of "
                "a fold (Value, and static none, of and join)");
};
template <class K, class V, class Group, class... M>
struct MapWith<K, V, Engine, Group, OptionList<M...>> {
  using type = TracedMap<K, V, Group, M...>;
};
template <class K, class V, class Group, class... M>
struct MapWith<K, V, PlainScope, Group, OptionList<M...>> {
  using type = PlainMap<K, V, Group, M...>;
};
template <class K, class V, class Host, class Group, class... M, class O, class... Rest>
requires std::is_same_v<O, Engine> || std::is_same_v<O, Scope> || std::is_same_v<O, PlainScope>
struct MapWith<K, V, Host, Group, OptionList<M...>, O, Rest...>
    : MapWith<K, V, std::conditional_t<std::is_same_v<O, PlainScope>, O, Engine>, Group,
              OptionList<M...>, Rest...> {
};
template <class K, class V, class Host, class Group, class... M, class O, class... Rest>
requires GroupOf<O, V>
struct MapWith<K, V, Host, Group, OptionList<M...>, O, Rest...>
    : MapWith<K, V, Host, O, OptionList<M...>, Rest...> {
};
template <class K, class V, class Host, class Group, class... M, class O, class... Rest>
requires MonoidOf<O, K, V>
struct MapWith<K, V, Host, Group, OptionList<M...>, O, Rest...>
    : MapWith<K, V, Host, Group, OptionList<M..., O>, Rest...> {
};

}  // namespace detail

/// A map from keys to values. Options, in any order: a group, so that values are sums (Sum, or a
/// type with static `plus(a, b)` and `minus(a, b)`); monoids of folds (types with `Value`,
/// `none()`, `of(key, value)` and an associative `join(a, b)`); a scope, Scope or PlainScope.
template <class K, class V, class... Options>
using Map = typename detail::MapWith<K, V, Engine, void, detail::OptionList<>, Options...>::type;

/// The group of integers, and of all types with + and -.
struct Sum {
  template <class V>
  static constexpr V plus(const V& a, const V& b) {
    return a + b;
  }
  template <class V>
  static constexpr V minus(const V& a, const V& b) {
    return a - b;
  }
};

namespace detail {

template <auto f>
struct MergeMapsFrom {
  static constexpr std::string_view kName = kOperationName<"merge", f>;
  template <class S, class A, class B, class K>
  void operator()(S& s, MapRef<A> a, MapRef<B> b, const K& key) const {
    const auto next = next_of(a->next_key(s, {.above = key}), b->next_key(s, {.above = key}));
    f(s, key);
    if (next) s.template tail<MergeMapsFrom{}>(a, b, *next);
  }
  template <class K>
  static std::optional<K> next_of(const std::optional<K>& a, const std::optional<K>& b) {
    if (!a || !b) return a ? a : b;
    return *b < *a ? b : a;
  }
};

template <auto f>
struct MergeMaps {
  static constexpr std::string_view kName = kOperationName<"merge", f>;
  template <class S, class A, class B>
  void operator()(S& s, MapRef<A> a, MapRef<B> b) const {
    const auto first = MergeMapsFrom<f>::next_of(a->next_key(s, {}), b->next_key(s, {}));
    if (first) s.template tail<MergeMapsFrom<f>{}>(a, b, *first);
  }
};

template <auto key, auto value, class M>
struct GroupElement {
  static constexpr std::string_view kName = kOperationName<"group_by", key, value>;
  template <class S, class T>
  void operator()(S& s, const ListNode<T, S>* at, MapRef<M> map) const {
    const auto* const next = s.read(at->next);
    if (at->holds()) map->add(s, key(at->value()), value(at->value()));
    if (next != nullptr) s.template tail<GroupElement{}>(next, map);
  }
};

}  // namespace detail

/// Calls f(scope, key) for every key of a or b, in order, each in a traced call of its own, which
/// comes and goes with its key.
template <auto f, class S, class A, class B>
void merge(S& s, A& a, B& b) {
  s.template call<detail::MergeMaps<f>{}>(detail::MapRef<A>{&a}, detail::MapRef<B>{&b});
}

/// Adds value(x) at key(x) of `sums` for every element x of a list.
template <auto key, auto value, class S, class T, class M>
void group_by(S& s, List<T, S> list, M& sums) {
  s.template call<detail::GroupElement<key, value, M>{}>(list.header(), detail::MapRef<M>{&sums});
}

}  // namespace sac
