// An edge of a flat tetrahedron goes, and those around it for others; see flat.hpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "check/space_quality.hpp"
#include "geometry/circumcentre.hpp"
#include "geometry/space_vectors.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/canonical.hpp"
#include "mesher/check.hpp"
#include "mesher/improve.hpp"
#include "mesher/predicates.hpp"

namespace mesher {
namespace {

using detail::Face;
using Edge = std::array<std::uint32_t, 2>;
using Simplex = Mesh<3>::Simplex;

Face face_of(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  Face face{a, b, c};
  std::sort(face.begin(), face.end());
  return face;
}

// Six times its volume, in units of its longest edge, cubed.
double thickness(const Mesh<3>& mesh, const Simplex& s) {
  std::array<Point<3>, 4> p;
  for (std::size_t i = 0; i < 4; ++i) p[i] = mesh.vertices[s[i]];
  double longest2 = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      longest2 = std::max(longest2, detail::squared_distance(p[i], p[j]));
    }
  }
  const Point<3> ab = detail::minus(p[1], p[0]), ac = detail::minus(p[2], p[0]),
                 ad = detail::minus(p[3], p[0]);
  return std::abs(detail::dot(ab, detail::cross(ac, ad))) / (longest2 * std::sqrt(longest2));
}

// One pass over flat tetrahedra. Those beside one that is removed wait for the next round.
class Round {
 public:
  Round(Mesh<3>& mesh, double rho)
      : mesh_(mesh),
        rho_(rho),
        neighbours_(detail::adjacency(mesh.simplices, {}).neighbours),
        used_(mesh.simplices.size()) {
    for (const auto& edge : mesh.edges) lines_.insert({edge.low, edge.high});
    for (const auto& face : mesh.faces) polygons_.emplace(face.corners, face.polygon);
  }

  /// How many are removed.
  std::size_t run(const std::vector<std::uint32_t>& flat) {
    for (const std::uint32_t t : flat) remove(t);
    if (removed_ > 0) store();
    return removed_;
  }

