// Facets of one plane, side by side, made one: where only these two have an edge, it goes.
#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

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
    for (const mesher::Polygon& f : plc.polygons) facets_.push_back(shaped(f.loops));
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      for (std::uint32_t k = 0; k < facets_[f].edges.size(); ++k) {
        users_[facets_[f].edges[k]].push_back({f, k});
      }
      for (const auto& [a, b] : plc.polygons[f].edges) ++others_[ends(a, b)];
    }
    for (const mesher::Segment& s : plc.segments) ++others_[ends(s.from, s.to)];
  }

  Graph<3> merge() {
    for (const auto& [edge, users] : users_) {
      if (goes(edge) && fit(users[0], users[1])) groups_.unite(users[0].facet, users[1].facet);
    }
    std::map<std::size_t, std::vector<std::size_t>> members;  // the first is the least
    for (std::size_t f = 0; f < facets_.size(); ++f) members[groups_.find(f)].push_back(f);
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
  struct User {
    std::size_t facet;
    std::uint32_t edge;
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
    return users_.at(edge).size() == 2 && others_.count(edge) == 0;
  }
  [[nodiscard]] bool fit(const User& a, const User& b) const {
    const Shaped &f = facets_[a.facet], &g = facets_[b.facet];
    return f.is_flat && g.is_flat &&
           plc_.polygons[a.facet].marker == plc_.polygons[b.facet].marker && lies_in_plane(f, g) &&
           lies_in_plane(g, f) && detail::dot(inward(f.shape, a.edge), inward(g.shape, b.edge)) < 0;
  }
  static bool lies_in_plane(const Shaped& f, const Shaped& g) {
    return std::all_of(f.shape.places.begin(), f.shape.places.end(), [&](const Point<3>& p) {
      return std::abs(g.shape.plane.height(p)) <=
             detail::kFlatness * std::min(f.shape.reach, g.shape.reach) + g.shape.thickness;
    });
  }

  // One facet of many; nothing if that is not flat.
  [[nodiscard]] std::optional<mesher::Polygon> joined(
      const std::vector<std::size_t>& facets) const {
    std::map<Ends, int> count;
    mesher::Polygon out = plc_.polygons[facets.front()];
    out = {out.id, {}, {}, {}, out.marker};
    std::vector<PointId> points;
    for (const std::size_t f : facets) {
      for (const Ends& edge : facets_[f].edges) ++count[edge];
      points.insert(points.end(), facets_[f].corners.begin(), facets_[f].corners.end());
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
  std::vector<Shaped> facets_;
  std::map<Ends, std::vector<User>> users_;
  std::map<Ends, int> others_;  // edges that are segments, or lie in polygons
  detail::UnionFind groups_;
};

}  // namespace

Graph<3> with_merged_polygons(const Graph<3>& plc) { return Merger(plc).merge(); }

}  // namespace mesher
