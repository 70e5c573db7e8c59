// Draws what is left of a mesh of tetrahedra behind a cut, from the back to the front.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/box.hpp"
#include "geometry/circumcentre.hpp"
#include "geometry/space_vectors.hpp"
#include "io/svg_canvas.hpp"
#include "mesh/half_faces.hpp"
#include "mesher/write.hpp"

namespace mesher {
namespace {

using detail::dot;
using detail::Face;
using Simplex = Mesh<3>::Simplex;

constexpr std::size_t kCutAxis = 1;                    // the cut is y = constant,
constexpr Point<3> kToViewer{-0.36, -0.8, 0.48};       // seen from here: unit vectors,
constexpr Point<3> kToLight{-0.48, -0.6, 0.64};        // as sums of squares show
constexpr double kBest = 0.6123724356957945;           // sqrt(6) / 4, of a regular tetrahedron
constexpr double kWorst = 2;                           // what has the full colour
constexpr std::array<double, 3> kGood{247, 244, 234};  // red, green, blue
constexpr std::array<double, 3> kPoor{64, 124, 184};
constexpr std::array<double, 3> kChanged{255, 179, 71};
constexpr std::array<double, 3> kInPolygon{163, 201, 145};

// The directions of the picture: to the right, up, and to the viewer; orthonormal.
struct Camera {
  Point<3> right{}, up{};

  Camera() {
    const Point<3>& w = kToViewer;
    const double length = std::sqrt(w[0] * w[0] + w[1] * w[1]);
    right = {-w[1] / length, w[0] / length, 0};
    up = detail::cross(w, right);
  }
  [[nodiscard]] Point<2> project(const Point<3>& p) const { return {dot(p, right), dot(p, up)}; }
};

Point<3> middle_of(const Mesh<3>& mesh, const Simplex& s) {
  Point<3> sum{};
  for (const std::uint32_t v : s) sum = detail::plus(sum, mesh.vertices[v]);
  return detail::scaled(0.25, sum);
}

bool is_shown(const Point<3>& middle, const Box<3>& window) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (middle[i] < window.lo[i] || middle[i] > window.hi[i]) return false;
  }
  return 2 * middle[kCutAxis] > window.lo[kCutAxis] + window.hi[kCutAxis];
}

double shortest_edge(const Mesh<3>& mesh, const Simplex& s) {
  double least = INFINITY;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = i + 1; k < 4; ++k) {
      least = std::min(least, detail::squared_distance(mesh.vertices[s[i]], mesh.vertices[s[k]]));
    }
  }
  return std::sqrt(least);
}

using Colour = std::array<double, 3>;

Colour colour_of(double ratio) {
  const double share = std::clamp((ratio - kBest) / (kWorst - kBest), 0.0, 1.0);
  Colour colour;
  for (std::size_t i = 0; i < 3; ++i) colour[i] = kGood[i] + share * (kPoor[i] - kGood[i]);
  return colour;
}

// A face that the viewer may see.
struct Shown {
  Face face;
  Colour colour;
};

// Which faces and edges of a mesh are parts of the input's.
class Parts {
 public:
  using Ends = std::array<std::uint32_t, 2>;

  explicit Parts(const Mesh<3>& mesh) {
    for (const auto& f : mesh.faces) faces_.push_back(f.corners);
    for (const auto& e : mesh.edges) edges_.push_back({e.low, e.high});
    sort();
  }
  explicit Parts(const MeshFeatures& features) {
    for (const MeshFace& f : features.faces) {
      if (f.polygon) faces_.push_back(f.key());
    }
    for (const MeshEdge& e : features.edges) edges_.push_back({e.low, e.high});
    sort();
  }
  /// By its corners, ascending.
  [[nodiscard]] bool has(const Face& key) const {
    return std::binary_search(faces_.begin(), faces_.end(), key);
  }
  [[nodiscard]] bool has_edge(std::uint32_t a, std::uint32_t b) const {
    return std::binary_search(edges_.begin(), edges_.end(), Ends{std::min(a, b), std::max(a, b)});
  }

 private:
  void sort() {
    std::sort(faces_.begin(), faces_.end());
    std::sort(edges_.begin(), edges_.end());
  }
  std::vector<Face> faces_;
  std::vector<Ends> edges_;
};

