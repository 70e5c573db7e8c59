// Nearest neighbours against local feature sizes.
//
// A disc around a vertex meets two features without a common point: so a vertex is looked at with
// the one disc that decides. Segments are found by their edges, which are about as long as the
// disc's radius.
#include "mesh/shrunk_vertices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/box.hpp"
#include "geometry/segment_tests.hpp"
#include "segments/reach_tree.hpp"

namespace mesher::detail {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kPoint = 0x80000000u;  // a feature: a segment, or this and a vertex

MeshBox<2> box_of(const Mesh<2>& mesh) {
  const Box<2> all = bounding_box<2>(mesh.vertices);
  return {all.lo, std::max(all.hi[0] - all.lo[0], all.hi[1] - all.lo[1])};
}

class Guard {
 public:
  Guard(const Mesh<2>& mesh, const MeshLines& lines, double allowed)
      : mesh_(mesh), lines_(lines), allowed_(allowed), box_(box_of(mesh)), tree_(box_) {
    const auto& places = mesh.vertices;
    for (std::uint32_t e = 0; e < mesh.edges.size(); ++e) {
      const Point<2>&a = places[mesh.edges[e].low], &b = places[mesh.edges[e].high];
      const Point<2> middle{a[0] + (b[0] - a[0]) / 2, a[1] + (b[1] - a[1]) / 2};
      tree_.insert(middle, std::sqrt(distance2(a, b, b)) / 2 * (1 + 0x1p-40), lines.of_edges()[e]);
    }
    for (std::uint32_t v = 0; v < places.size(); ++v) {
      const bool point = mesh.kinds[v] == VertexKind::input || is_boundary(v);
      if (point) tree_.insert(places[v], 0, kPoint | v);
    }
  }

  [[nodiscard]] std::vector<ShrunkVertex> all() {
    find_nearest();
    std::vector<ShrunkVertex> found;
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) {
      if (is_boundary(v) || nearest_[v] == kInfinity) continue;
      if (has_shrunk(v)) found.push_back(report(v));
    }
    return found;
  }

 private:
  struct Feature {
    double distance2 = 0;
    std::uint32_t id = 0;
    friend auto operator<=>(const Feature&, const Feature&) = default;
  };

  [[nodiscard]] bool is_boundary(std::uint32_t v) const {
    return mesh_.kinds[v] == VertexKind::boundary;
  }
  // The nearest neighbours that count.
  void find_nearest() {
    nearest_.assign(mesh_.vertices.size(), kInfinity);
    for (const auto& t : mesh_.simplices) {
      for (std::size_t i = 0; i < 3; ++i) meet(t[i], t[(i + 1) % 3]);
    }
  }
  void meet(std::uint32_t v, std::uint32_t w) {
    const double length = lines_.distance(v, w);
    if (length >= nearest_[v] && length >= nearest_[w]) return;
    if (!lines_.wedges_across(v, w, true).empty()) return;
    nearest_[v] = std::min(nearest_[v], length);
    nearest_[w] = std::min(nearest_[w], length);
  }

