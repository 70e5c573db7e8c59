// The rules, each with what has come since it was last asked.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>

#include "geometry/input_point.hpp"
#include "mesher/repair.hpp"
#include "repair/arrange.hpp"
#include "repair/crossing_place.hpp"
#include "repair/drawing_search.hpp"
#include "repair/rest_of.hpp"
#include "sets/make_set.hpp"

namespace mesher::detail {

namespace {

using Change = Drawing<3>::Change;

// Handles of features.
class HandleSet {
 public:
  void add(std::uint32_t h) {
    if (h >= has_.size()) has_.resize(2 * std::size_t{h} + 1);
    if (!has_[h]) all_.push_back(h);
    has_[h] = true;
  }
  [[nodiscard]] bool has(std::uint32_t h) const { return h < has_.size() && has_[h]; }
  [[nodiscard]] const std::vector<std::uint32_t>& all() const noexcept { return all_; }

 private:
  std::vector<bool> has_;
  std::vector<std::uint32_t> all_;
};

// What is new to a rule: points from a handle on, edges and polygons.
struct Newcomers {
  VertexHandle point = 1;
  HandleSet edges, polygons;
};

// With a tolerance that is not the least one: what cannot be done is left to a lesser one; so are
// new points where edges cross, after some rounds (two long edges at a small angle, and what is cut
// anew beside them, would get point after point, each some tolerances from the last).
constexpr int kCoarseRounds = 24;
constexpr int kRoundsOfCrossings = 6;
// A polygon is bent this many tolerances at most by what its edges were led through.
constexpr double kBent = 8;
constexpr double kFiner = 64;  // times less is the next tolerance

// Where an edge and another feature meet.
struct Meeting {
  Point<3> at;
  EdgeHandle edge = 0;
  std::uint32_t other = 0;
  friend auto operator<=>(const Meeting&, const Meeting&) = default;
};

class Arranging {
 public:
  Arranging(Drawing<3>& drawing, const std::vector<PolygonId>& names)
      : drawing_(drawing), store_(drawing.store()), search_(drawing), names_(names) {}

  // What fits together with a tolerance does so with any that is less: what has been looked at is
  // looked at again only if it was left.
  int arrange(double least) {
    int rounds = 0;
    least_ = least;
    drawing_.start();
    for (; drawing_.tolerance() > least; begin_finer(least)) {
      is_last_ = false;
      if (const auto done = arrange_with(kCoarseRounds)) return rounds + *done;
      rounds += kCoarseRounds;
    }
    is_last_ = true;
    constexpr int kMost = 2 * kRepairRounds;  // several rules apply one after the other
    if (const auto done = arrange_with(kMost)) return rounds + *done;
    fail_crowded(last_);
  }

 private:
  // Nothing if not all was done.
  std::optional<int> arrange_with(int most) {
    for (int round = 0; round <= most; ++round) {
      use_edges();
      if (lead_through_near() || lead_through_crossings()) continue;
      if (drawing_.settle(names_, [&](PolygonParts& parts) { add_what_lies_on(parts); })) continue;
      if (declare_and_pierce() || join_polygons() || part_overlaps()) continue;
      return leaves_some_ ? std::nullopt : std::optional(round);
    }
    return std::nullopt;
  }
  void begin_finer(double least) {
    drawing_.set_tolerance(std::max(drawing_.tolerance() / kFiner, least));
    crossing_rounds_ = 0;
    leaves_some_ = false;
    const HandleSet left = std::exchange(left_, {});
    for (const EdgeHandle e : left.all()) tell_of(e, &Newcomers::edges);
    for (const PolygonHandle f : std::exchange(left_polygons_, {})) {
      tell_of(f, &Newcomers::polygons);
    }
  }
  void use_edges() {
    drawing_.use_edges();
    const auto arrivals = drawing_.take_arrivals();
    for (const EdgeHandle e : arrivals.edges) tell_of(e, &Newcomers::edges);
    for (const PolygonHandle f : arrivals.polygons) tell_of(f, &Newcomers::polygons);
  }
  [[nodiscard]] std::array<Newcomers*, 5> rules() {
    return {&near_, &crossing_, &lying_, &joining_, &overlap_};
  }
  void tell_of(std::uint32_t handle, HandleSet Newcomers::*kind) {
    for (Newcomers* rule : rules()) (rule->*kind).add(handle);
  }
  // What is new to a rule; from now on nothing is.
  [[nodiscard]] Newcomers take(Newcomers& rule) const {
    return std::exchange(rule, {search_.last_point() + 1, {}, {}});
  }

