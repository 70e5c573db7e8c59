// Parts of features, simplex by simplex.
#include "space/parts_in_mesh.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "mesher/predicates.hpp"
#include "sets/make_set.hpp"
#include "space/placed.hpp"

namespace mesher::detail {

namespace {

using Simplex = std::array<VertexHandle, 4>;
using Corners = std::array<VertexHandle, 3>;
using Polygons = std::span<const PolygonHandle>;  // ascending

// What vertices lie on; what has been asked once is remembered.
class Standings {
 public:
  explicit Standings(const Labelled& labelled) : labelled_(labelled) {}

  [[nodiscard]] Polygons with_edge(EdgeHandle e) {
    return find(at_edge_, e,
                [&](const PolygonsAt& all, auto&& add) { all.visit_with_edge(e, add); });
  }
  /// Those that v lies on.
  [[nodiscard]] Polygons polygons(VertexHandle v) {
    const Role role = labelled_.role(v);
    if (const PolygonHandle f = polygon_of(role))
      return {&labelled_.features.polygons()[f].self, 1};
    if (role.on != 0) return with_edge(role.on);
    if (!labelled_.vertices[v].input) return {};
    return find(at_point_, v,
                [&](const PolygonsAt& all, auto&& add) { all.visit_with_point(v, add); });
  }
  /// The edge that both lie on; 0 if there is none.
  [[nodiscard]] EdgeHandle common_edge(VertexHandle v, VertexHandle w) const {
    return labelled_.features.common_edge(edge_of(labelled_.role(v)), v, edge_of(labelled_.role(w)),
                                          w);
  }

 private:
  using Table = std::unordered_map<std::uint32_t, std::vector<PolygonHandle>>;
  // Of an index some may have gone.
  template <class Visit>
  Polygons find(Table& known, std::uint32_t h, Visit&& visit) {
    const auto [it, is_new] = known.try_emplace(h);
    std::vector<PolygonHandle>& found = it->second;
    if (!is_new) return found;
    for (const PolygonsAt* all : labelled_.polygons) {
      visit(*all, [&](PolygonHandle f) {
        if (labelled_.features.polygons()[f].alive) found.push_back(f);
      });
    }
    make_set(found);
    return found;
  }

  const Labelled& labelled_;
  Table at_edge_, at_point_;
};

class PartFinder {
 public:
  explicit PartFinder(const Labelled& labelled) : labelled_(labelled), standings_(labelled) {}

  void look_at(const Simplex& s) {
    std::array<Polygons, 4> on;
    std::size_t featured = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      on[i] = standings_.polygons(s[i]);
      featured += may_be_on_edge(s[i]) || !on[i].empty() ? 1 : 0;
    }
    if (featured < 2) return;
    look_at_edges(s);
    for (std::size_t i = 0; i < 4; ++i) look_at_face(s, on, i);
  }

  [[nodiscard]] OnFeatures finish() {
    make_set(edges_);
    make_set(faces_);
    OnFeatures all;
    for (const auto& [low, high, e] : edges_) all.edges.push_back(named(low, high, e));
    for (const auto& [f, corners] : faces_) {
      all.faces.push_back({corners, labelled_.names.polygon(f)});
    }
    return all;
  }

 private:
  [[nodiscard]] bool may_be_on_edge(VertexHandle v) const {
    return labelled_.vertices[v].input || edge_of(labelled_.role(v)) != 0;
  }
  void look_at_edges(const Simplex& s) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = i + 1; k < 4; ++k) {
        const EdgeHandle e = standings_.common_edge(s[i], s[k]);
        if (e != 0) edges_.emplace_back(std::min(s[i], s[k]), std::max(s[i], s[k]), e);
      }
    }
  }
  // The face across from corner i.
  void look_at_face(const Simplex& s, const std::array<Polygons, 4>& on, std::size_t i) {
    const std::size_t a = (i + 1) % 4, b = (i + 2) % 4, c = (i + 3) % 4;
    const auto has = [](Polygons all, PolygonHandle f) {
      return std::binary_search(all.begin(), all.end(), f);
    };
    for (const PolygonHandle f : on[a]) {
      if (!has(on[b], f) || !has(on[c], f) || has(on[i], f) || !is_above(s, i, f)) continue;
      Corners corners{s[a], s[b], s[c]};
      std::sort(corners.begin(), corners.end());
      if (holds_middle(f, corners)) faces_.emplace_back(f, corners);
    }
  }

  // Whether s is on the normal's side of its face across from corner i.
  [[nodiscard]] bool is_above(const Simplex& s, std::size_t i, PolygonHandle f) const {
    const Point<3>&apex = place(s[i]), &a = place(s[(i + 1) % 4]);
    const Point<3>&b = place(s[(i + 2) % 4]), &c = place(s[(i + 3) % 4]);
    const Point<3> up = cross(minus(b, a), minus(c, a));
    const bool is_up = dot(up, labelled_.features.polygons()[f].plane.normal) > 0;
    return (predicates::orient3d(a, b, c, apex) > 0) == is_up;
  }
  [[nodiscard]] bool holds_middle(PolygonHandle f, const Corners& corners) const {
    const auto& [a, b, c] = corners;
    return contains(labelled_.features.polygons()[f],
                    scaled(1.0 / 3, plus(place(a), plus(place(b), place(c)))));
  }
  [[nodiscard]] const Point<3>& place(VertexHandle v) const { return labelled_.vertices[v].p; }

  [[nodiscard]] LineEdge named(VertexHandle low, VertexHandle high, EdgeHandle e) {
    if (const auto id = labelled_.names.segment(e)) return {low, high, *id, e};
    std::optional<PolygonId> least;
    for (const PolygonHandle f : standings_.with_edge(e)) {
      const PolygonId id = labelled_.names.polygon(f);
      if (!least || id < *least) least = id;
    }
    return {low, high, least.value_or(PolygonId{}), e};
  }

  const Labelled& labelled_;
  Standings standings_;
  std::vector<std::tuple<VertexHandle, VertexHandle, EdgeHandle>> edges_;
  std::vector<std::pair<PolygonHandle, Corners>> faces_;
};

}  // namespace

OnFeatures on_features(const std::vector<Simplex>& simplices, const Labelled& labelled) {
  PartFinder finder(labelled);
  for (const Simplex& s : simplices) finder.look_at(s);
  return finder.finish();
}

}  // namespace mesher::detail
