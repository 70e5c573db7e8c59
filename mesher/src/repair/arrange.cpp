// Rounds of splitting.
#include "repair/arrange.hpp"

#include <map>
#include <tuple>

#include "geometry/box.hpp"
#include "geometry/input_point.hpp"
#include "mesher/repair.hpp"
#include "repair/box_search.hpp"
#include "repair/crossing_place.hpp"
#include "sets/make_set.hpp"

namespace mesher::detail {

namespace {

// Where rods are to be led, in a canonical order.
using Leads = std::map<std::uint32_t, std::vector<Spot>>;

News everything_until_now(const Drawing<2>& drawing) {
  return {static_cast<Spot>(drawing.places().size()),
          static_cast<std::uint32_t>(drawing.rods().size())};
}

void split_all(Drawing<2>& drawing, const Leads& leads) {
  for (const auto& [rod, through] : leads) drawing.split(rod, through);
}

// Leads rods through points near them. `news`: what has not been looked at; brought up to date.
bool lead_through_near(Drawing<2>& drawing, News& news) {
  const News seen = everything_until_now(drawing);
  Leads leads;
  BoxSearch(drawing).rods_and_spots(news, [&](std::uint32_t r, Spot s) {
    if (drawing.must_lead(drawing.rods()[r], s)) leads[r].push_back(s);
  });
  news = seen;
  split_all(drawing, leads);
  return !leads.empty();
}

struct Crossing {
  Point<2> at;
  std::uint32_t r, t;
  friend auto operator<=>(const Crossing&, const Crossing&) = default;
};

std::vector<Crossing> crossings(const Drawing<2>& drawing, const News& news) {
  std::vector<Crossing> found;
  BoxSearch(drawing).rods_and_rods(news, [&](std::uint32_t r, std::uint32_t t, const Box<2>& box) {
    const Rod &x = drawing.rods()[r], &y = drawing.rods()[t];
    if (!drawing.cross(x, y)) return false;
    const Point<2> at = crossing_place(drawing.place(x.a), drawing.place(x.b), drawing.place(y.a),
                                       drawing.place(y.b));
    const bool inside = contains(box, at);
    if (inside) found.push_back({at, r, t});
    return inside;
  });
  make_set(found);
  return found;
}

[[noreturn]] void fail_crowded(const Point<2>& p) {
  throw Error(ErrorCode::too_close,
              "the lines near " + place_text(p) + " are too close to each other to be repaired");
}

// The point at which two rods are to meet.
Spot meeting(Drawing<2>& drawing, const Crossing& crossing) {
  const auto leads = [&](std::uint32_t rod, Spot s) {
    const Rod& r = drawing.rods()[rod];
    return r.has(s) || drawing.may_lead(r, s);
  };
  const auto serves = [&](Spot s) { return leads(crossing.r, s) && leads(crossing.t, s); };
  const auto there = drawing.spot_near(crossing.at);
  if (there && serves(*there)) return *there;
  if (there) {
    const Point<2>& p = drawing.place(*there);
    const double least = drawing.tolerance() / 2;
    if (distance2(crossing.at, p, p) < least * least) fail_crowded(crossing.at);
  }
  const Spot s = drawing.add_spot(crossing.at);
  if (!serves(s)) fail_crowded(crossing.at);
  return s;
}

// Leads rods that cross through a point there. `news` as above.
bool lead_through_crossings(Drawing<2>& drawing, News& news) {
  const News seen = everything_until_now(drawing);
  Leads leads;
  for (const Crossing& crossing : crossings(drawing, news)) {
    const Spot s = meeting(drawing, crossing);
    for (const std::uint32_t r : {crossing.r, crossing.t}) {
      if (!drawing.rods()[r].has(s)) leads[r].push_back(s);
    }
  }
  news = seen;
  split_all(drawing, leads);
  return !leads.empty();
}

}  // namespace

int arrange(Drawing<2>& drawing) {
  News near_news, crossing_news;
  for (int round = 0; round <= kRepairRounds; ++round) {
    bool changed = false;
    for (int i = 0; lead_through_near(drawing, near_news); ++i) {
      changed = true;
      if (i == kRepairRounds) fail_crowded(drawing.place(drawing.rods().back().a));
    }
    changed |= lead_through_crossings(drawing, crossing_news);
    if (!changed) return round;
  }
  fail_crowded(drawing.place(drawing.rods().back().a));
}

}  // namespace mesher::detail