  [[nodiscard]] const Point<3>& place(VertexHandle v) const { return drawing_.place(v); }
  [[nodiscard]] double most() const { return drawing_.tolerance(); }
  [[noreturn]] static void fail_crowded(const Point<3>& p) {
    throw Error(ErrorCode::too_close,
                "what is near " + place_text(p) + " is too close to each other to be repaired");
  }

  // --- Edges ---------------------------------------------------------------------------------

  bool lead_through_near() {
    const Newcomers seen = take(near_);
    Change change;
    const auto look_at = [&](const Edge& e, VertexHandle v) {
      if (distance2_to(place(v), e) > most() * most() || !drawing_.may_lead(e, v)) return;
      if (bounds_needle(e, v)) return;
      change.leads[e.self].push_back(v);
      last_ = place(v);
    };
    search_.visit_edges(seen.edges.all(), [&](const Edge& e) {
      search_.visit_points(extent_of(e), [&](VertexHandle v) { look_at(e, v); });
    });
    for (VertexHandle v = seen.point; v <= search_.last_point(); ++v) {
      for (const EdgeHandle h : search_.near<Edge>(extent_of(drawing_.point(v)))) {
        if (!seen.edges.has(h)) look_at(store_.edges()[h], v);
      }
    }
    if (change.any()) drawing_.apply(change);
    return change.any();
  }

  // Whether e was made by a cut, with a triangle whose third corner v is: there was no better cut.
  [[nodiscard]] bool bounds_needle(const Edge& e, VertexHandle v) const {
    if (drawing_.is_drawn(e.self)) return false;
    const auto polygons = store_.polygons_at(e);
    return std::any_of(polygons.begin(), polygons.end(), [&](PolygonHandle h) {
      const auto& corners = store_.polygons()[h].corners;
      return std::find(corners.begin(), corners.end(), v) != corners.end();
    });
  }

  bool lead_through_crossings() {
    const Newcomers seen = take(crossing_);
    std::vector<Meeting> meetings;
    search_.visit_edges(seen.edges.all(), [&](const Edge& e) {
      for (const EdgeHandle h : search_.near<Edge>(extent_of(e))) {
        const Edge& t = store_.edges()[h];
        if ((seen.edges.has(h) && h <= e.self) || !disjoint(e, t)) continue;
        const auto [x, y] = first_by_place(e, t);
        const bool are_drawn = drawing_.is_drawn(e.self) && drawing_.is_drawn(h);
        const double within = are_drawn ? most() : least_;
        if (distance2(x->place_a, x->place_b, y->place_a, y->place_b) > within * within) continue;
        const Point<3> at = nearest_place(x->place_a, x->place_b, y->place_a, y->place_b);
        meetings.push_back({at, x->self, y->self});
      }
    });
    make_set(meetings);
    if (!meetings.empty()) ++crossing_rounds_;
    const bool may_add = is_last_ || crossing_rounds_ <= kRoundsOfCrossings;
    Change change;
    for (const Meeting& m : meetings) {
      const Edge &e = store_.edges()[m.edge], &t = store_.edges()[m.other];
      const auto serves = [&](VertexHandle w) { return leads(e, w) && leads(t, w); };
      const auto v = meeting_point(m.at, e, may_add, serves);
      if (!v) continue;
      for (const Edge* x : {&e, &t}) {
        if (!x->has_end(*v)) change.leads[x->self].push_back(*v);
      }
    }
    if (change.any()) drawing_.apply(change);
    return change.any();
  }

  static std::pair<const Edge*, const Edge*> first_by_place(const Edge& e, const Edge& t) {
    const bool is_first = std::tie(e.place_a, e.place_b) < std::tie(t.place_a, t.place_b);
    return is_first ? std::pair(&e, &t) : std::pair(&t, &e);
  }
  [[nodiscard]] bool leads(const Edge& e, VertexHandle v) const {
    return e.has_end(v) || (drawing_.may_lead(e, v) && !bounds_needle(e, v));
  }
  // The nearest point that serves, or a new one, on e, if none is near; nothing: it is left to a
  // lesser tolerance.
  template <class Serves>
  std::optional<VertexHandle> meeting_point(const Point<3>& at, const Edge& e, bool may_add,
                                            Serves&& serves) {
    last_ = at;
    const std::vector<VertexHandle> near = drawing_.spots_near(at);
    for (const VertexHandle v : near) {
      if (serves(v)) return v;
    }
    if (near.empty() && may_add) {
      const VertexHandle v =
          drawing_.add_spot({allowed(at[0]), allowed(at[1]), allowed(at[2])}, {e.a, e.b});
      if (serves(v)) return v;
    }
    if (is_last_) fail_crowded(at);
    leaves_some_ = true;
    left_.add(e.self);
    return std::nullopt;
  }

