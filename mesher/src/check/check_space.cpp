// Verifies a mesh of tetrahedra from its vertices, and the points it is of; see check.hpp.
#include <algorithm>
#include <climits>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "check/check_complex.hpp"
#include "check/check_parts.hpp"
#include "check/check_regions.hpp"
#include "check/marked.hpp"
#include "check/poor_beside.hpp"
#include "check/space_quality.hpp"
#include "geometry/box.hpp"
#include "geometry/circumcentre.hpp"
#include "geometry/exact_sign.hpp"
#include "geometry/space_vectors.hpp"
#include "mesh/half_faces.hpp"
#include "mesher/check.hpp"
#include "mesher/predicates.hpp"
#include "sets/union_find.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

using detail::HalfFace;
using detail::Verdict;
using predicates::orient3d;
using predicates::detail::BitRange;
using predicates::detail::kCoordinateBits;

class SpaceChecker {
 public:
  SpaceChecker(const Mesh<3>& mesh, const CheckOptions<3>& options)
      : mesh_(mesh), options_(options), checked_(mesh), box_(checked_.bounding_box()) {}

  std::vector<Finding> run() {
    const bool tiles = findings_.add("coordinates", detail::check_coordinates(mesh_)) &&
                       findings_.add("vertices", detail::check_vertices(mesh_)) &&
                       findings_.add("orientation", detail::check_orientation(mesh_)) &&
                       check("faces", &SpaceChecker::faces) && find_complex() &&
                       check("hull", &SpaceChecker::hull) && check("cover", &SpaceChecker::cover);
    if (tiles && check("delaunay", &SpaceChecker::delaunay) && options_.ties) {
      check("ties", &SpaceChecker::ties);
    }
    if (options_.graph != nullptr) findings_.add("input", detail::check_input(checked_, options_));
    if (has_kinds()) check("kinds", &SpaceChecker::kinds);
    if (tiles && has_parts()) check_features();
    if (tiles && options_.rho) check("quality", &SpaceChecker::quality);
    if (tiles && options_.max_measure) {
      findings_.add("volume", detail::check_volumes(mesh_, *options_.max_measure));
    }
    return findings_.take();
  }

 private:
  static Verdict good(std::string detail) { return Verdict::good(std::move(detail)); }
  static Verdict bad(std::string detail) { return Verdict::bad(std::move(detail)); }

  bool check(const char* property, Verdict (SpaceChecker::*verify)()) {
    return findings_.add(property, (this->*verify)());
  }

  Verdict faces() {
    std::size_t count = 0;
    for (std::size_t i = 0, n = 0; i < sides().size(); i += n, ++count) {
      n = sides().partners(i);
      const HalfFace& half = sides()[i];
      if (n > 2) return bad(face(half) + " is of more than two tetrahedra");
      if (n == 2 && !half.faces_away_from(sides()[i + 1])) {
        return bad(face(half) + " has two tetrahedra on one side: " + simplex(half.tetrahedron) +
                   ", and " + simplex(sides()[i + 1].tetrahedron));
      }
    }
    border_ = sides().border();
    return good(std::to_string(count) + " faces, " + std::to_string(border_.size()) +
                " on the hull");
  }

  // Whether it has been looked at; its verdicts come later.
  bool find_complex() {
    if (options_.graph != nullptr && !is_bare(options_.graph->graph))
      complex_.emplace(checked_, options_);
    return true;
  }
  [[nodiscard]] bool has_parts() const {
    const auto* f = options_.features;
    return complex_ ||
           (f != nullptr && !(f->edges.empty() && f->faces.empty() && f->regions.empty()));
  }
  void check_features() {
    if (options_.features != nullptr && !check("parts", &SpaceChecker::parts)) return;
    if (complex_) {
      const bool segments = findings_.add("segments", complex_->segments());
      const bool polygons = findings_.add("polygons", complex_->polygons());
      if (segments && polygons && detail::tells_markers(options_)) {
        findings_.add("markers", complex_->markers());
      }
    }
    check("regions", &SpaceChecker::regions);
  }

  // In a polygon of the complex, or else what the mesh says.
  [[nodiscard]] bool is_in_polygon(const detail::Face& key) const {
    if (complex_) return complex_->is_in_polygon(key);
    if (options_.features == nullptr) return false;
    const auto& faces = options_.features->faces;
    const auto it = std::lower_bound(
        faces.begin(), faces.end(), key,
        [](const MeshFace& f, const detail::Face& corners) { return f.key() < corners; });
    return it != faces.end() && it->key() == key;
  }

