// Facets of one plane, side by side, made one: where only these two have an edge, it goes.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <unordered_map>

#include "mesher/graph.hpp"
#include "sets/make_set.hpp"
#include "sets/union_find.hpp"
#include "space/polygon_shape.hpp"

namespace mesher {
namespace {

using Ends = std::array<PointId, 2>;
Ends ends(PointId a, PointId b) { return {std::min(a, b), std::max(a, b)}; }

// A facet with its edges in a row: the k-th goes from the k-th corner of the shape.
struct Shaped {
  detail::Polygon shape;
  std::vector<PointId> corners;
  std::vector<Ends> edges;
  bool is_flat = false;
};

class Merger {
 public:
  explicit Merger(const Graph<3>& plc) : plc_(plc), groups_(plc.polygons.size()) {
    for (const GraphPoint<3>& v : plc.points) places_.emplace(v.id, v.at);
    for (std::size_t f = 0; f < plc.polygons.size(); ++f) {
      std::uint32_t k = 0;
      for (const auto& loop : plc.polygons[f].loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
          users_.push_back({ends(loop[i], loop[(i + 1) % loop.size()]), f, k++});
        }
      }
      for (const auto& [a, b] : plc.polygons[f].edges) others_.insert(ends(a, b));
    }
    for (const mesher::Segment& s : plc.segments) others_.insert(ends(s.from, s.to));
    std::sort(users_.begin(), users_.end());
  }

  Graph<3> merge() {
    for (std::size_t i = 0; i + 1 < users_.size(); ++i) {
      const User &a = users_[i], &b = users_[i + 1];
      if (a.edge == b.edge && goes(a.edge) && fit(a, b)) groups_.unite(a.facet, b.facet);
    }
    std::map<std::size_t, std::vector<std::size_t>> members;  // the first is the least
    for (std::size_t f = 0; f < plc_.polygons.size(); ++f) members[groups_.find(f)].push_back(f);
    std::map<std::size_t, mesher::Polygon> merged;
    for (const auto& [group, facets] : members) {
      const auto one = facets.size() > 1 ? joined(facets) : std::nullopt;
      if (one) merged.emplace(facets.front(), *one);
      for (const std::size_t f : facets) {
        if (!one) merged.emplace(f, plc_.polygons[f]);
      }
    }
    Graph<3> out = plc_;
    out.polygons.clear();
    for (auto& [f, facet] : merged) out.polygons.push_back(std::move(facet));
    return out;
  }

 private:
  // A facet with an edge, the k-th of its shape.
  struct User {
    Ends edge;
    std::size_t facet;
    std::uint32_t k;
    auto operator<=>(const User&) const = default;
  };

  [[nodiscard]] Shaped shaped(const std::vector<std::vector<PointId>>& loops) const {
    Shaped f;
    for (const auto& loop : loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        f.corners.push_back(loop[i]);
        f.edges.push_back(ends(loop[i], loop[(i + 1) % loop.size()]));
        f.shape.places.push_back(places_.at(loop[i]));
      }
      f.shape.loop_end.push_back(static_cast<std::uint32_t>(f.corners.size()));
    }
    f.is_flat = detail::find_shape(f.shape) && detail::is_flat(f.shape);
    return f;
  }
  // Whether nothing but two facets has the edge.
  [[nodiscard]] bool goes(const Ends& edge) const {
    const auto [first, last] =
        std::equal_range(users_.begin(), users_.end(), User{edge, 0, 0},
                         [](const User& a, const User& b) { return a.edge < b.edge; });
    return last - first == 2 && others_.count(edge) == 0;
  }
  [[nodiscard]] bool fit(const User& a, const User& b) {
    if (plc_.polygons[a.facet].marker != plc_.polygons[b.facet].marker || is_bend(a, b)) {
      return false;
    }
    const Shaped &f = facet(a.facet), &g = facet(b.facet);
    return f.is_flat && g.is_flat && lies_in_plane(f, g) && lies_in_plane(g, f) &&
           detail::dot(inward(f.shape, a.k), inward(g.shape, b.k)) < 0;
  }
  // Whether two triangles are clearly in two planes: most are, and need no shapes.
  [[nodiscard]] bool is_bend(const User& a, const User& b) const {
    const auto &f = plc_.polygons[a.facet].loops, &g = plc_.polygons[b.facet].loops;
    if (f.size() != 1 || f[0].size() != 3 || g.size() != 1 || g[0].size() != 3) return false;
    const auto place = [&](const auto& loops, std::uint32_t i) -> const Point<3>& {
      return places_.at(loops[0][i % 3]);
    };
    const Point<3>&p = place(f, a.k), &q = place(f, a.k + 1), &r = place(f, a.k + 2),
          &s = place(g, b.k + 2);
    const Point<3> across = detail::cross(detail::minus(q, p), detail::minus(r, p));
    double most = 0, longest2 = 0;
    for (const Point<3>* x : {&p, &q, &r, &s}) {
      for (const double c : *x) most = std::max(most, std::abs(c));
      longest2 = std::max(longest2, detail::squared_distance(*x, p));
    }
    const double height = std::abs(detail::dot(detail::minus(s, p), across));
    const double tolerance = 4 * detail::kFlatness * std::sqrt(longest2) + 0x1p-40 * most;
    return height > tolerance * std::sqrt(detail::squared(across));
  }
  // The shape of a facet that may be merged.
  [[nodiscard]] const Shaped& facet(std::size_t f) {
    const auto [it, is_new] = facets_.try_emplace(f);
    if (is_new) it->second = shaped(plc_.polygons[f].loops);
    return it->second;
  }
  static bool lies_in_plane(const Shaped& f, const Shaped& g) {
    return std::all_of(f.shape.places.begin(), f.shape.places.end(), [&](const Point<3>& p) {
      return std::abs(g.shape.plane.height(p)) <=
             detail::kFlatness * std::min(f.shape.reach, g.shape.reach) + g.shape.thickness;
    });
  }