  // --- What lies on polygons -----------------------------------------------------------------

  [[nodiscard]] bool lies_on(VertexHandle v, const Polygon& f) const {
    return !f.has(v) && std::abs(f.plane.height(place(v))) <= std::max(f.thickness, most()) &&
           contains(f, place(v));
  }
  [[nodiscard]] static bool lies_on(const Edge& e, const Polygon& f) {
    return f.has(e.a) && f.has(e.b) && !f.has_edge(e.self) &&
           contains(f, scaled(0.5, plus(e.place_a, e.place_b)));
  }

  // Adds what lies on a polygon that is to be cut: cuts that do not follow it cross it.
  void add_what_lies_on(PolygonParts& parts) {
    const Polygon& f = store_.record(parts);
    if (!has_area(f) || f.thickness > kBent * most()) return;
    std::vector<VertexHandle> on = f.points;
    search_.visit_points(narrow_extent_of(f), [&](VertexHandle v) {
      if (!lies_on(v, f)) return;
      parts.points.push_back(v);
      on.push_back(v);
    });
    make_set(on);
    const auto is_on = [&](VertexHandle v) { return std::binary_search(on.begin(), on.end(), v); };
    for (const EdgeHandle h : search_.near<Edge>(narrow_extent_of(f))) {
      const Edge& e = store_.edges()[h];
      if (!is_on(e.a) || !is_on(e.b) || f.has_edge(h)) continue;
      if (contains(f, scaled(0.5, plus(e.place_a, e.place_b)))) parts.edges.emplace_back(e.a, e.b);
    }
  }

  bool declare_and_pierce() {
    const Newcomers seen = take(lying_);
    Change change;
    const auto look_at_point = [&](VertexHandle v, const Polygon& f) {
      if (!lies_on(v, f)) return;
      change.declared[f.self].points.push_back(v);
      last_ = place(v);
    };
    const auto look_at_edge = [&](const Edge& e, const Polygon& f) {
      if (lies_on(e, f)) change.declared[f.self].edges.emplace_back(e.a, e.b), last_ = e.place_a;
      if (!disjoint(e, f)) return;
      if (const auto at = crossing(e.place_a, e.place_b, f)) {
        waiting_.push_back({*at, e.self, f.self});
      }
    };
    search_.visit_polygons(seen.polygons.all(), [&](const Polygon& f) {
      search_.visit_points(narrow_extent_of(f), [&](VertexHandle v) { look_at_point(v, f); });
      for (const EdgeHandle h : search_.near<Edge>(narrow_extent_of(f)))
        look_at_edge(store_.edges()[h], f);
    });
    for (VertexHandle v = seen.point; v <= search_.last_point(); ++v) {
      for (const PolygonHandle h : search_.near<Polygon>(extent_of(drawing_.point(v)))) {
        if (!seen.polygons.has(h)) look_at_point(v, store_.polygons()[h]);
      }
    }
    search_.visit_edges(seen.edges.all(), [&](const Edge& e) {
      for (const PolygonHandle h : search_.near<Polygon>(extent_of(e))) {
        if (!seen.polygons.has(h)) look_at_edge(e, store_.polygons()[h]);
      }
    });
    // What lies on polygons comes first: edges may go through it.
    if (!change.any()) pierce(change);
    if (change.any()) drawing_.apply(change);
    return change.any();
  }

  void pierce(Change& change) {
    make_set(waiting_);
    for (const Meeting& m : std::exchange(waiting_, {})) {
      const Edge& e = store_.edges()[m.edge];
      const Polygon& f = store_.polygons()[m.other];
      if (!e.alive || !f.alive) continue;  // what there is instead has been looked at
      const auto serves = [&](VertexHandle w) {
        return leads(e, w) && (f.has(w) || contains(f, place(w)));
      };
      const auto v = meeting_point(m.at, e, true, serves);
      if (!v) continue;
      if (!e.has_end(*v)) change.leads[e.self].push_back(*v);
      if (!f.has(*v)) change.declared[f.self].points.push_back(*v);
    }
  }

  // --- Pairs of polygons ---------------------------------------------------------------------

