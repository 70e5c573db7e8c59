// The best player of each team, where players gain points and change teams: the greatest of a group
// is the last entry of an interval of an index.
//
// A player that comes, goes or changes makes O(1) calls run again.
#pragma once

#include <cstdint>
#include <limits>
#include <ostream>
#include <tuple>

#include "sac/sac.hpp"

namespace examples::leaders {

struct Player {
  int team = 0;
  int points = 0;
  friend bool operator==(const Player&, const Player&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Player& p) {
    return out << p.team << '/' << p.points;
  }
};
using Standing = std::tuple<int, int, int>;  // team, points, player

template <class S>
struct League {
  template <class Host>
  explicit League(Host& host)
      : players(host, "players"),
        standings(host, "standings"),
        sizes(host, "sizes"),
        leaders(host, "leaders") {
    host.set_environment(this);
  }
  sac::Map<int, Player, S> players;
  sac::Map<Standing, int, S> standings;
  sac::Map<int, int, sac::Sum, S> sizes;  // of teams
  sac::Map<int, int, S> leaders;          // by team
};

struct Enter {
  static constexpr std::string_view kName = "enter";
  template <class S>
  void operator()(S& s, int number, const Player& player) const {
    auto& league = s.template environment<League<S>>();
    league.standings.put(s, {player.team, player.points, number}, number);
    league.sizes.add(s, player.team, 1);
  }
};

struct Lead {
  static constexpr std::string_view kName = "lead";
  template <class S>
  void operator()(S& s, int team) const {
    auto& league = s.template environment<League<S>>();
    const auto best = league.standings.last(s, {.below = Standing(team + 1, 0, 0)});
    league.leaders.put(s, team, best->second);
  }
};

struct LeadAll {
  static constexpr std::string_view kName = "lead_all";
  template <class S>
  void operator()(S& s) const {
    auto& league = s.template environment<League<S>>();
    league.players.template for_each<Enter{}>(s);
    league.sizes.template for_each<Lead{}>(s);
  }
};
inline constexpr LeadAll lead_all{};

}  // namespace examples::leaders
