// Writes pictures of meshes as SVG. Each edge is drawn once, as wide as its length allows, and each
// dot as wide as the shortest edge at it, so that fine parts stay clear when one zooms in. What has
// one width is one path (dots are lines of length 0 with round ends), which keeps files small and
// viewers fast; widths are powers of two, so that there are few.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "geometry/box.hpp"
#include "mesher/svg.hpp"

namespace mesher {
namespace {

constexpr double kLongerSide = 1000;   // units of the picture
constexpr int kLongest = 3;            // lines of length 2^3 and more have the full width,
constexpr int kShortest = -6;          // those below 2^-6 the least
constexpr double kLineShare = 0x1p-3;  // a line's width over its length
constexpr double kDotShare = 0.625;    // a dot's width over the shortest edge at it
constexpr double kThick = 2;           // an edge on a line over another edge, in width,
constexpr double kLeastOnLine = 0.75;  // and at least so wide: a line stays in sight

// Of regions, in the order of their attributes; then again from the first.
constexpr const char* kRegionColours[] = {"#dbe9f6", "#fde3cf", "#ddf0dc", "#f6dce6",
                                          "#ebe3f5", "#fdf6cf", "#d9f0ee", "#ece6df"};

double longer_side(const Box<2>& box) {
  return std::max(box.hi[0] - box.lo[0], box.hi[1] - box.lo[1]);
}

using Edge = std::array<std::uint32_t, 2>;

// Maps the window onto the picture and writes rounded coordinates.
class Canvas {
 public:
  Canvas(const Box<2>& window, TextFile& file)
      : window_(window), scale_(kLongerSide / longer_side(window)), file_(file) {}

  [[nodiscard]] bool shows(const Point<2>& a, const Point<2>& b) const { return shows(a, b, b); }
  [[nodiscard]] bool shows(const Point<2>& a, const Point<2>& b, const Point<2>& c) const {
    const Box<2> box = detail::bounding_box<2>(std::array{a, b, c});
    return !detail::is_empty(detail::common(box, window_));
  }
  [[nodiscard]] double width() const { return scale_ * (window_.hi[0] - window_.lo[0]); }
  [[nodiscard]] double height() const { return scale_ * (window_.hi[1] - window_.lo[1]); }

  // In units of the picture.
  [[nodiscard]] double distance(const Point<2>& a, const Point<2>& b) const {
    const double x = (a[0] - b[0]) * scale_, y = (a[1] - b[1]) * scale_;
    return std::sqrt(x * x + y * y);
  }

  void point(const Point<2>& p) {
    number((p[0] - window_.lo[0]) * scale_);
    file_ << ' ';
    number((window_.hi[1] - p[1]) * scale_);
  }
  // Three decimals, without what the value does not need. Far outside the view they are capped.
  void number(double value) {
    constexpr double kFar = 1e9;
    char digits[32];  // '-', 10 digits, '.', 3 digits
    const double rounded = std::round(std::clamp(value, -kFar, kFar) * 1000) / 1000 + 0.0;
    const auto end =
        std::to_chars(digits, digits + sizeof digits, rounded, std::chars_format::fixed).ptr;
    file_ << std::string_view(digits, end - digits);
  }