  template <class Visit>
  void visit_pairs(const Newcomers& seen, Visit&& visit) {
    search_.visit_polygons(seen.polygons.all(), [&](const Polygon& f) {
      for (const PolygonHandle h : search_.near<Polygon>(narrow_extent_of(f))) {
        if (seen.polygons.has(h) && h <= f.self) continue;
        visit(f, store_.polygons()[h]);
      }
    });
  }

  bool join_polygons() {
    const Newcomers seen = take(joining_);
    Change change;
    visit_pairs(seen, [&](const Polygon& f, const Polygon& g) {
      if (lie_in_one_plane(f, g)) return;
      for (const auto& [v, w] : uncut(f, g, store_)) {
        const Edge* e = store_.find_edge(v, w);
        for (const Polygon* x : {&f, &g}) {
          if (e != nullptr && x->has_edge(e->self)) continue;
          change.declared[x->self].edges.emplace_back(v, w);
          last_ = place(v);
        }
      }
    });
    if (change.any()) drawing_.apply(change);
    return change.any();
  }

  // Whether two have an area in common.
  [[nodiscard]] bool share_area(const Polygon& f, const Polygon& g) const {
    return lie_in_one_plane(f, g) && overlap(f, g, store_).has_value();
  }

  // Each loses to all before it in the order of facets. Where it is not clear
  // what is on both, both are cut into triangles: equal ones are one then.
  bool part_overlaps() {
    const Newcomers seen = take(overlap_);
    const auto key = [&](const Polygon& f) {
      return std::pair(drawing_.sheet_of(f.self).facet, f.self);
    };
    std::map<std::pair<std::size_t, PolygonHandle>, std::vector<const Polygon*>> losers;
    visit_pairs(seen, [&](const Polygon& f, const Polygon& g) {
      if (!share_area(f, g)) return;
      const bool f_stays = key(f) < key(g);
      const Polygon &stays = f_stays ? f : g, &loses = f_stays ? g : f;
      losers[key(loses)].push_back(&stays);
    });
    if (losers.empty()) return false;
    std::vector<std::tuple<PolygonHandle, std::vector<Loop>, std::vector<std::size_t>>> rests;
    std::vector<PolygonHandle> cut;
    for (const auto& [loser, takers] : losers) {
      const Polygon& g = store_.polygons()[loser.second];
      last_ = g.middle;
      auto rest = rest_of(g, takers, store_);
      const bool is_clear = rest && drawing_.can_settle(g.self, *rest);
      if (!is_clear) cut.push_back(g.self);
      std::vector<std::size_t> facets;
      for (const Polygon* f : takers) {
        if (!is_clear) cut.push_back(f->self);
        facets.push_back(drawing_.sheet_of(f->self).facet);
      }
      if (is_clear) rests.emplace_back(g.self, std::move(*rest), std::move(facets));
    }
    for (auto& [g, loops, to] : rests) drawing_.take_away(g, std::move(loops), to);
    make_set(cut);
    bool any = !rests.empty();
    for (const PolygonHandle f : cut) {
      if (!store_.polygons()[f].alive || is_triangle(f)) continue;
      drawing_.cut_up(f);
      any = true;
    }
    if (!any && is_last_) fail_crowded(last_);
    if (!any) leave(cut);
    return any;
  }
  void leave(const std::vector<PolygonHandle>& polygons) {
    leaves_some_ = true;
    left_polygons_.insert(left_polygons_.end(), polygons.begin(), polygons.end());
  }
  [[nodiscard]] bool is_triangle(PolygonHandle h) const {
    const Polygon& f = store_.polygons()[h];
    return drawing_.sheet_of(h).is_cut_up || (f.points.size() == 3 && f.corners.size() == 3);
  }

  Drawing<3>& drawing_;
  FeatureStore& store_;
  DrawingSearch search_;
  const std::vector<PolygonId>& names_;
  Newcomers near_, crossing_, lying_, joining_, overlap_;
  std::vector<Meeting> waiting_;  // edges that go through polygons, when they were found
  double least_ = 0;
  bool is_last_ = true;       // the tolerance is the least
  bool leaves_some_ = false;  // to a lesser one: what meets these
  HandleSet left_;
  std::vector<PolygonHandle> left_polygons_;
  int crossing_rounds_ = 0;
  Point<3> last_{};  // where something was done
};

}  // namespace

int arrange(Drawing<3>& drawing, const std::vector<PolygonId>& names, double least) {
  return Arranging(drawing, names).arrange(least);
}

}  // namespace mesher::detail