 private:
  bool remove(std::uint32_t t) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (remove_edge_off(t, i, j)) return true;
      }
    }
    return false;
  }

  // The faces across from corners i and j meet in the edge of the other two, k and l.
  bool remove_edge_off(std::uint32_t t, std::size_t i, std::size_t j) {
    const auto [k, l] = others(i, j);
    const Simplex s = mesh_.simplices[t];
    const Edge edge{std::min(s[k], s[l]), std::max(s[k], s[l])};
    if (lines_.count(edge) > 0) return false;
    const auto ring = ring_around(edge, t, s[i], s[j]);
    if (!ring) return false;
    const auto made = filling(edge, ring->corners);
    if (!made || !fits(ring->tetrahedra, *made)) return false;
    if (!exchange_faces({face_of(s[k], s[l], s[i]), face_of(s[k], s[l], s[j])},
                        {face_of(s[i], s[j], s[k]), face_of(s[i], s[j], s[l])})) {
      return false;
    }
    replace(ring->tetrahedra, *made);
    return true;
  }

  static std::pair<std::size_t, std::size_t> others(std::size_t i, std::size_t j) {
    std::size_t k = 0;
    while (k == i || k == j) ++k;
    return {k, 6 - i - j - k};
  }

  // What is around an edge: tetrahedra, and their other corners in turn, `from` the first, `to` the
  // last. The first tetrahedron has both.
  struct Ring {
    std::vector<std::uint32_t> tetrahedra, corners;
  };
  // Nothing if the boundary, a polygon other than at the first tetrahedron, or one that has been
  // used is there.
  [[nodiscard]] std::optional<Ring> ring_around(const Edge& edge, std::uint32_t first,
                                                std::uint32_t from, std::uint32_t to) const {
    Ring ring{{first}, {from}};
    if (used_[first]) return {};
    std::uint32_t behind = to;  // the corner that is left behind
    for (std::uint32_t t = first; ring.corners.back() != to;) {
      t = neighbours_[t][place_in(t, behind)];
      if (t == kNoTriangle || used_[t] || ring.corners.size() == kMostCorners) return {};
      behind = ring.corners.back();
      const std::uint32_t next = fourth(t, edge, behind);
      if (next != to && polygons_.count(face_of(edge[0], edge[1], next)) > 0) return {};
      ring.tetrahedra.push_back(t);
      ring.corners.push_back(next);
    }
    return ring;
  }
  [[nodiscard]] std::size_t place_in(std::uint32_t t, std::uint32_t corner) const {
    const Simplex& s = mesh_.simplices[t];
    return static_cast<std::size_t>(std::find(s.begin(), s.end(), corner) - s.begin());
  }
  // The corner that is none of these three.
  [[nodiscard]] std::uint32_t fourth(std::uint32_t t, const Edge& edge, std::uint32_t v) const {
    const Simplex& s = mesh_.simplices[t];
    return *std::find_if(s.begin(), s.end(),
                         [&](std::uint32_t w) { return w != edge[0] && w != edge[1] && w != v; });
  }

  // The ring in triangles, each with both ends of the edge: of all ways that whose thinnest
  // tetrahedron is thickest. Nothing if there is a flat one in each. (Of from-to, by the corner
  // that makes a triangle of it, and so on.)
  struct Filling {
    double thinnest = std::numeric_limits<double>::infinity();
    std::vector<Simplex> made;
  };
  [[nodiscard]] std::optional<std::vector<Simplex>> filling(
      const Edge& edge, std::span<const std::uint32_t> ring) const {
    Filling best = best_filling(edge, ring);
    if (best.thinnest < kFlatVolume) return {};
    return std::move(best.made);
  }
  [[nodiscard]] Filling best_filling(const Edge& edge, std::span<const std::uint32_t> ring) const {
    if (ring.size() < 3) return {};
    Filling best{0, {}};
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
      Filling tried = on_triangle({ring.front(), ring[i], ring.back()}, edge);
      for (const auto& part : {ring.first(i + 1), ring.subspan(i)}) {
        if (tried.thinnest <= best.thinnest) break;
        Filling rest = best_filling(edge, part);
        tried.thinnest = std::min(tried.thinnest, rest.thinnest);
        tried.made.insert(tried.made.end(), rest.made.begin(), rest.made.end());
      }
      if (tried.thinnest > best.thinnest) best = std::move(tried);
    }
    return best;
  }
  // Both tetrahedra; as thin as can be if the edge does not cross the triangle's plane.
  [[nodiscard]] Filling on_triangle(const Face& corners, const Edge& edge) const {
    const int side = side_of(corners, edge[0]);
    if (side == 0 || side_of(corners, edge[1]) != -side) return {0, {}};
    Filling filling;
    for (const std::uint32_t end : edge) {
      Simplex made{corners[0], corners[1], corners[2], end};
      if ((side < 0) == (end == edge[0])) std::swap(made[0], made[1]);
      if (detail::is_above(detail::radius_edge(mesh_, made), rho_)) return {0, {}};
      filling.thinnest = std::min(filling.thinnest, thickness(mesh_, made));
      filling.made.push_back(detail::smallest_first(made));
    }
    return filling;
  }
  // Whether what is made in the place of others is Delaunay but for rounding, across the faces
  // between two of it and across those to what is around it. What has changed there in this round
  // is not known: then the next one looks at it.
  [[nodiscard]] bool fits(const std::vector<std::uint32_t>& old,
                          const std::vector<Simplex>& made) const {
    std::map<Face, std::vector<Simplex>> beside;
    const auto add = [&](const Simplex& s, const auto& is_wanted) {
      for (std::size_t i = 0; i < 4; ++i) {
        const Face face = face_of(s[(i + 1) % 4], s[(i + 2) % 4], s[(i + 3) % 4]);
        if (is_wanted(face)) beside[face].push_back(s);
      }
    };
    for (const Simplex& s : made) add(s, [](const Face&) { return true; });
    for (const std::uint32_t t : old) {
      for (const std::uint32_t outer : neighbours_[t]) {
        if (outer == kNoTriangle || std::find(old.begin(), old.end(), outer) != old.end()) continue;
        if (used_[outer]) return false;
        add(mesh_.simplices[outer], [&](const Face& face) {
          const auto found = beside.find(face);
          return found != beside.end() && found->second.size() == 1;
        });
      }
    }
    return std::all_of(beside.begin(), beside.end(), [&](const auto& entry) {
      const auto& [face, both] = entry;
      if (both.size() < 2) return true;
      return !is_inside(both[0], opposite(both[1], face)) &&
             !is_inside(both[1], opposite(both[0], face));
    });
  }
  static std::uint32_t opposite(const Simplex& s, const Face& face) {
    return *std::find_if(s.begin(), s.end(), [&](std::uint32_t v) {
      return std::find(face.begin(), face.end(), v) == face.end();
    });
  }
  // Farther inside of the sphere than rounding puts it.
  [[nodiscard]] bool is_inside(const Simplex& s, std::uint32_t v) const {
    const auto& p = mesh_.vertices;
    const Point<3>&a = p[s[0]], &b = p[s[1]], &c = p[s[2]], &d = p[s[3]];
    if (predicates::insphere(a, b, c, d, p[v]) <= 0) return false;
    const detail::Circumcentre centre = detail::circumcentre(a, b, c, d);
    const double far2 = detail::squared_distance(detail::minus(p[v], a), centre.q);
    return std::sqrt(far2) < (1 - kNearSphere) * std::sqrt(centre.length2);
  }
  [[nodiscard]] int side_of(const Face& face, std::uint32_t v) const {
    const auto& p = mesh_.vertices;
    return predicates::orient3d(p[face[0]], p[face[1]], p[face[2]], p[v]);
  }

  void replace(const std::vector<std::uint32_t>& old, const std::vector<Simplex>& made) {
    for (const std::uint32_t t : old) {
      mesh_.simplices[t] = {};
      used_[t] = true;
    }
    made_.insert(made_.end(), made.begin(), made.end());
    ++removed_;
  }

  // The faces at the edge that goes for the two others: false if features do not let it.
  bool exchange_faces(const std::array<Face, 2>& at_edge, const std::array<Face, 2>& others) {
    const auto polygon = polygon_of(at_edge);
    if (!polygon) return false;
    if (*polygon == kNone) return true;
    const auto there = polygon_of(others);
    if (!there || (*there != kNone && *there != *polygon)) return false;
    for (const Face& face : at_edge) polygons_.erase(face);
    for (const Face& face : others) polygons_.emplace(face, *polygon);
    return true;
  }
  // Of both faces; nothing if they differ.
  [[nodiscard]] std::optional<PolygonId> polygon_of(const std::array<Face, 2>& faces) const {
    std::array<PolygonId, 2> found{kNone, kNone};
    for (std::size_t i = 0; i < 2; ++i) {
      if (const auto it = polygons_.find(faces[i]); it != polygons_.end()) found[i] = it->second;
    }
    return found[0] == found[1] ? std::optional(found[0]) : std::nullopt;
  }

  void store() {
    auto& all = mesh_.simplices;
    std::erase(all, Simplex{});
    all.insert(all.end(), made_.begin(), made_.end());
    std::sort(all.begin(), all.end());
    mesh_.faces.clear();
    for (const auto& [corners, polygon] : polygons_) mesh_.faces.push_back({corners, polygon});
  }

  static constexpr PolygonId kNone{INT64_MIN};
  // Ways to fill a ring grow as 4^corners.
  static constexpr std::size_t kMostCorners = 8;

  Mesh<3>& mesh_;
  double rho_;
  std::vector<Simplex> neighbours_;
  std::vector<bool> used_;  // its corners or neighbours are those of before this round
  std::vector<Simplex> made_;
  std::size_t removed_ = 0;
  std::set<Edge> lines_;
  std::map<Face, PolygonId> polygons_;
};

std::vector<std::uint32_t> flat_ones(const Mesh<3>& mesh) {
  std::vector<std::uint32_t> flat;
  for (std::uint32_t t = 0; t < mesh.simplices.size(); ++t) {
    if (thickness(mesh, mesh.simplices[t]) < kFlatVolume) flat.push_back(t);
  }
  return flat;
}

}  // namespace

Unflattened without_flat_tetrahedra(Mesh<3> mesh, double rho) {
  Unflattened result;
  for (std::vector<std::uint32_t> flat; !(flat = flat_ones(mesh)).empty();) {
    const std::size_t removed = Round(mesh, rho).run(flat);
    result.removed += removed;
    if (removed > 0) continue;
    result.left = flat.size();
    break;
  }
  result.mesh = std::move(mesh);
  return result;
}

}  // namespace mesher