 private:
  Box<2> window_;
  double scale_;
  TextFile& file_;
};

// Lines or dots by the binary exponent of a length in the picture.
template <class T>
using ByLength = std::map<int, std::vector<T>>;

int length_class(double length) {
  return length > 0 ? std::clamp(std::ilogb(length), kShortest, kLongest) : kShortest;
}

void fill_triangles(const std::vector<std::array<Point<2>, 3>>& triangles, const char* colour,
                    Canvas& canvas, TextFile& file) {
  if (triangles.empty()) return;
  file << "<path fill=\"" << colour << "\" d=\"";
  for (const auto& [a, b, c] : triangles) {
    file << 'M';
    canvas.point(a);
    file << 'L';
    canvas.point(b);
    file << 'L';
    canvas.point(c);
    file << "Z\n";
  }
  file << "\"/>\n";
}

void draw_regions(const Mesh<2>& mesh, const std::vector<double>& regions, Canvas& canvas,
                  TextFile& file) {
  std::map<double, std::vector<std::array<Point<2>, 3>>> shown;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const auto& [a, b, c] = mesh.simplices[i];
    const Point<2>&p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
    auto& triangles = shown[regions[i]];
    if (canvas.shows(p, q, r)) triangles.push_back({p, q, r});
  }
  std::size_t colour = 0;
  for (const auto& [region, triangles] : shown) {
    fill_triangles(triangles, kRegionColours[colour++ % std::size(kRegionColours)], canvas, file);
  }
}

void begin_path(double width, const char* style, Canvas& canvas, TextFile& file) {
  file << "<path fill=\"none\" " << style << " stroke-width=\"";
  canvas.number(width);
  file << "\" d=\"";
}

// Edges as wide as width_of(exponent of their length).
template <class WidthOf>
void draw_edges(const Mesh<2>& mesh, const std::vector<Edge>& edges, const char* style,
                WidthOf width_of, Canvas& canvas, TextFile& file) {
  ByLength<Edge> shown;
  for (const auto& [a, b] : edges) {
    const Point<2>&p = mesh.vertices[a], &q = mesh.vertices[b];
    if (canvas.shows(p, q)) shown[length_class(canvas.distance(p, q))].push_back({a, b});
  }
  for (const auto& [exponent, lines] : shown) {
    begin_path(width_of(exponent), style, canvas, file);
    for (const auto& [a, b] : lines) {
      file << 'M';
      canvas.point(mesh.vertices[a]);
      file << 'L';
      canvas.point(mesh.vertices[b]);
      file << '\n';
    }
    file << "\"/>\n";
  }
}

void draw_input(const Mesh<2>& mesh, const std::vector<Edge>& edges, Canvas& canvas,
                TextFile& file) {
  std::vector<double> shortest(mesh.vertices.size(), kLongerSide);
  for (const auto& [a, b] : edges) {
    const double length = canvas.distance(mesh.vertices[a], mesh.vertices[b]);
    shortest[a] = std::min(shortest[a], length);
    shortest[b] = std::min(shortest[b], length);
  }
  ByLength<Point<2>> shown;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Point<2>& p = mesh.vertices[i];
    if (mesh.kinds[i] != VertexKind::input || !canvas.shows(p, p)) continue;
    shown[length_class(shortest[i])].push_back(p);
  }
  for (const auto& [exponent, dots] : shown) {
    begin_path(std::ldexp(kDotShare, exponent), "stroke=\"#c0392b\" stroke-linecap=\"round\"",
               canvas, file);
    for (const Point<2>& p : dots) {
      file << 'M';
      canvas.point(p);
      file << "h0\n";
    }
    file << "\"/>\n";
  }
}

}  // namespace

SvgView svg_view(const Mesh<2>& mesh) {
  const auto inputs = std::count(mesh.kinds.begin(), mesh.kinds.end(), VertexKind::input);
  std::vector<Point<2>> shown;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (inputs < 2 || mesh.kinds[i] == VertexKind::input) shown.push_back(mesh.vertices[i]);
  }
  if (shown.empty()) return {{{0, 0}, {1, 1}}, {}};
  Box<2> box = detail::bounding_box<2>(shown);
  const double margin = longer_side(box) > 0 ? longer_side(box) / 8 : 1;
  for (int i = 0; i < 2; ++i) {
    box.lo[i] -= margin;
    box.hi[i] += margin;
  }
  return {box, {}};
}

void write_svg(const Mesh<2>& mesh, const SvgView& view, TextFile& file) {
  write_svg(mesh, MeshFeatures(), view, file);
}

void write_svg(const Mesh<2>& mesh, const MeshFeatures& features, const SvgView& view,
               TextFile& file) {
  Canvas canvas(view.window, file);
  file << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 ";
  canvas.number(canvas.width());
  file << ' ';
  canvas.number(canvas.height());
  file << "\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  draw_regions(mesh, features.regions, canvas, file);
  fill_triangles(view.coloured, "#ffb347", canvas, file);
  const auto all = edges(mesh);
  const auto width = [](int exponent) { return std::ldexp(kLineShare, exponent); };
  const auto width_on_line = [](int exponent) {
    return std::max(std::ldexp(kThick * kLineShare, exponent), kLeastOnLine);
  };
  draw_edges(mesh, all, "stroke=\"#3b5b7c\"", width, canvas, file);
  std::vector<Edge> on_lines;
  for (const MeshEdge& e : features.edges) on_lines.push_back({e.low, e.high});
  draw_edges(mesh, on_lines, "stroke=\"#14283c\" stroke-linecap=\"round\"", width_on_line, canvas,
             file);
  draw_input(mesh, all, canvas, file);
  file << "</svg>\n";
}

}  // namespace mesher
