// Verifies a mesh of tetrahedra from its vertices, and the points it is of; see space_check.hpp.
#include <algorithm>
#include <climits>
#include <cmath>
#include <optional>

#include "geometry/box.hpp"
#include "geometry/exact_sign.hpp"
#include "io/text.hpp"
#include "mesh/check_parts.hpp"
#include "mesh/half_faces.hpp"
#include "mesh/space_quality.hpp"
#include "mesher/predicates.hpp"
#include "mesher/space_check.hpp"

namespace mesher {
namespace {

using detail::HalfFace;
using detail::simplex_name;
using detail::Verdict;
using detail::vertex_name;
using predicates::orient3d;
using predicates::detail::BitRange;
using predicates::detail::kCoordinateBits;

class SpaceChecker {
 public:
  SpaceChecker(const Mesh<3>& mesh, const SpaceCheckOptions& options)
      : mesh_(mesh), options_(options), box_(detail::bounding_box<3>(mesh.vertices)) {}

  std::vector<Finding> run() {
    const bool tiles = findings_.add("coordinates", detail::check_coordinates(mesh_)) &&
                       findings_.add("vertices", detail::check_vertices(mesh_)) &&
                       findings_.add("orientation", detail::check_orientation(mesh_)) &&
                       check("faces", &SpaceChecker::faces) && check("hull", &SpaceChecker::hull) &&
                       check("cover", &SpaceChecker::cover);
    if (tiles && check("delaunay", &SpaceChecker::delaunay) && options_.ties) {
      check("ties", &SpaceChecker::ties);
    }
    if (options_.input != nullptr) check("input", &SpaceChecker::input);
    if (has_kinds()) check("kinds", &SpaceChecker::kinds);
    if (tiles && options_.rho) check("quality", &SpaceChecker::quality);
    return findings_.take();
  }

 private:
  static Verdict good(std::string detail) { return Verdict::good(std::move(detail)); }
  static Verdict bad(std::string detail) { return Verdict::bad(std::move(detail)); }

  bool check(const char* property, Verdict (SpaceChecker::*verify)()) {
    return findings_.add(property, (this->*verify)());
  }

  Verdict faces() {
    half_faces_.emplace(mesh_.simplices);
    std::size_t count = 0;
    for (std::size_t i = 0, n = 0; i < half_faces_->size(); i += n, ++count) {
      n = half_faces_->partners(i);
      const HalfFace& half = (*half_faces_)[i];
      if (n > 2) return bad(face(half) + " is of more than two tetrahedra");
      if (n == 2 && !half.faces_away_from((*half_faces_)[i + 1])) {
        return bad(face(half) + " has two tetrahedra on one side: " + simplex(half.tetrahedron) +
                   ", and " + simplex((*half_faces_)[i + 1].tetrahedron));
      }
    }
    border_ = half_faces_->border();
    return good(std::to_string(count) + " faces, " + std::to_string(border_.size()) +
                " on the hull");
  }

