// A structure of the user: numbers that calls add to, and read. A call sees what earlier calls have
// added, and what itself has; a change runs those again that have seen another sum.
//
// It is as plain as can be: all that was added and seen, in trace order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "sac/sac.hpp"

namespace support {

template <class S = sac::Scope>
class Counter final : public sac::Structure {
 public:
  explicit Counter(sac::Engine& engine) : engine_(engine), id_(engine.add_structure(*this)) {}

  void add(sac::Scope& s, int key, int amount) {
    const auto same = [&](const Entry& e) {
      return e.entered && e.key == key && e.amount == amount;
    };
    Entry* entry = s.recall<Entry>(id_, kAdd, same);
    const bool fresh = entry == nullptr;
    if (fresh) {
      entry = &s.effect<Entry>(id_, kAdd);
      start(s, *entry, key, amount);
    }
    if (fresh) tell(*entry);
  }

  [[nodiscard]] int total(sac::Scope& s, int key) {
    const auto same = [&](const Entry& e) { return e.entered && e.key == key; };
    Entry* entry = s.recall<Entry>(id_, kTotal, same);
    if (entry == nullptr) {
      entry = &s.observe<Entry>(id_, kTotal);
      start(s, *entry, key, 0);
    }
    entry->amount = sum_before(*entry);
    return entry->amount;
  }

  void retract(sac::Call&, sac::Edge& edge) noexcept override {
    auto& entry = static_cast<Entry&>(edge);
    if (!entry.entered) return;
    std::erase(of(entry), &entry);
    if (entry.kind == kAdd) tell(entry);
  }

  void label(const sac::Call&, const sac::Edge& edge, sac::LabelSink& sink) const override {
    if (edge.kind == kTotal) {
      sink.number(static_cast<std::uint64_t>(static_cast<const Entry&>(edge).amount));
    }
  }

  void check_invariants() const override {
    for (const auto& entries : {&adds_, &totals_}) {
      for (const auto& [key, list] : *entries) {
        for (const Entry* entry : list) {
          SAC_INVARIANT(entry->entered && entry->key == key);
          SAC_INVARIANT(entry->kind == kAdd || entry->amount == sum_before(*entry));
        }
      }
    }
  }

 private:
  struct Entry : sac::Edge {
    sac::Place place;
    int key;
    int amount;    // added, or seen
    bool entered;  // false: memory ran out before it was in the list
  };
  using Entries = std::map<int, std::vector<Entry*>>;
  static constexpr std::uint8_t kAdd = 0;
  static constexpr std::uint8_t kTotal = 1;

  [[nodiscard]] std::vector<Entry*>& of(const Entry& entry) {
    return (entry.kind == kAdd ? adds_ : totals_)[entry.key];
  }
  [[nodiscard]] bool precedes(const Entry& a, const Entry& b) const {
    return engine_.precedes(engine_.time(a.place), engine_.time(b.place));
  }

  void start(sac::Scope& s, Entry& entry, int key, int amount) {
    entry.place = s.place();
    entry.key = key;
    entry.amount = amount;
    entry.entered = false;
    of(entry).push_back(&entry);
    entry.entered = true;
  }

  // What the call itself has added at this place before it asked; not what it did last time.
  [[nodiscard]] int own_before(const Entry& total) const {
    int sum = 0;
    bool before = true;
    engine_.for_each_edge(engine_.call_at(total.place), [&](const sac::Edge& edge) {
      before = before && &edge != &total;
      if (!before || edge.structure != id_ || edge.kind != kAdd) return;
      const auto& add = static_cast<const Entry&>(edge);
      if (add.key == total.key && add.place == total.place) sum += add.amount;
    });
    return sum;
  }

  [[nodiscard]] int sum_before(const Entry& total) const {
    int sum = own_before(total);
    const auto it = adds_.find(total.key);
    if (it == adds_.end()) return sum;
    for (const Entry* add : it->second) {
      if (precedes(*add, total)) sum += add->amount;
    }
    return sum;
  }

  // Those that have seen it are to run again.
  void tell(const Entry& add) noexcept {
    const auto it = totals_.find(add.key);
    if (it == totals_.end()) return;
    for (const Entry* total : it->second) {
      if (precedes(add, *total)) engine_.invalidate(total->place);
    }
  }

  sac::Engine& engine_;
  std::uint8_t id_;
  Entries adds_;
  Entries totals_;
};

/// In a plain run nothing is earlier but what has been.
template <>
class Counter<sac::PlainScope> {
 public:
  explicit Counter(sac::PlainScope&) {}
  void add(sac::PlainScope&, int key, int amount) { sums_[key] += amount; }
  [[nodiscard]] int total(sac::PlainScope&, int key) { return sums_[key]; }

 private:
  std::map<int, int> sums_;
};

}  // namespace support
