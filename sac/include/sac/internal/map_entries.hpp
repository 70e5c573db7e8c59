// The entries of a traced map: a treap of them by key, with what each knows of those below it: how
// many, the latest contribution, and folds of their values. Entries are in the engine's arena.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <tuple>
#include <utility>

#include "sac/engine.hpp"
#include "sac/internal/map_queries.hpp"
#include "sac/internal/treap.hpp"

namespace sac::detail {

// Room for a T in an edge, which the engine frees without destroying what it holds.
template <class T>
class Raw {
 public:
  template <class... Args>
  T& make(Args&&... args) {
    return *::new (static_cast<void*>(bytes_)) T(std::forward<Args>(args)...);
  }
  T& get() noexcept { return *std::launder(reinterpret_cast<T*>(bytes_)); }
  const T& get() const noexcept { return *std::launder(reinterpret_cast<const T*>(bytes_)); }
  void end() noexcept { get().~T(); }

 private:
  static_assert(alignof(T) <= 8, "what is in the arena is aligned to 8 bytes");
  alignas(T) std::byte bytes_[sizeof(T)];
};

/// `Contribution`: a put, an add or a set (map.hpp).
template <class K, class V, class Contribution, class... M>
class MapEntries {
 public:
  struct Entry {
    K key;
    V value;
    TreapLinks<Entry> links{};
    std::uint32_t size = 1;           // of the tree below, itself included
    std::uint32_t users = 0;          // contributions that name it, those set aside included
    Ref<Contribution> contributions;  // that count, by place; null: it is not among the entries
    Ref<Contribution> outside;        // the one of the outside among them
    sac::Place last;                  // of the last of them
    sac::Place latest;                // of the last one in the tree below
    std::uint64_t priority = 0;
    mutable std::tuple<std::optional<typename M::Value>...> folds{};  // of the tree below, if known
    Entry(const K& k, V&& v) : key(k), value(std::move(v)), priority(hash_key(k)) {}
  };
  static_assert(alignof(Entry) <= 8, "keys, values and folds are aligned to 8 bytes at most");

  explicit MapEntries(Engine& engine) noexcept : engine_(engine) {}

  // --- As a Tree of Treap

  using Node = Entry;
  using Links = Treap<MapEntries>;
  [[nodiscard]] Entry& node(Ref<Entry> h) const noexcept { return engine_.arena()[h]; }
  [[nodiscard]] std::uint64_t priority(Ref<Entry> h) const noexcept { return node(h).priority; }
  bool update(Entry& e) const noexcept {
    const std::uint32_t size = std::exchange(e.size, 1);
    sac::Place latest = e.last;
    for (const Ref<Entry> child : {e.links.left, e.links.right}) {
      if (child == nullptr) continue;
      const Entry& c = node(child);
      e.size += c.size;
      if (comes_before(latest, c.latest)) latest = c.latest;
    }
    const bool is_new = std::exchange(e.latest, latest) != latest;
    return forget_folds(e) || e.size != size || is_new;
  }

  [[nodiscard]] static bool names(const Entry&, Ref<Entry>) noexcept { return false; }

  /// Whether place a comes before place b. Null is the place of the outside, before all.
  [[nodiscard, gnu::always_inline]] bool comes_before(sac::Place a, sac::Place b) const noexcept {
    if (a == b || b == nullptr) return false;
    return a == nullptr || engine_.precedes(engine_.time(a), engine_.time(b));
  }

  // --- Changing

  /// An entry that is not linked. Throws: std::bad_alloc, exceptions of copying the key.
  [[nodiscard]] Ref<Entry> make(const K& key, V&& value) {
    return engine_.arena().template make<Entry>(key, std::move(value));
  }
  void destroy(Ref<Entry> h) noexcept {
    node(h).~Entry();
    engine_.arena().release(h);
  }

  /// Where a key is, or belongs.
  struct Place {
    Ref<Entry> found{};
    Ref<Entry> parent{};
    bool right = false;
  };
  [[nodiscard]] Place place_of(const K& key) const {
    if (last_ != nullptr && node(last_).key < key) return {.parent = last_, .right = true};
    Place place;
    for (Ref<Entry> h = root_; h != nullptr;) {
      const Entry& e = node(h);
      place.right = e.key < key;
      if (!place.right && !(key < e.key)) return {.found = h};
      place.parent = h;
      h = place.right ? e.links.right : e.links.left;
    }
    return place;
  }
  void link(Ref<Entry> h, const Place& place) noexcept {
    Links::link(*this, root_, place.parent, place.right, h);
    if (place.right && place.parent == last_) last_ = h;
    if (last_ == nullptr) last_ = h;
  }
  void unlink(Ref<Entry> h) noexcept {
    if (last_ == h) last_ = Links::previous(*this, h);
    if (cursor_ == h) cursor_ = nullptr;
    Links::unlink(*this, root_, h);
  }
  /// The last contribution of an entry has changed.
  void last_changed(Ref<Entry> h) noexcept { Links::refresh(*this, h); }
  /// The value has.
  void value_changed(Ref<Entry> h) noexcept {
    if constexpr (sizeof...(M) > 0) {
      while (h != nullptr && forget_folds(node(h))) h = node(h).links.parent;
    }
  }