  Verdict hull() {
    if (border_.empty()) return bad("no tetrahedra");
    for (const HalfFace& half : border_) {
      if (on_box(half)) continue;
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
    return good((is_box ? "the box " : "a convex body in the box ") + text::to_text<3>(box_.lo) +
                " to " + text::to_text<3>(box_.hi));
  }

  Verdict cover() {
    const auto place = inner_place();
    if (!place) return bad("no tetrahedron has room for a place inside");
    const auto& [at, inside] = *place;
    for (std::size_t i = 0; i < mesh_.simplices.size(); ++i) {
      if (i == inside || !covers(i, at)) continue;
      return bad(simplex(inside) + " overlaps " + simplex(i) + " at " + text::to_text<3>(at));
    }
    return good("each place once");
  }

  Verdict delaunay() {
    std::size_t inner = 0, ties = 0;
    for (std::size_t i = 0; i < half_faces_->size(); i += half_faces_->partners(i)) {
      if (half_faces_->partners(i) != 2) continue;
      ++inner;
      const int side = in_sphere(i, predicates::insphere);
      if (side == 0) ++ties;
      if (side > 0) return bad(inside_sphere(i, " is inside"));
    }
    return good(std::to_string(inner) + " inner faces, " + std::to_string(ties) + " of them ties");
  }

  Verdict ties() {
    for (std::size_t i = 0; i < half_faces_->size(); i += half_faces_->partners(i)) {
      if (half_faces_->partners(i) != 2 || in_sphere(i, predicates::insphere_perturbed) < 0) {
        continue;
      }
      return bad(inside_sphere(i, ", by the order of coordinates, counts as inside"));
    }
    return good("decided by the order of coordinates");
  }

  Verdict input() {
    return detail::check_input<3>(mesh_, detail::input_points(*options_.input),
                                  [](const Point<3>&) { return false; });
  }

  [[nodiscard]] bool has_kinds() const {
    return std::any_of(mesh_.kinds.begin(), mesh_.kinds.end(),
                       [](VertexKind kind) { return kind != VertexKind::steiner; });
  }

  Verdict kinds() {
    return detail::check_kinds(
        mesh_, options_.input,
        options_.features == nullptr ? kNoOrigins : options_.features->origins);
  }

  Verdict quality() {
    constexpr double kRounding = 1e-9;  // far below any use
    for (std::size_t i = 0; i < mesh_.simplices.size(); ++i) {
      const auto [ratio, error] = detail::radius_edge(mesh_, mesh_.simplices[i]);
      if (ratio - error <= *options_.rho * (1 + kRounding)) continue;
      return bad(simplex(i) + ", one of them " + vertex(mesh_.simplices[i][0]) +
                 ", has radius-edge " + text::to_text(ratio) + ", above rho " +
                 text::to_text(*options_.rho));
    }
    const SpaceQuality worst = mesher::quality(mesh_);
    return good("radius-edge at most " + text::to_text(worst.max_radius_edge) +
                ", dihedral angles from " + text::to_text(worst.min_dihedral_deg) + " to " +
                text::to_text(worst.max_dihedral_deg) + " degrees, " +
                std::to_string(worst.slivers) + " slivers below " + text::to_text(kSliverDegrees));
  }

  // Across the face of half-faces i and i + 1: where the corner of the second is of the sphere of
  // the first's tetrahedron.
  template <class Predicate>
  [[nodiscard]] int in_sphere(std::size_t i, Predicate predicate) const {
    const auto& [a, b, c, d] = mesh_.simplices[(*half_faces_)[i].tetrahedron];
    return predicate(at(a), at(b), at(c), at(d), at((*half_faces_)[i + 1].opposite));
  }
  [[nodiscard]] std::string inside_sphere(std::size_t i, const char* what) const {
    return vertex((*half_faces_)[i + 1].opposite) + what + " the sphere of " +
           simplex((*half_faces_)[i].tetrahedron) + " across " + face((*half_faces_)[i]);
  }

  // A place strictly inside a tetrahedron, and that tetrahedron.
  [[nodiscard]] std::optional<std::pair<Point<3>, std::size_t>> inner_place() const {
    int high = INT_MIN;  // what has more bits below is beyond the predicates' range
    for (const Point<3>& p : mesh_.vertices) high = std::max(high, BitRange(p).high);
    for (std::size_t i = 0; i < mesh_.simplices.size(); ++i) {
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
    const auto [a, b, c] = half.face;
    for (std::size_t i = 0; i < 3; ++i) {
      for (const double side : {box_.lo[i], box_.hi[i]}) {
        if (at(a)[i] == side && at(b)[i] == side && at(c)[i] == side) return true;
      }
    }
    return false;
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
  [[nodiscard]] std::string vertex(std::size_t v) const { return vertex_name(mesh_, v); }
  [[nodiscard]] std::string simplex(std::size_t i) const { return simplex_name(mesh_, i); }
  [[nodiscard]] std::string face(const HalfFace& half) const {
    const auto [a, b, c] = half.key();
    return "the face of " + vertex(a) + ", " + vertex(b) + " and " + vertex(c);
  }

  inline static const std::vector<FeatureId> kNoOrigins;
  const Mesh<3>& mesh_;
  const SpaceCheckOptions& options_;
  Box<3> box_;
  std::optional<detail::HalfFaces> half_faces_;
  std::vector<HalfFace> border_;  // of faces of one tetrahedron
  detail::Findings findings_;
};

}  // namespace

std::vector<Finding> check_mesh(const Mesh<3>& mesh, const SpaceCheckOptions& options) {
  return SpaceChecker(mesh, options).run();
}

}  // namespace mesher