  Verdict hull() {
    if (border_.empty()) {
      const bool may_be_empty = options_.boundary == BoundaryRule::lines &&
                                options_.graph != nullptr && !options_.graph->graph.holes().empty();
      return may_be_empty ? good("no tetrahedra: polygons enclose nothing but holes")
                          : bad("no tetrahedra");
    }
    for (const HalfFace& half : border_) {
      if (on_box(half)) continue;
      if (options_.boundary == BoundaryRule::lines) {
        if (is_in_polygon(half.key())) continue;
        return bad(face(half) + " is of " + simplex(half.tetrahedron) +
                   " alone, and neither on a side of the box nor in a polygon");
      }
      if (options_.boundary == BoundaryRule::box) {
        return bad(face(half) + " is of " + simplex(half.tetrahedron) +
                   " alone, and not on a side of the box");
      }
      if (const auto outside = beyond(half)) {
        return bad(face(half) + " is of " + simplex(half.tetrahedron) + " alone, but " +
                   vertex(*outside) + " is beyond its plane");
      }
    }
    const bool is_box = std::all_of(border_.begin(), border_.end(),
                                    [&](const HalfFace& half) { return on_box(half); });
    const char* const body = options_.boundary == BoundaryRule::lines
                                 ? "what polygons enclose in the box "
                                 : "a convex body in the box ";
    return good((is_box ? "the box " : body) + text::to_text<3>(box_.lo) + " to " +
                text::to_text<3>(box_.hi));
  }

  Verdict cover() {
    std::vector<std::vector<std::size_t>> parts = parts_to_cover();
    for (const auto& part : parts) {
      const auto place = inner_place(part);
      if (!place) return bad("no tetrahedron has room for a place inside");
      const auto& [at, inside] = *place;
      for (std::size_t i = 0; i < mesh_.simplices.size(); ++i) {
        if (i == inside || !covers(i, at)) continue;
        return bad(simplex(inside) + " overlaps " + simplex(i) + " at " + text::to_text<3>(at));
      }
    }
    return good("each place once");
  }

