// A traceable data type written outside of the library: keys that calls claim.
//
// The first call in trace order that claims a key has it; those behind are told so. With
// modifiables, a key would be a chain of reads and writes through all calls that claim it. Here a
// call runs again only if it gains a key or loses it. docs/traceable_types.md goes through it.
//
// Cost: a claim O(log) of the keys and of the claims of the key; one that comes or goes makes at
// most one other call run again. An object of this type outlives the trace.
// clang-format off
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <ostream>
#include <set>
#include <vector>

#include "sac/sac.hpp"

namespace examples {

/// Keys have < and ==, which do not throw.
template <class Key, class S = sac::Scope>
class Claims final : public sac::Structure {
 public:
  explicit Claims(sac::Engine& engine) : engine_(engine), id_(engine.add_structure(*this)) {}

  /// Claims `key` for the running call. Returns whether nobody has claimed it before.
  /// Throws: std::bad_alloc.
  bool claim(sac::Scope& s, const Key& key);

  void retract(sac::Call& call, sac::Edge& edge) noexcept override;
  void label(const sac::Call& call, const sac::Edge& edge, sac::LabelSink& sink) const override;
  void print(const sac::Call& call, const sac::Edge& edge, std::ostream& out) const override;

  void check_invariants() const override;

 private:
  struct Claim;
  using Claimants = std::map<Key, std::vector<Claim*>>;  // of each key in trace order; never none

  // What a call did, and what it was told.
  struct Claim : sac::Edge {
    sac::Place place;
    bool first;                        // what it was told
    bool entered;                      // false: memory ran out before it was among the claimants
    typename Claimants::iterator key;  // where, if it was
  };
  static constexpr std::uint8_t kClaim = 0;

  Claim& enter(sac::Scope& s, const Key& key);
  void put_behind_repeated(const Claim& claim) noexcept;
  void tell(const std::vector<Claim*>& claims) noexcept;
  [[nodiscard]] bool is_first(const Claim& claim) const;
  [[nodiscard]] bool is_old(const Claim& claim) const {
    return sac::is_old(engine_.call_at(claim.place), claim);
  }

  sac::Engine& engine_;
  std::uint8_t id_;
  Claimants claimants_;
};

template <class Key, class S>
bool Claims<Key, S>::claim(sac::Scope& s, const Key& key) {
  const auto same = [&](const Claim& c) { return c.entered && c.key->first == key; };
  Claim* claim = s.recall<Claim>(id_, kClaim, same);
  if (claim == nullptr) claim = &s.guarded([&]() -> Claim& { return enter(s, key); });
  put_behind_repeated(*claim);
  claim->first = is_first(*claim);
  tell(claim->key->second);
  return claim->first;
}

// A claim that was not there last time. The edge comes first: a failure behind it leaves an edge
// that has nothing to take back.
template <class Key, class S>
auto Claims<Key, S>::enter(sac::Scope& s, const Key& key) -> Claim& {
  Claim& claim = s.effect<Claim>(id_, kClaim);
  claim.place = s.place();
  claim.entered = false;
  const auto at = claimants_.try_emplace(key).first;
  auto& claims = at->second;
  const auto place = std::upper_bound(
      claims.begin(), claims.end(), &claim, [&](const Claim* a, const Claim* b) {
        return engine_.precedes(engine_.time(a->place), engine_.time(b->place));
      });
  try {
    claims.insert(place, &claim);
  } catch (...) {
    if (claims.empty()) claimants_.erase(at);
    throw;
  }
  claim.key = at;
  claim.entered = true;
  return claim;
}

// Of several claims at one place, those of this execution come first, in its order: which of last
// time's is found again is not.
template <class Key, class S>
void Claims<Key, S>::put_behind_repeated(const Claim& claim) noexcept {
  auto& claims = claim.key->second;
  const auto self = std::find(claims.begin(), claims.end(), &claim);
  auto place = self;
  while (place != claims.begin() && (*std::prev(place))->place == claim.place) --place;
  const auto comes_before = [&](const Claim* c) {
    return c->place == claim.place && (c == &claim || !is_old(*c));
  };
  while (place != claims.end() && comes_before(*place)) ++place;
  place > self ? std::rotate(self, self + 1, place) : std::rotate(place, self, self + 1);
}

// What a running call has claimed last time, and not again, is not there.
template <class Key, class S>
bool Claims<Key, S>::is_first(const Claim& claim) const {
  for (const Claim* c : claim.key->second) {
    if (c == &claim) return true;
    if (!is_old(*c)) return false;
  }
  return false;
}

// A claim came or went: of those that are there, only the first two can have been told what is no
// longer so.
template <class Key, class S>
void Claims<Key, S>::tell(const std::vector<Claim*>& claims) noexcept {
  int there = 0;
  for (std::size_t i = 0; i < claims.size() && there < 2; ++i) {
    if (is_old(*claims[i])) continue;
    if (claims[i]->first != (there == 0)) engine_.invalidate(claims[i]->place);
    ++there;
  }
}

template <class Key, class S>
void Claims<Key, S>::retract(sac::Call&, sac::Edge& edge) noexcept {
  auto& claim = static_cast<Claim&>(edge);
  if (!claim.entered) return;
  auto& claims = claim.key->second;
  claims.erase(std::find(claims.begin(), claims.end(), &claim));
  tell(claims);
  if (claims.empty()) claimants_.erase(claim.key);
}

template <class Key, class S>
void Claims<Key, S>::label(const sac::Call&, const sac::Edge& edge, sac::LabelSink& sink) const {
  sink.number(static_cast<const Claim&>(edge).first);
}

template <class Key, class S>
void Claims<Key, S>::print(const sac::Call&, const sac::Edge& edge, std::ostream& out) const {
  const auto& claim = static_cast<const Claim&>(edge);
  out << "claims ";
  if (claim.entered) sac::print_argument(out, claim.key->first);
  out << (claim.first ? ": gets it" : ": too late");
}

template <class Key, class S>
void Claims<Key, S>::check_invariants() const {
  for (const auto& [key, claims] : claimants_) {
    SAC_INVARIANT(!claims.empty());
    for (std::size_t i = 0; i < claims.size(); ++i) {
      SAC_INVARIANT(claims[i]->key->first == key && claims[i]->first == (i == 0));
      SAC_INVARIANT(i == 0 || !engine_.precedes(engine_.time(claims[i]->place),
                                                   engine_.time(claims[i - 1]->place)));
    }
  }
}

/// In a plain run nothing is earlier but what has been.
template <class Key>
class Claims<Key, sac::PlainScope> {
 public:
  explicit Claims(sac::PlainScope&) {}
  bool claim(sac::PlainScope&, const Key& key) { return claimed_.insert(key).second; }

 private:
  std::set<Key> claimed_;
};

}  // namespace examples
