// Facets of one plane, side by side, made one: where only these two have an edge, it goes.
#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

#include "mesher/plc.hpp"
#include "sets/make_set.hpp"
#include "sets/union_find.hpp"
#include "space/polygon_shape.hpp"

namespace mesher {
namespace {

using Ends = std::array<FeatureId, 2>;
Ends ends(FeatureId a, FeatureId b) { return {std::min(a, b), std::max(a, b)}; }

// A facet with its edges in a row: the k-th goes from the k-th corner of the shape.
struct Shaped {
  detail::Polygon shape;
  std::vector<FeatureId> corners;
  std::vector<Ends> edges;
  bool is_flat = false;
};

class Merger {
 public:
  explicit Merger(const Plc& plc) : plc_(plc), groups_(plc.facets.size()) {
    for (const Plc::Vertex& v : plc.points) places_.emplace(v.id, v.at);
    for (const Plc::Facet& f : plc.facets) facets_.push_back(shaped(f.polygon.loops));
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      for (std::uint32_t k = 0; k < facets_[f].edges.size(); ++k) {
        users_[facets_[f].edges[k]].push_back({f, k});
      }
      for (const auto& [a, b] : plc.facets[f].polygon.edges) ++others_[ends(a, b)];
    }
    for (const Plc::Segment& s : plc.segments) ++others_[ends(s.from, s.to)];
  }

  Plc merge() {
    for (const auto& [edge, users] : users_) {
      if (goes(edge) && fit(users[0], users[1])) groups_.unite(users[0].facet, users[1].facet);
    }
    std::map<std::size_t, std::vector<std::size_t>> members;  // the first is the least
    for (std::size_t f = 0; f < facets_.size(); ++f) members[groups_.find(f)].push_back(f);
    std::map<std::size_t, Plc::Facet> merged;
    for (const auto& [group, facets] : members) {
      const auto one = facets.size() > 1 ? joined(facets) : std::nullopt;
      if (one) merged.emplace(facets.front(), *one);
      for (const std::size_t f : facets) {
        if (!one) merged.emplace(f, plc_.facets[f]);
      }
    }
    Plc out = plc_;
    out.facets.clear();
    for (auto& [f, facet] : merged) out.facets.push_back(std::move(facet));
    return out;
  }

 private:
  struct User {
    std::size_t facet;
    std::uint32_t edge;
  };

  [[nodiscard]] Shaped shaped(const std::vector<std::vector<FeatureId>>& loops) const {
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
    return f.is_flat && g.is_flat && plc_.facets[a.facet].marker == plc_.facets[b.facet].marker &&
           lies_in_plane(f, g) && lies_in_plane(g, f) &&
           detail::dot(inward(f.shape, a.edge), inward(g.shape, b.edge)) < 0;
  }
  static bool lies_in_plane(const Shaped& f, const Shaped& g) {
    return std::all_of(f.shape.places.begin(), f.shape.places.end(), [&](const Point<3>& p) {
      return std::abs(g.shape.plane.height(p)) <=
             detail::kFlatness * std::min(f.shape.reach, g.shape.reach) + g.shape.thickness;
    });
  }

  // One facet of many; nothing if that is not flat.
  [[nodiscard]] std::optional<Plc::Facet> joined(const std::vector<std::size_t>& facets) const {
    std::map<Ends, int> count;
    Plc::Facet out = plc_.facets[facets.front()];
    out.polygon = {out.polygon.id, {}, {}, {}};
    std::vector<FeatureId> points;
    for (const std::size_t f : facets) {
      for (const Ends& edge : facets_[f].edges) ++count[edge];
      points.insert(points.end(), facets_[f].corners.begin(), facets_[f].corners.end());
      const Polygon& polygon = plc_.facets[f].polygon;
      out.polygon.edges.insert(out.polygon.edges.end(), polygon.edges.begin(), polygon.edges.end());
      points.insert(points.end(), polygon.points.begin(), polygon.points.end());
    }
    std::map<FeatureId, std::vector<FeatureId>> border;  // ends of edges of the border
    for (const auto& [edge, times] : count) {
      if (times == 1) {
        border[edge[0]].push_back(edge[1]);
        border[edge[1]].push_back(edge[0]);
      } else if (!goes(edge)) {
        out.polygon.edges.push_back(edge);
      }
    }
    out.polygon.loops = loops_of(border);
    detail::make_set(points);
    std::copy_if(points.begin(), points.end(), std::back_inserter(out.polygon.points),
                 [&](FeatureId v) { return border.count(v) == 0; });
    return is_flat(out.polygon) ? std::optional(out) : std::nullopt;
  }
  [[nodiscard]] bool is_flat(const Polygon& polygon) const {
    Shaped f = shaped(polygon.loops);
    for (const FeatureId v : polygon.points) f.shape.inside.push_back(places_.at(v));
    return detail::has_area(f.shape) && detail::is_flat(f.shape);
  }

  // Every point is an end of an even number of edges; walks along them close, and are cut where
  // they come back to a point. The one around the largest area is the first.
  [[nodiscard]] std::vector<std::vector<FeatureId>> loops_of(
      std::map<FeatureId, std::vector<FeatureId>> border) const {
    std::vector<std::vector<FeatureId>> loops;
    for (auto& [start, ahead] : border) {
      while (!ahead.empty()) {
        std::vector<FeatureId> walk{start};
        while (walk.size() == 1 || !walk.empty()) {
          const FeatureId next = take_edge(border, walk.back());
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
  static FeatureId take_edge(std::map<FeatureId, std::vector<FeatureId>>& border, FeatureId from) {
    auto& ahead = border.at(from);
    const FeatureId to = ahead.back();
    ahead.pop_back();
    auto& back = border.at(to);
    back.erase(std::find(back.begin(), back.end(), from));
    return to;
  }
  [[nodiscard]] double area2(const std::vector<FeatureId>& loop) const {
    std::vector<Point<3>> places;
    for (const FeatureId v : loop) places.push_back(places_.at(v));
    return detail::squared(detail::twice_area(places));
  }

  const Plc& plc_;
  std::map<FeatureId, Point<3>> places_;
  std::vector<Shaped> facets_;
  std::map<Ends, std::vector<User>> users_;
  std::map<Ends, int> others_;  // edges that are segments, or lie in polygons
  detail::UnionFind groups_;
};

}  // namespace

Plc with_merged_facets(const Plc& plc) { return Merger(plc).merge(); }

}  // namespace mesher
