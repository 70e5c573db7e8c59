// The rules, each with what has come since it was last asked.
#include <algorithm>
#include <cmath>
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

// What may be new to a rule: handles from these on.
struct Seen {
  VertexHandle point = 1;
  EdgeHandle edge = 0;
  PolygonHandle polygon = 0;
};

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

  int arrange() {
    constexpr int kMost = 2 * kRepairRounds;  // several rules apply one after the other
    for (int round = 0; round <= kMost; ++round) {
      drawing_.use_edges();
      if (drawing_.has_revived()) near_ = crossing_ = lying_ = {};
      if (lead_through_near() || lead_through_crossings()) continue;
      if (drawing_.settle(names_)) continue;
      if (declare_and_pierce() || join_polygons() || part_overlaps()) continue;
      return round;
    }
    fail_crowded(last_);
  }

 private:
  [[nodiscard]] const Point<3>& place(VertexHandle v) const { return drawing_.place(v); }
  [[nodiscard]] double most() const { return drawing_.tolerance(); }
  [[nodiscard]] Seen now() const {
    return {search_.last_point() + 1, search_.last_edge() + 1, search_.last_polygon() + 1};
  }
  [[noreturn]] static void fail_crowded(const Point<3>& p) {
    throw Error(ErrorCode::too_close,
                "what is near " + place_text(p) + " is too close to each other to be repaired");
  }

  // --- Edges ---------------------------------------------------------------------------------

  bool lead_through_near() {
    const Seen seen = std::exchange(near_, now());
    Change change;
    const auto look_at = [&](const Edge& e, VertexHandle v) {
      if (distance2_to(place(v), e) > most() * most() || !drawing_.may_lead(e, v)) return;
      change.leads[e.self].push_back(v);
      last_ = place(v);
    };
    search_.visit_edges(seen.edge, [&](const Edge& e) {
      search_.visit_points(extent_of(e), [&](VertexHandle v) { look_at(e, v); });
    });
    for (VertexHandle v = seen.point; v <= search_.last_point(); ++v) {
      for (const EdgeHandle h : search_.near<Edge>(extent_of(drawing_.point(v)))) {
        if (h < seen.edge) look_at(store_.edges()[h], v);
      }
    }
    if (change.any()) drawing_.apply(change);
    return change.any();
  }

  bool lead_through_crossings() {
    const Seen seen = std::exchange(crossing_, now());
    std::vector<Meeting> meetings;
    search_.visit_edges(seen.edge, [&](const Edge& e) {
      for (const EdgeHandle h : search_.near<Edge>(extent_of(e))) {
        const Edge& t = store_.edges()[h];
        if ((h >= seen.edge && h <= e.self) || !disjoint(e, t)) continue;
        const auto [x, y] = first_by_place(e, t);
        if (distance2(x->place_a, x->place_b, y->place_a, y->place_b) > most() * most()) continue;
        const Point<3> at = nearest_place(x->place_a, x->place_b, y->place_a, y->place_b);
        meetings.push_back({at, x->self, y->self});
      }
    });
    make_set(meetings);
    Change change;
    for (const Meeting& m : meetings) {
      const Edge &e = store_.edges()[m.edge], &t = store_.edges()[m.other];
      const VertexHandle v =
          meeting_point(m.at, e, [&](VertexHandle w) { return leads(e, w) && leads(t, w); });
      for (const Edge* x : {&e, &t}) {
        if (!x->has_end(v)) change.leads[x->self].push_back(v);
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
    return e.has_end(v) || drawing_.may_lead(e, v);
  }
  // The nearest point that serves, or a new one, on e, if none is near.
  template <class Serves>
  VertexHandle meeting_point(const Point<3>& at, const Edge& e, Serves&& serves) {
    last_ = at;
    const std::vector<VertexHandle> near = drawing_.spots_near(at);
    for (const VertexHandle v : near) {
      if (serves(v)) return v;
    }
    if (!near.empty()) fail_crowded(at);
    const VertexHandle v =
        drawing_.add_spot({allowed(at[0]), allowed(at[1]), allowed(at[2])}, {e.a, e.b});
    if (!serves(v)) fail_crowded(at);
    return v;
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

  bool declare_and_pierce() {
    const Seen seen = std::exchange(lying_, now());
    Change change;
    std::vector<Meeting> meetings;
    const auto look_at_point = [&](VertexHandle v, const Polygon& f) {
      if (!lies_on(v, f)) return;
      change.declared[f.self].points.push_back(v);
      last_ = place(v);
    };
    const auto look_at_edge = [&](const Edge& e, const Polygon& f) {
      if (lies_on(e, f)) change.declared[f.self].edges.emplace_back(e.a, e.b), last_ = e.place_a;
      if (!disjoint(e, f)) return;
      if (const auto at = crossing(e.place_a, e.place_b, f)) {
        meetings.push_back({*at, e.self, f.self});
      }
    };
    search_.visit_polygons(seen.polygon, [&](const Polygon& f) {
      search_.visit_points(extent_of(f), [&](VertexHandle v) { look_at_point(v, f); });
      for (const EdgeHandle h : search_.near<Edge>(extent_of(f)))
        look_at_edge(store_.edges()[h], f);
    });
    for (VertexHandle v = seen.point; v <= search_.last_point(); ++v) {
      for (const PolygonHandle h : search_.near<Polygon>(extent_of(drawing_.point(v)))) {
        if (h < seen.polygon) look_at_point(v, store_.polygons()[h]);
      }
    }
    search_.visit_edges(seen.edge, [&](const Edge& e) {
      for (const PolygonHandle h : search_.near<Polygon>(extent_of(e))) {
        if (h < seen.polygon) look_at_edge(e, store_.polygons()[h]);
      }
    });
    if (change.any()) {  // first: it may be what edges go through
      lying_ = seen;
    } else {
      pierce(meetings, change);
    }
    if (change.any()) drawing_.apply(change);
    return change.any();
  }

  void pierce(std::vector<Meeting>& meetings, Change& change) {
    make_set(meetings);
    for (const Meeting& m : meetings) {
      const Edge& e = store_.edges()[m.edge];
      const Polygon& f = store_.polygons()[m.other];
      const VertexHandle v = meeting_point(m.at, e, [&](VertexHandle w) {
        return leads(e, w) && (f.has(w) || contains(f, place(w)));
      });
      if (!e.has_end(v)) change.leads[e.self].push_back(v);
      if (!f.has(v)) change.declared[f.self].points.push_back(v);
    }
  }

  // --- Pairs of polygons ---------------------------------------------------------------------

  template <class Visit>
  void visit_pairs(const Seen& seen, Visit&& visit) {
    search_.visit_polygons(seen.polygon, [&](const Polygon& f) {
      for (const PolygonHandle h : search_.near<Polygon>(extent_of(f))) {
        if (h >= seen.polygon && h <= f.self) continue;
        visit(f, store_.polygons()[h]);
      }
    });
  }

  bool join_polygons() {
    const Seen seen = std::exchange(joining_, now());
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
    const Seen seen = std::exchange(overlap_, now());
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
    if (!any) fail_crowded(last_);
    return true;
  }
  [[nodiscard]] bool is_triangle(PolygonHandle h) const {
    const Polygon& f = store_.polygons()[h];
    return drawing_.sheet_of(h).is_cut_up || (f.points.size() == 3 && f.corners.size() == 3);
  }

  Drawing<3>& drawing_;
  FeatureStore& store_;
  DrawingSearch search_;
  const std::vector<PolygonId>& names_;
  Seen near_, crossing_, lying_, joining_, overlap_;
  Point<3> last_{};  // where something was done
};

}  // namespace

int arrange(Drawing<3>& drawing, const std::vector<PolygonId>& names) {
  return Arranging(drawing, names).arrange();
}

}  // namespace mesher::detail