  [[nodiscard]] double distance2_of(std::uint32_t v, std::uint32_t feature) const {
    const Point<2>& p = mesh_.vertices[v];
    if ((feature & kPoint) != 0) {
      const Point<2>& q = mesh_.vertices[feature & ~kPoint];
      return distance2(p, q, q);
    }
    if (lines_.through(v) == feature) return 0;
    const MeshSegment& s = lines_.segments()[feature];
    return distance2(p, mesh_.vertices[s.a], mesh_.vertices[s.b]);
  }
  [[nodiscard]] bool has(std::uint32_t feature, std::uint32_t v) const {
    if ((feature & kPoint) != 0) return (feature & ~kPoint) == v;
    return lines_.segments()[feature].a == v || lines_.segments()[feature].b == v;
  }
  [[nodiscard]] std::array<std::uint32_t, 2> ends(std::uint32_t feature) const {
    if ((feature & kPoint) != 0) return {feature & ~kPoint, feature & ~kPoint};
    return {lines_.segments()[feature].a, lines_.segments()[feature].b};
  }
  [[nodiscard]] bool disjoint(std::uint32_t f, std::uint32_t g) const {
    return !has(f, ends(g)[0]) && !has(f, ends(g)[1]);
  }
  // Those not farther from v than `most`, by distance.
  [[nodiscard]] std::vector<Feature> features_near(std::uint32_t v, double most) const {
    const Point<2>& p = mesh_.vertices[v];
    std::vector<std::uint32_t> near;
    tree_.visit_near(p, p, most, [&](std::uint32_t feature) { near.push_back(feature); });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    std::vector<Feature> by_distance;
    for (const std::uint32_t f : near) {
      const double d2 = distance2_of(v, f);
      if (d2 <= most * most) by_distance.push_back({d2, f});
    }
    std::sort(by_distance.begin(), by_distance.end());
    return by_distance;
  }
  // The local feature size at v if it is at most `most`, else infinite.
  [[nodiscard]] double feature_size(std::uint32_t v, double most) const {
    const std::vector<Feature> by_distance = features_near(v, most);
    std::vector<std::uint32_t> hubs;  // what all features so far have in common
    for (std::size_t i = 0; i < by_distance.size(); ++i) {
      const Feature& f = by_distance[i];
      if (i == 0) hubs.assign({ends(f.id)[0], ends(f.id)[1]});
      std::erase_if(hubs, [&](std::uint32_t hub) { return !has(f.id, hub); });
      if (!hubs.empty()) continue;
      for (std::size_t j = 0; j < i; ++j) {
        if (disjoint(f.id, by_distance[j].id)) return std::sqrt(f.distance2);
      }
    }
    return kInfinity;
  }

  // Mostly the first disc decides, and it is small.
  [[nodiscard]] bool has_shrunk(std::uint32_t v) const {
    const double most = allowed_ * nearest_[v];
    for (double radius = 2 * nearest_[v]; radius < most; radius *= 2) {
      if (feature_size(v, radius) < kInfinity) return false;
    }
    return feature_size(v, most) == kInfinity;
  }

  void blame(std::uint32_t s, ShrunkVertex& v) const {
    v.lines.push_back(lines_.segments()[s].line);
    for (const std::uint32_t apex : ends(s)) {
      for (const std::uint32_t t : lines_.ending_at(apex)) {
        if (s != t) v.degrees = std::min(v.degrees, lines_.degrees(s, t, apex));
      }
    }
  }
  [[nodiscard]] ShrunkVertex report(std::uint32_t v) const {
    ShrunkVertex found{mesh_.vertices[v], nearest_[v], kInfinity, {}, 180};
    for (double most = 2 * allowed_ * found.nearest;; most *= 2) {
      found.feature_size = feature_size(v, most);
      if (found.feature_size < kInfinity || most > 4 * box_.side) break;
    }
    for (const Feature& f : features_near(v, found.feature_size)) {
      const bool nearer = f.distance2 < found.feature_size * found.feature_size;
      if (nearer && (f.id & kPoint) == 0) blame(f.id, found);
    }
    std::sort(found.lines.begin(), found.lines.end());
    found.lines.erase(std::unique(found.lines.begin(), found.lines.end()), found.lines.end());
    return found;
  }

  const Mesh<2>& mesh_;
  const MeshLines& lines_;
  double allowed_;
  MeshBox<2> box_;
  ReachTree<std::uint32_t> tree_;
  std::vector<double> nearest_;  // neighbours that count
};

}  // namespace

std::vector<ShrunkVertex> shrunk_vertices(const Mesh<2>& mesh, const MeshLines& lines,
                                          double allowed) {
  return Guard(mesh, lines, allowed).all();
}

}  // namespace mesher::detail