  // One facet of many; nothing if that is not flat.
  [[nodiscard]] std::optional<mesher::Polygon> joined(const std::vector<std::size_t>& facets) {
    std::map<Ends, int> count;
    mesher::Polygon out = plc_.polygons[facets.front()];
    out = {out.id, {}, {}, {}, out.marker};
    std::vector<PointId> points;
    for (const std::size_t f : facets) {
      for (const Ends& edge : facet(f).edges) ++count[edge];
      points.insert(points.end(), facet(f).corners.begin(), facet(f).corners.end());
      const Polygon& polygon = plc_.polygons[f];
      out.edges.insert(out.edges.end(), polygon.edges.begin(), polygon.edges.end());
      points.insert(points.end(), polygon.points.begin(), polygon.points.end());
    }
    std::map<PointId, std::vector<PointId>> border;  // ends of edges of the border
    for (const auto& [edge, times] : count) {
      if (times == 1) {
        border[edge[0]].push_back(edge[1]);
        border[edge[1]].push_back(edge[0]);
      } else if (!goes(edge)) {
        out.edges.push_back(edge);
      }
    }
    out.loops = loops_of(border);
    detail::make_set(points);
    std::copy_if(points.begin(), points.end(), std::back_inserter(out.points),
                 [&](PointId v) { return border.count(v) == 0; });
    return is_flat(out) ? std::optional(out) : std::nullopt;
  }
  [[nodiscard]] bool is_flat(const Polygon& polygon) const {
    Shaped f = shaped(polygon.loops);
    for (const PointId v : polygon.points) f.shape.inside.push_back(places_.at(v));
    return detail::has_area(f.shape) && detail::is_flat(f.shape);
  }

  // Every point is an end of an even number of edges; walks along them close, and are cut where
  // they come back to a point. The one around the largest area is the first.
  [[nodiscard]] std::vector<std::vector<PointId>> loops_of(
      std::map<PointId, std::vector<PointId>> border) const {
    std::vector<std::vector<PointId>> loops;
    for (auto& [start, ahead] : border) {
      while (!ahead.empty()) {
        std::vector<PointId> walk{start};
        while (walk.size() == 1 || !walk.empty()) {
          const PointId next = take_edge(border, walk.back());
          const auto seen = std::find(walk.begin(), walk.end(), next);
          if (seen == walk.end()) {
            walk.push_back(next);
            continue;
          }
          loops.emplace_back(seen, walk.end());
          walk.erase(seen + 1, walk.end());
          if (border.at(walk.back()).empty()) break;
        }
      }
    }
    std::stable_sort(loops.begin(), loops.end(),
                     [&](const auto& a, const auto& b) { return area2(a) > area2(b); });
    return loops;
  }
  static PointId take_edge(std::map<PointId, std::vector<PointId>>& border, PointId from) {
    auto& ahead = border.at(from);
    const PointId to = ahead.back();
    ahead.pop_back();
    auto& back = border.at(to);
    back.erase(std::find(back.begin(), back.end(), from));
    return to;
  }
  [[nodiscard]] double area2(const std::vector<PointId>& loop) const {
    std::vector<Point<3>> places;
    for (const PointId v : loop) places.push_back(places_.at(v));
    return detail::squared(detail::twice_area(places));
  }

  const Graph<3>& plc_;
  std::map<PointId, Point<3>> places_;
  std::vector<User> users_;  // by edges
  std::set<Ends> others_;    // edges that are segments, or lie in polygons
  std::unordered_map<std::size_t, Shaped> facets_;
  detail::UnionFind groups_;
};

}  // namespace

Graph<3> with_merged_polygons(const Graph<3>& plc) { return Merger(plc).merge(); }

}  // namespace mesher