  // --- Asking (the questions of map_queries.hpp)

  [[nodiscard]] bool empty() const noexcept { return root_ == nullptr; }
  [[nodiscard]] std::size_t size() const noexcept { return size_of(root_); }
  [[nodiscard]] Ref<Entry> find(const K& key) const {
    if (cursor_ != nullptr) {
      if (same_key(node(cursor_).key, key)) return cursor_;
      const Ref<Entry> next = Links::next(*this, cursor_);
      if (next != nullptr && same_key(node(next).key, key)) return cursor_ = next;
    }
    for (Ref<Entry> h = root_; h != nullptr;) {
      const Entry& e = node(h);
      if (e.key < key) {
        h = e.links.right;
      } else if (key < e.key) {
        h = e.links.left;
      } else {
        return cursor_ = h;
      }
    }
    return nullptr;
  }
  using View = EntryView<K, V>;
  [[nodiscard]] View at(const K& key) const { return view(find(key)); }
  [[nodiscard]] View first_in(const Span<K>& span) const {
    const Ref<Entry> h = first(span);
    return h != nullptr && !span.is_above(node(h).key) ? view(h) : View{};
  }
  [[nodiscard]] View last_in(const Span<K>& span) const {
    Ref<Entry> best;
    for (Ref<Entry> h = root_; h != nullptr;) {
      if (span.is_above(node(h).key)) {
        h = node(h).links.left;
      } else {
        best = h;
        h = node(h).links.right;
      }
    }
    return best != nullptr && !span.is_below(node(best).key) ? view(best) : View{};
  }
  [[nodiscard]] std::size_t count_in(const Span<K>& span) const {
    const std::size_t to = rank([&](const K& key) { return !span.is_above(key); });
    const std::size_t from = rank([&](const K& key) { return span.is_below(key); });
    return to > from ? to - from : 0;
  }
  [[nodiscard]] View at_rank(std::size_t r) const {
    if (r >= size()) return {};
    for (Ref<Entry> h = root_;;) {
      const TreapLinks<Entry>& l = node(h).links;
      const std::size_t left = size_of(l.left);
      if (r == left) return view(h);
      h = r < left ? l.left : l.right;
      if (r > left) r -= left + 1;
    }
  }
  template <class Visit>
  void for_each_in(const Span<K>& span, Visit&& visit) const {
    for (Ref<Entry> h = first(span); h != nullptr && !span.is_above(node(h).key);
         h = Links::next(*this, h)) {
      visit(node(h).key, node(h).value);
    }
  }
  /// The shape of the computation is that of the treap of the keys in the span: a function of these
  /// keys.
  template <class Fold>
  [[nodiscard]] typename Fold::Value fold_in(const Span<K>& span) const {
    Ref<Entry> h = root_;
    while (h != nullptr && !span.contains(node(h).key)) {
      h = span.is_below(node(h).key) ? node(h).links.right : node(h).links.left;
    }
    if (h == nullptr) return Fold::none();
    const Entry& e = node(h);
    auto own = joined<Fold>(fold_from<Fold>(e.links.left, span), Fold::of(e.key, e.value));
    return joined<Fold>(std::move(own), fold_to<Fold>(e.links.right, span));
  }

  /// Calls visit(entry's handle) for those in the span that have a contribution at `place` or
  /// behind, until it returns true. Cost: O(log) of the entries, for each. Returns whether it did.
  template <class Visit>
  bool any_reaching(sac::Place place, const Span<K>& span, Visit&& visit) const {
    return any_reaching_below(root_, place, span, visit);
  }
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (Ref<Entry> h = Links::first(*this, root_), next; h != nullptr; h = next) {
      next = Links::next(*this, h);
      visit(h);
    }
  }
  void check_invariants() const {
    SAC_INVARIANT(Links::check_invariants(*this, root_) == size());
    SAC_INVARIANT(last_ == Links::last(*this, root_));
    for_each([&](Ref<Entry> h) {
      const Entry& e = node(h);
      const Ref<Entry> next = Links::next(*this, h);
      SAC_INVARIANT(next == nullptr || e.key < node(next).key);
      std::size_t size = 1;
      for (const Ref<Entry> child : {e.links.left, e.links.right}) {
        size += size_of(child);
        SAC_INVARIANT(child == nullptr || !comes_before(e.latest, node(child).latest));
      }
      SAC_INVARIANT(e.size == size && !comes_before(e.latest, e.last));
      SAC_INVARIANT(e.latest == e.last || has_latest(e.links.left, e.latest) ||
                    has_latest(e.links.right, e.latest));
    });
  }