// The faces of what is left that are turned to the viewer, those behind first.
class Scene {
 public:
  Scene(const Mesh<3>& mesh, const Parts& parts, const SvgView<3>& view) : mesh_(mesh) {
    coloured_ = view.coloured;
    std::sort(coloured_.begin(), coloured_.end());
    std::vector<Simplex> left;
    for (const Simplex& s : mesh.simplices) {
      if (is_shown(middle_of(mesh, s), view.window)) left.push_back(s);
    }
    for (const Placed& placed : turned_to_viewer(left)) {
      const auto& [face, opposite, tetrahedron] = placed.half;
      const Colour colour =
          parts.has(placed.half.key()) ? kInPolygon : base_colour(left[tetrahedron]);
      faces_.push_back({face, shaded(colour, normal_of(face))});
    }
  }

  [[nodiscard]] const std::vector<Shown>& faces() const { return faces_; }

 private:
  struct Placed {
    std::array<double, 2> depth;
    detail::HalfFace half;
  };

  [[nodiscard]] std::vector<Placed> turned_to_viewer(const std::vector<Simplex>& left) const {
    std::vector<Placed> placed;
    for (const auto& half : detail::HalfFaces(left).border()) {
      if (dot(normal_of(half.face), kToViewer) <= 0) continue;
      placed.push_back({depth_of(left[half.tetrahedron]), half});
    }
    std::stable_sort(placed.begin(), placed.end(),
                     [](const Placed& a, const Placed& b) { return a.depth < b.depth; });
    return placed;
  }

  // Towards the viewer: of the circumcentre, then, where spheres are one, of the middle.
  [[nodiscard]] std::array<double, 2> depth_of(const Simplex& s) const {
    const Point<3>& a = mesh_.vertices[s[0]];
    return {dot(detail::plus(a, centre_of(s).q), kToViewer), dot(middle_of(mesh_, s), kToViewer)};
  }
  [[nodiscard]] detail::Circumcentre centre_of(const Simplex& s) const {
    const auto& v = mesh_.vertices;
    return detail::circumcentre(v[s[0]], v[s[1]], v[s[2]], v[s[3]]);
  }

  [[nodiscard]] Point<3> normal_of(const Face& f) const {
    const auto& v = mesh_.vertices;
    const Point<3> n =
        detail::cross(detail::minus(v[f[1]], v[f[0]]), detail::minus(v[f[2]], v[f[0]]));
    const double length = std::sqrt(dot(n, n));
    return length > 0 ? detail::scaled(1 / length, n) : n;
  }
  [[nodiscard]] Colour base_colour(const Simplex& s) const {
    const auto& v = mesh_.vertices;
    const std::array<Point<3>, 4> places{v[s[0]], v[s[1]], v[s[2]], v[s[3]]};
    if (std::binary_search(coloured_.begin(), coloured_.end(), places)) return kChanged;
    return colour_of(std::sqrt(centre_of(s).length2) / shortest_edge(mesh_, s));
  }
  static Colour shaded(Colour colour, const Point<3>& normal) {
    const double light = 0.72 + 0.28 * std::max(0.0, dot(normal, kToLight));
    for (double& c : colour) c *= light;
    return colour;
  }

  const Mesh<3>& mesh_;
  std::vector<std::array<Point<3>, 4>> coloured_;
  std::vector<Shown> faces_;
};

// What faces take up of the picture's plane, with a little room around them; a unit square if there
// are none.
Box<2> extent_of(const std::vector<Shown>& faces, const Mesh<3>& mesh, const Camera& camera) {
  std::vector<Point<2>> corners;
  for (const Shown& shown : faces) {
    for (const std::uint32_t v : shown.face) corners.push_back(camera.project(mesh.vertices[v]));
  }
  if (corners.empty()) return {{0, 0}, {1, 1}};
  Box<2> box = detail::bounding_box<2>(corners);
  const double margin = detail::longest_side(box) / 64;
  for (std::size_t i = 0; i < 2; ++i) {
    box.lo[i] -= margin;
    box.hi[i] += margin;
  }
  return box;
}

// Writes the faces, with their edges on lines, and each input point on the last face that it is a
// corner of.
class Drawing {
 public:
  Drawing(const std::vector<Shown>& faces, const Mesh<3>& mesh, const Parts& parts,
          const Box<3>& window, TextFile& file)
      : faces_(faces),
        mesh_(mesh),
        parts_(parts),
        canvas_(extent_of(faces, mesh, camera_), file),
        file_(file) {
    front_ = dot(window.lo, kToViewer);
    back_ = front_;
    for (std::size_t i = 0; i < 3; ++i) {
      const double across = (window.hi[i] - window.lo[i]) * kToViewer[i];
      (across > 0 ? front_ : back_) += across;
    }
  }