  // Tetrahedra of which one has to be looked at: any; or if the body need not be convex, those that
  // hang together, and those beside one part of the boundary.
  [[nodiscard]] std::vector<std::vector<std::size_t>> parts_to_cover() const {
    std::vector<std::size_t> all(mesh_.simplices.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    if (options_.boundary != BoundaryRule::lines) return {all};
    detail::UnionFind bodies(mesh_.simplices.size()), surfaces(border_.size());
    for (std::size_t i = 0; i < sides().size(); i += sides().partners(i)) {
      if (sides().partners(i) != 2) continue;
      bodies.unite(sides()[i].tetrahedron, sides()[i + 1].tetrahedron);
    }
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> first;  // face of the boundary, by edge
    for (std::uint32_t i = 0; i < border_.size(); ++i) {
      const auto [a, b, c] = border_[i].face;
      for (const auto& [p, q] : {std::minmax(a, b), std::minmax(b, c), std::minmax(c, a)}) {
        surfaces.unite(first.try_emplace({p, q}, i).first->second, i);
      }
    }
    std::map<std::uint32_t, std::vector<std::size_t>> of_body, of_surface;
    for (std::uint32_t i = 0; i < all.size(); ++i) of_body[bodies.find(i)].push_back(i);
    for (std::uint32_t i = 0; i < border_.size(); ++i) {
      of_surface[surfaces.find(i)].push_back(border_[i].tetrahedron);
    }
    std::vector<std::vector<std::size_t>> parts;
    for (auto* groups : {&of_body, &of_surface}) {
      for (auto& [least, part] : *groups) parts.push_back(std::move(part));
    }
    return parts;
  }

  Verdict delaunay() {
    std::size_t inner = 0, ties = 0, near = 0;
    for (std::size_t i = 0; i < sides().size(); i += sides().partners(i)) {
      if (sides().partners(i) != 2) continue;
      ++inner;
      const int side = in_sphere(i, predicates::insphere);
      if (side == 0) ++ties;
      if (side <= 0) continue;
      if (!options_.near_delaunay || !is_near_sphere(i)) return bad(inside_sphere(i, " is inside"));
      ++near;
    }
    return good(std::to_string(inner) + " inner faces, " + std::to_string(ties) + " of them ties" +
                (near > 0 ? ", " + std::to_string(near) + " nearly" : ""));
  }

  Verdict ties() {
    for (std::size_t i = 0; i < sides().size(); i += sides().partners(i)) {
      if (sides().partners(i) != 2 || in_sphere(i, predicates::insphere_perturbed) < 0) {
        continue;
      }
      return bad(inside_sphere(i, ", by the order of coordinates, counts as inside"));
    }
    return good("decided by the order of coordinates");
  }

  Verdict parts() {
    std::set<std::array<std::uint32_t, 2>> edges;
    std::set<detail::Face> faces;
    for (std::size_t i = 0; i < sides().size(); i += sides().partners(i)) {
      const auto [a, b, c] = sides()[i].key();
      faces.insert({a, b, c});
      edges.insert({{a, b}, {a, c}, {b, c}});
    }
    for (const MeshEdge& e : options_.features->edges) {
      if (edges.count({e.low, e.high}) != 0) continue;
      return bad("no tetrahedron has " + checked_.edge(e.low, e.high));
    }
    for (const MeshFace& f : options_.features->faces) {
      if (faces.count(f.key()) == 0) return bad("no tetrahedron has " + face(f.key()));
    }
    return good(std::to_string(options_.features->edges.size()) + " edges and " +
                std::to_string(options_.features->faces.size()) + " faces are of tetrahedra");
  }

  Verdict regions() {
    const auto is_in = [&](const HalfFace& half) { return is_in_polygon(half.key()); };
    const auto seeded_by = [&](const Point<3>& seed) { return this->seeded_by(seed); };
    return detail::RegionCheck(checked_, options_, is_in, seeded_by).run();
  }

  // The tetrahedron that a seed stands for; nothing if it is outside, or on a polygon, where it
  // stands for neither side.
  [[nodiscard]] std::optional<std::size_t> seeded_by(const Point<3>& seed) const {
    const auto is_on_polygon = [&](const detail::Face& f) {
      const HalfFace half{f, 0, 0};
      return orient3d(at(f[0]), at(f[1]), at(f[2]), seed) == 0 && is_in_polygon(half.key());
    };
    std::optional<std::size_t> first;
    for (std::size_t t = 0; t < mesh_.simplices.size(); ++t) {
      if (!covers(t, seed)) continue;
      const auto faces = detail::faces_of(mesh_.simplices[t]);
      if (std::any_of(faces.begin(), faces.end(), is_on_polygon)) return std::nullopt;
      if (!first) first = t;
    }
    return first;
  }

  [[nodiscard]] bool has_kinds() const {
    return std::any_of(mesh_.kinds.begin(), mesh_.kinds.end(),
                       [](VertexKind kind) { return kind != VertexKind::steiner; });
  }

  Verdict kinds() {
    return detail::check_kinds(
        mesh_, options_.graph,
        options_.features == nullptr ? kNoOrigins : options_.features->origins);
  }

  Verdict quality() {
    std::size_t excused = 0;
    std::optional<detail::IsolatedEdges> isolated;  // made where it is asked for
    detail::GuardCounts gave_in;
    for (std::size_t i = 0; i < mesh_.simplices.size(); ++i) {
      const auto ratio = detail::radius_edge(mesh_, mesh_.simplices[i]);
      if (!detail::is_above(ratio, *options_.rho)) continue;
      if (complex_ && complex_->excuses(mesh_.simplices[i])) {
        ++excused;
        continue;
      }
      if (complex_ && *options_.rho < kGuarded) {
        if (!isolated) isolated.emplace(options_.graph->graph);
        const auto& [a, b, c, d] = mesh_.simplices[i];
        const auto edges = detail::GuardCounts::shortest_edges({at(a), at(b), at(c), at(d)});
        if (gave_in.look(edges, ratio.ratio,
                         [&](const auto& p, const auto& q) { return isolated->find(p, q); })) {
          continue;
        }
      }
      return bad(simplex(i) + ", one of them " + vertex(mesh_.simplices[i][0]) +
                 ", has radius-edge " + text::to_text(ratio.ratio) + ", above rho " +
                 text::to_text(*options_.rho));
    }
    const SpaceQuality worst = mesher::quality(mesh_);
    const std::size_t left = gave_in.report().tetrahedra;
    return good("radius-edge at most " + text::to_text(worst.max_radius_edge) +
                ", dihedral angles from " + text::to_text(worst.min_dihedral_deg) + " to " +
                text::to_text(worst.max_dihedral_deg) + " degrees, " +
                std::to_string(worst.slivers) + " slivers below " + text::to_text(kSliverDegrees) +
                (excused > 0 ? ", " + std::to_string(excused) + " above rho at small angles" : "") +
                (left > 0 ? ", " + std::to_string(left) + " left poor beside features" : ""));
  }

  // Across the face of half-faces i and i + 1: where the corner of the second is of the sphere of
  // the first's tetrahedron.
  template <class Predicate>
  [[nodiscard]] int in_sphere(std::size_t i, Predicate predicate) const {
    const auto& [a, b, c, d] = mesh_.simplices[sides()[i].tetrahedron];
    return predicate(at(a), at(b), at(c), at(d), at(sides()[i + 1].opposite));
  }
  // Of a corner inside.
  [[nodiscard]] bool is_near_sphere(std::size_t i) const {
    const auto& [a, b, c, d] = mesh_.simplices[sides()[i].tetrahedron];
    const detail::Circumcentre centre = detail::circumcentre(at(a), at(b), at(c), at(d));
    const Point<3> to = detail::minus(at(sides()[i + 1].opposite), at(a));
    const double far2 = detail::squared_distance(to, centre.q);
    return std::sqrt(far2) >= (1 - kNearSphere) * std::sqrt(centre.length2);
  }
  [[nodiscard]] std::string inside_sphere(std::size_t i, const char* what) const {
    return vertex(sides()[i + 1].opposite) + what + " the sphere of " +
           simplex(sides()[i].tetrahedron) + " across " + face(sides()[i]);
  }

  // A place strictly inside one of some tetrahedra, and that tetrahedron.
  [[nodiscard]] std::optional<std::pair<Point<3>, std::size_t>> inner_place(
      const std::vector<std::size_t>& tetrahedra) const {
    int high = INT_MIN;  // what has more bits below is beyond the predicates' range
    for (const Point<3>& p : mesh_.vertices) high = std::max(high, BitRange(p).high);
    for (const std::size_t i : tetrahedra) {
      Point<3> middle{};
      for (const std::uint32_t corner : mesh_.simplices[i]) {
        for (std::size_t k = 0; k < 3; ++k) middle[k] += at(corner)[k] / 4;
      }
      for (double& x : middle) x = without_digits(x, high - kCoordinateBits<4>);
      if (in_tetrahedron(i, middle, 1)) return std::pair(middle, i);
    }
    return std::nullopt;
  }
  // Rounded to a multiple of 2^last. (A double of 2^(52 + last) or more is one.)
  static double without_digits(double x, int last) {
    const double scaled = std::ldexp(x, -last);
    return std::abs(scaled) < 0x1p52 ? std::ldexp(std::nearbyint(scaled), last) : x;
  }
  // Its boundary included.
  [[nodiscard]] bool covers(std::size_t i, const Point<3>& p) const {
    return in_tetrahedron(i, p, 0);
  }
  [[nodiscard]] bool in_tetrahedron(std::size_t i, const Point<3>& p, int least) const {
    const auto faces = detail::faces_of(mesh_.simplices[i]);
    return std::all_of(faces.begin(), faces.end(), [&](const detail::Face& f) {
      return -orient3d(at(f[0]), at(f[1]), at(f[2]), p) >= least;
    });
  }

  [[nodiscard]] bool on_box(const HalfFace& half) const {
    return detail::is_on_side<3>(box_, checked_.places_of(half.face));
  }
  // A vertex on the outer side of a face's plane.
  [[nodiscard]] std::optional<std::size_t> beyond(const HalfFace& half) const {
    const auto [a, b, c] = half.face;
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      if (orient3d(at(a), at(b), at(c), at(v)) > 0) return v;
    }
    return std::nullopt;
  }