 private:
  // Returns whether one was known: those above know it only then.
  static bool forget_folds(const Entry& e) noexcept {
    const auto forget = [](auto& fold) { return std::exchange(fold, std::nullopt).has_value(); };
    return std::apply([&](auto&... fold) { return (false | ... | forget(fold)); }, e.folds);
  }
  [[nodiscard]] bool has_latest(Ref<Entry> h, sac::Place latest) const noexcept {
    return h != nullptr && node(h).latest == latest;
  }
  [[nodiscard]] std::size_t size_of(Ref<Entry> h) const noexcept {
    return h != nullptr ? node(h).size : 0;
  }
  [[nodiscard]] View view(Ref<Entry> h) const noexcept {
    return h != nullptr ? View{&node(h).key, &node(h).value} : View{};
  }
  // The first entry that is not below the span.
  [[nodiscard]] Ref<Entry> first(const Span<K>& span) const {
    if (cursor_ != nullptr && span.is_below(node(cursor_).key)) {
      const Ref<Entry> next = Links::next(*this, cursor_);  // mostly, who asks goes on from there
      if (next == nullptr || !span.is_below(node(next).key)) return next;
    }
    Ref<Entry> best;
    for (Ref<Entry> h = root_; h != nullptr;) {
      if (span.is_below(node(h).key)) {
        h = node(h).links.right;
      } else {
        best = h;
        h = node(h).links.left;
      }
    }
    return best;
  }
  // The number of entries whose key `is_before`, which are the first.
  template <class IsBefore>
  [[nodiscard]] std::size_t rank(IsBefore&& is_before) const {
    std::size_t before = 0;
    for (Ref<Entry> h = root_; h != nullptr;) {
      const Entry& e = node(h);
      if (is_before(e.key)) {
        before += size_of(e.links.left) + 1;
        h = e.links.right;
      } else {
        h = e.links.left;
      }
    }
    return before;
  }

  template <class Fold>
  using Part = std::optional<typename Fold::Value>;
  template <class Fold>
  static typename Fold::Value joined(Part<Fold> a, typename Fold::Value b) {
    return a ? Fold::join(*a, b) : b;
  }
  template <class Fold>
  static typename Fold::Value joined(typename Fold::Value a, Part<Fold> b) {
    return b ? Fold::join(a, *b) : a;
  }
  template <class Fold>
  [[nodiscard]] Part<Fold> fold_all(Ref<Entry> h) const {
    if (h == nullptr) return std::nullopt;
    const Entry& e = node(h);
    Part<Fold>& known = std::get<kIndexOf<Fold, std::tuple<M...>>>(e.folds);
    if (!known) {
      auto own = joined<Fold>(fold_all<Fold>(e.links.left), Fold::of(e.key, e.value));
      known = joined<Fold>(std::move(own), fold_all<Fold>(e.links.right));
    }
    return known;
  }
  template <class Fold>
  [[nodiscard]] Part<Fold> fold_from(Ref<Entry> h, const Span<K>& span) const {
    if (h == nullptr) return std::nullopt;
    const Entry& e = node(h);
    if (span.is_below(e.key)) return fold_from<Fold>(e.links.right, span);
    auto own = joined<Fold>(fold_from<Fold>(e.links.left, span), Fold::of(e.key, e.value));
    return joined<Fold>(std::move(own), fold_all<Fold>(e.links.right));
  }
  template <class Fold>
  [[nodiscard]] Part<Fold> fold_to(Ref<Entry> h, const Span<K>& span) const {
    if (h == nullptr) return std::nullopt;
    const Entry& e = node(h);
    if (span.is_above(e.key)) return fold_to<Fold>(e.links.left, span);
    auto own = joined<Fold>(fold_all<Fold>(e.links.left), Fold::of(e.key, e.value));
    return joined<Fold>(std::move(own), fold_to<Fold>(e.links.right, span));
  }

  template <class Visit>
  bool any_reaching_below(Ref<Entry> h, sac::Place place, const Span<K>& span, Visit& visit) const {
    if (h == nullptr || comes_before(node(h).latest, place)) return false;
    const Entry& e = node(h);
    const bool below = span.is_below(e.key);
    const bool above = span.is_above(e.key);
    if (!below && any_reaching_below(e.links.left, place, span, visit)) return true;
    if (!below && !above && !comes_before(e.last, place) && visit(h)) return true;
    return !above && any_reaching_below(e.links.right, place, span, visit);
  }

  Engine& engine_;
  Ref<Entry> root_;
  Ref<Entry> last_;            // the greatest key
  mutable Ref<Entry> cursor_;  // the last one found
};

}  // namespace sac::detail
