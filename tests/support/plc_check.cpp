// The check, in long doubles: no edge of the mesh pierces a polygon. A face is of a polygon if its
// corners and its middle are on it, and what is above is not flat on it.
#include "plc_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace support {
namespace {

using Real = long double;
using Vector = std::array<Real, 3>;
using mesher::Point;
using Corners = std::array<std::size_t, 4>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector plus(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector times(Real s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
Real dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Real length(const Vector& a) { return std::sqrt(dot(a, a)); }
Vector wide(const Point<3>& p) { return {p[0], p[1], p[2]}; }

// So near a plane rounding may have moved a vertex.
constexpr Real kNoise = 1e-13L;

class Frame {
 public:
  explicit Frame(const ComplexMesh::Face& f) : o_(wide(f.loops[0][0])) {
    for (std::size_t i = 1; i + 1 < f.loops[0].size(); ++i) {
      n_ = plus(n_, cross(minus(wide(f.loops[0][i]), o_), minus(wide(f.loops[0][i + 1]), o_)));
    }
    n_ = times(1 / length(n_), n_);
    u_ = minus(wide(f.loops[0][1]), o_);
    u_ = minus(u_, times(dot(u_, n_), n_));
    u_ = times(1 / length(u_), u_);
    v_ = cross(n_, u_);
    for (const auto& loop : f.loops) {
      auto& flat = loops_.emplace_back();
      for (const Point<3>& p : loop) flat.push_back(in(wide(p)));
    }
  }
  Real height(const Vector& x) const { return dot(minus(x, o_), n_); }
  Real along_normal(const Vector& x) const { return dot(x, n_); }
  bool contains(const Vector& x) const {
    const auto p = in(x);
    bool inside = false;
    for (const auto& loop : loops_) {
      for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
        const auto &a = loop[i], &b = loop[j];
        if ((a[1] > p[1]) == (b[1] > p[1])) continue;
        inside ^= p[0] < a[0] + (p[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1]);
      }
    }
    return inside;
  }
  // Of the outer loop less those of the holes.
  Real area() const {
    Real area = 0;
    for (std::size_t l = 0; l < loops_.size(); ++l) {
      Real twice = 0;
      const auto& loop = loops_[l];
      for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
        twice += loop[j][0] * loop[i][1] - loop[j][1] * loop[i][0];
      }
      area += (l == 0 ? 1 : -1) * std::abs(twice) / 2;
    }
    return area;
  }

 private:
  std::array<Real, 2> in(const Vector& x) const {
    return {dot(minus(x, o_), u_), dot(minus(x, o_), v_)};
  }
  Vector o_, n_{}, u_{}, v_{};
  std::vector<std::vector<std::array<Real, 2>>> loops_;
};

class Check {
 public:
  Check(const ComplexMesh& mesh, double rho) : mesh_(mesh), rho_(rho) {
    for (const Corners& t : mesh.tetrahedra) centres_.push_back(centre(t));
    for (const auto& f : mesh.faces) frames_.emplace_back(f);
    area_.resize(mesh.faces.size());
  }
  ComplexReport report() {
    find_sides();
    check_edges();
    for (const auto& line : lines_) check_line(line);
    for (const auto& [face, sides] : sides_) check_face(face, sides);
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      const Real whole = frames_[f].area();
      report_.area_error =
          std::max(report_.area_error, static_cast<double>(std::abs(area_[f] - whole) / whole));
    }
    for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t) check_tetrahedron(t);
    return report_;
  }

 private:
  using Face = std::array<std::size_t, 3>;

  Vector place(std::size_t v) const { return wide(mesh_.vertices[v]); }
  Vector centre(const Corners& t) const {
    const Vector o = place(t[0]);
    const Vector a = minus(place(t[1]), o), b = minus(place(t[2]), o), c = minus(place(t[3]), o);
    const Vector sum = plus(plus(times(dot(a, a), cross(b, c)), times(dot(b, b), cross(c, a))),
                            times(dot(c, c), cross(a, b)));
    return plus(o, times(1 / (2 * dot(a, cross(b, c))), sum));
  }
  void find_sides() {
    for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t) {
      for (std::size_t i = 0; i < 4; ++i) {
        Face face;
        for (std::size_t k = 0, n = 0; k < 4; ++k) {
          if (k != i) face[n++] = mesh_.tetrahedra[t][k];
        }
        std::sort(face.begin(), face.end());
        sides_[face].push_back(t);
        for (std::size_t k = 0; k < 3; ++k) {
          lines_.insert(
              {std::min(face[k], face[(k + 1) % 3]), std::max(face[k], face[(k + 1) % 3])});
        }
      }
    }
  }
  void check_edges() {
    for (const auto& e : mesh_.edges) {
      for (auto it = e.vertices.begin(); std::next(it) != e.vertices.end(); ++it) {
        const auto [low, high] = std::minmax(it->second, std::next(it)->second);
        report_.missing_edges += lines_.count({low, high}) == 0;
      }
    }
  }
  void check_line(const std::array<std::size_t, 2>& line) {
    const Vector p = place(line[0]), q = place(line[1]);
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      const auto& on = mesh_.faces[f].vertices;
      const Real from = frames_[f].height(p), to = frames_[f].height(q);
      if ((from > 0) == (to > 0) || std::min(std::abs(from), std::abs(to)) < kNoise) continue;
      if (on.count(line[0]) != 0 || on.count(line[1]) != 0) continue;
      const Vector x = plus(p, times(from / (from - to), minus(q, p)));
      if (frames_[f].contains(x)) ++report_.wrong_edges;
    }
  }
  void check_face(const Face& face, const std::vector<std::size_t>& sides) {
    const Vector o = place(face[0]), a = place(face[1]), b = place(face[2]);
    const Vector up = cross(minus(a, o), minus(b, o));
    const Vector middle = times(Real(1) / 3, plus(o, plus(a, b)));
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      const auto& on = mesh_.faces[f].vertices;
      const auto is_on = [&](std::size_t v) { return on.count(v) != 0; };
      if (!std::all_of(face.begin(), face.end(), is_on) || !frames_[f].contains(middle)) continue;
      const bool flat_above = std::any_of(sides.begin(), sides.end(), [&](std::size_t t) {
        const Corners& corners = mesh_.tetrahedra[t];
        if (!std::all_of(corners.begin(), corners.end(), is_on)) return false;
        const auto apex = std::find_if(corners.begin(), corners.end(), [&](std::size_t v) {
          return std::find(face.begin(), face.end(), v) == face.end();
        });
        return (dot(up, minus(place(*apex), o)) > 0) == (frames_[f].along_normal(up) > 0);
      });
      if (!flat_above) area_[f] += length(up) / 2;
    }
  }
  bool is_flat(const Corners& t) const {
    for (const auto& f : mesh_.faces) {
      if (!std::all_of(t.begin(), t.end(), [&](auto v) { return f.vertices.count(v) != 0; }))
        continue;
      return true;
    }
    return false;
  }
  void check_tetrahedron(std::size_t i) {
    const Corners& t = mesh_.tetrahedra[i];
    report_.flat += is_flat(t);
    Real shortest = std::numeric_limits<Real>::infinity();
    std::array<std::size_t, 2> edge{};
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t l = k + 1; l < 4; ++l) {
        const Real d = length(minus(place(t[k]), place(t[l])));
        if (d < shortest) shortest = d, edge = {std::min(t[k], t[l]), std::max(t[k], t[l])};
      }
    }
    const auto ratio = static_cast<double>(length(minus(centres_[i], place(t[0]))) / shortest);
    const bool exempt = mesh_.exempt.count(edge) != 0;
    if (!exempt) report_.worst = std::max(report_.worst, ratio);
    if (ratio > rho_ * (1 + 1e-9)) ++(exempt ? report_.exempt : report_.poor);
  }

  const ComplexMesh& mesh_;
  double rho_;
  std::vector<Vector> centres_;
  std::vector<Frame> frames_;
  std::vector<Real> area_;
  std::map<Face, std::vector<std::size_t>> sides_;
  std::set<std::array<std::size_t, 2>> lines_;
  ComplexReport report_;
};

}  // namespace

ComplexReport check(const ComplexMesh& mesh, double rho) { return Check(mesh, rho).report(); }

}  // namespace support