  void draw() {
    canvas_.begin();
    file_ << "<g stroke=\"#3b5b7c\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n";
    std::vector<std::uint32_t> left(mesh_.vertices.size(), 0);
    std::vector<double> shortest(mesh_.vertices.size(), svg::kLongerSide);
    for (const Shown& shown : faces_) {
      const double side = shortest_side(shown.face);
      for (const std::uint32_t v : shown.face) {
        ++left[v];
        shortest[v] = std::min(shortest[v], side);
      }
    }
    for (const Shown& shown : faces_) {
      draw_face(shown);
      draw_edges(shown.face);
      for (const std::uint32_t v : shown.face) {
        if (--left[v] == 0 && mesh_.kinds[v] == VertexKind::input) draw_dot(v, shortest[v]);
      }
    }
    file_ << "</g>\n</svg>\n";
  }

 private:
  [[nodiscard]] Point<2> seen(std::uint32_t v) const { return camera_.project(mesh_.vertices[v]); }

  [[nodiscard]] double shortest_side(const Face& f) const {
    const Point<2> a = seen(f[0]), b = seen(f[1]), c = seen(f[2]);
    return std::min({canvas_.distance(a, b), canvas_.distance(b, c), canvas_.distance(c, a)});
  }

  void draw_face(const Shown& shown) {
    const auto& [face, colour] = shown;
    const Point<2> a = seen(face[0]), b = seen(face[1]), c = seen(face[2]);
    file_ << "<path fill=\"" << hexadecimal(colour, fade_at(face)) << "\" stroke-width=\"";
    canvas_.number(std::ldexp(svg::kLineShare, svg::length_class(shortest_side(face)) - 1));
    file_ << "\" d=\"M";
    canvas_.point(a);
    file_ << 'L';
    canvas_.point(b);
    file_ << 'L';
    canvas_.point(c);
    file_ << "Z\"/>\n";
  }

  void draw_edges(const Face& face) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = face[i], b = face[(i + 1) % 3];
      if (!parts_.has_edge(a, b)) continue;
      file_ << "<path stroke=\"#1f2d3d\" stroke-width=\"";
      canvas_.number(std::ldexp(svg::kLineShare, svg::length_class(shortest_side(face)) + 1));
      file_ << "\" d=\"M";
      canvas_.point(seen(a));
      file_ << 'L';
      canvas_.point(seen(b));
      file_ << "\"/>\n";
    }
  }

  void draw_dot(std::uint32_t v, double shortest) {
    const Point<2> p = seen(v);
    file_ << "<path stroke=\"#c0392b\" stroke-width=\"";
    canvas_.number(std::ldexp(svg::kDotShare, svg::length_class(shortest)));
    file_ << "\" d=\"M";
    canvas_.point(p);
    file_ << "h0\"/>\n";
  }

  // What is at the back has less of its light.
  [[nodiscard]] double fade_at(const Face& f) const {
    const double depth = dot(mesh_.vertices[f[0]], kToViewer);
    return 0.85 + 0.15 * std::clamp((depth - back_) / (front_ - back_), 0.0, 1.0);
  }

  static std::string hexadecimal(const Colour& colour, double factor) {
    constexpr char kDigits[] = "0123456789abcdef";
    std::string text = "#";
    for (const double c : colour) {
      const auto value = static_cast<unsigned>(std::clamp(std::round(c * factor), 0.0, 255.0));
      text += kDigits[value / 16];
      text += kDigits[value % 16];
    }
    return text;
  }

  const std::vector<Shown>& faces_;
  const Mesh<3>& mesh_;
  const Parts& parts_;
  Camera camera_;
  svg::Canvas canvas_;
  TextFile& file_;
  double front_ = 0, back_ = 0;  // depths of the window
};

}  // namespace

namespace {

void draw(const Mesh<3>& mesh, const Parts& parts, const SvgView<3>& view, TextFile& file) {
  const Scene scene(mesh, parts, view);
  Drawing(scene.faces(), mesh, parts, view.window, file).draw();
}

}  // namespace

void write_svg(const Mesh<3>& mesh, const SvgView<3>& view, TextFile& file) {
  draw(mesh, Parts(mesh), view, file);
}

void write_svg(const Mesh<3>& mesh, const MeshFeatures& features, const SvgView<3>& view,
               TextFile& file) {
  draw(mesh, features.empty() ? Parts(mesh) : Parts(features), view, file);
}

}  // namespace mesher
