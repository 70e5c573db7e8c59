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
    if (std::exchange(entry->hidden, false) || fresh) tell(*entry, 0);
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
    if (entry.kind == kAdd) tell(entry, 0);
  }

  void hide(sac::Call&, sac::Edge& edge, sac::Handle end) noexcept override {
    auto& entry = static_cast<Entry&>(edge);
    if (entry.kind != kAdd || !entry.entered || entry.hidden) return;
    entry.hidden = true;
    tell(entry, end);
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
          SAC_INVARIANT(entry->entered && entry->key == key && !entry->hidden);
          SAC_INVARIANT(entry->kind == kAdd || entry->amount == sum_before(*entry));
        }
      }
    }
  }

 private:
  struct Entry : sac::Edge {
    sac::Handle call;
    int key;
    int amount;    // added, or seen
    bool entered;  // false: memory ran out before it was in the list
    bool hidden;   // those behind it have been told that it is not there
  };
  using Entries = std::map<int, std::vector<Entry*>>;
  static constexpr std::uint8_t kAdd = 0;
  static constexpr std::uint8_t kTotal = 1;

  [[nodiscard]] std::vector<Entry*>& of(const Entry& entry) {
    return (entry.kind == kAdd ? adds_ : totals_)[entry.key];
  }
  [[nodiscard]] const sac::Call& call_of(const Entry& entry) const {
    return engine_.call(entry.call);
  }

  void start(sac::Scope& s, Entry& entry, int key, int amount) {
    entry.call = engine_.handle_of(s.self());
    entry.key = key;
    entry.amount = amount;
    entry.entered = entry.hidden = false;
    of(entry).push_back(&entry);
    entry.entered = true;
  }

  // What the call itself has added before it asked; not what it did last time.
  [[nodiscard]] int own_before(const Entry& total) const {
    int sum = 0;
    bool before = true;
    engine_.for_each_edge(call_of(total), [&](const sac::Edge& edge) {
      before = before && &edge != &total;
      if (!before || edge.structure != id_ || edge.kind != kAdd) return;
      const auto& add = static_cast<const Entry&>(edge);
      if (add.key == total.key) sum += add.amount;
    });
    return sum;
  }

  [[nodiscard]] int sum_before(const Entry& total) const {
    int sum = own_before(total);
    const auto it = adds_.find(total.key);
    if (it == adds_.end()) return sum;
    for (const Entry* add : it->second) {
      if (sac::unrepeated(call_of(*add), *add)) continue;
      if (engine_.precedes(call_of(*add), call_of(total))) sum += add->amount;
    }
    return sum;
  }

  // Those that have seen it, up to `end`, are to run again.
  void tell(const Entry& add, sac::Handle end) noexcept {
    const auto it = totals_.find(add.key);
    if (it == totals_.end()) return;
    for (const Entry* total : it->second) {
      sac::Call& call = engine_.call(total->call);
      if (engine_.lies_between(call_of(add), call, end)) engine_.invalidate(call);
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