  [[nodiscard]] const Point<3>& at(std::size_t v) const { return mesh_.vertices[v]; }
  [[nodiscard]] std::string vertex(std::size_t v) const { return checked_.vertex(v); }
  [[nodiscard]] std::string simplex(std::size_t i) const { return checked_.simplex(i); }
  [[nodiscard]] std::string face(const HalfFace& half) const { return checked_.side(half); }
  [[nodiscard]] std::string face(const detail::Face& key) const { return checked_.face(key); }
  [[nodiscard]] const detail::HalfFaces& sides() const { return checked_.sides(); }

  inline static const std::vector<Feature> kNoOrigins;
  const Mesh<3>& mesh_;
  const CheckOptions<3>& options_;
  detail::CheckedMesh<3> checked_;
  Box<3> box_;
  std::vector<HalfFace> border_;                 // of faces of one tetrahedron
  std::optional<detail::ComplexCheck> complex_;  // if one is given
  detail::Findings findings_;
};

}  // namespace

BoundaryRule boundary_rule(const MeshData<3>& mesh, const GraphFile<3>* complex) {
  const auto& faces = mesh.features.faces;
  const bool has_polygons =
      (complex != nullptr && !complex->graph.polygons.empty()) ||
      std::any_of(faces.begin(), faces.end(), [](const auto& f) { return f.polygon.has_value(); });
  if (!has_polygons) return BoundaryRule::box;
  if (complex == nullptr || mesh.simplices.empty()) return BoundaryRule::lines;
  return detail::rule_of(detail::CheckedMesh<3>(mesh), complex->graph);
}

std::vector<Finding> check_mesh(const Mesh<3>& mesh, const CheckOptions<3>& options) {
  return SpaceChecker(mesh, options).run();
}

}  // namespace mesher
