// Writes pictures of meshes as SVG. Each edge is drawn once, as wide as its length allows, and each
// dot as wide as the shortest edge at it, so that fine parts stay clear when one zooms in. What has
// one width is one path (dots are lines of length 0 with round ends), which keeps files small and
// viewers fast; widths are powers of two, so that there are few.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "io/svg_canvas.hpp"
#include "mesher/write.hpp"

namespace mesher {
namespace {

constexpr double kThick = 2;           // an edge on a line over another edge, in width,
constexpr double kLeastOnLine = 0.75;  // and at least so wide: a line stays in sight

// Of regions, in the order of their attributes; then again from the first.
constexpr const char* kRegionColours[] = {"#dbe9f6", "#fde3cf", "#ddf0dc", "#f6dce6",
                                          "#ebe3f5", "#fdf6cf", "#d9f0ee", "#ece6df"};

using Edge = std::array<std::uint32_t, 2>;

// Lines or dots by the binary exponent of a length in the picture.
template <class T>
using ByLength = std::map<int, std::vector<T>>;

using svg::Canvas;
using svg::length_class;

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
  std::vector<double> shortest(mesh.vertices.size(), svg::kLongerSide);
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
    begin_path(std::ldexp(svg::kDotShare, exponent), "stroke=\"#c0392b\" stroke-linecap=\"round\"",
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

template <int D>
SvgView<D> svg_view(const Mesh<D>& mesh) {
  return {svg::window_of<D>(mesh), {}};
}
template SvgView<2> svg_view(const Mesh<2>&);
#ifndef MESHER_PLANE_ONLY
template SvgView<3> svg_view(const Mesh<3>&);
#endif

void write_svg(const Mesh<2>& mesh, const SvgView<2>& view, TextFile& file) {
  write_svg(mesh, MeshFeatures(), view, file);
}

void write_svg(const Mesh<2>& mesh, const MeshFeatures& features, const SvgView<2>& view,
               TextFile& file) {
  Canvas canvas(view.window, file);
  canvas.begin();
  draw_regions(mesh, features.regions, canvas, file);
  fill_triangles(view.coloured, "#ffb347", canvas, file);
  const auto all = edges(mesh);
  const auto width = [](int exponent) { return std::ldexp(svg::kLineShare, exponent); };
  const auto width_on_line = [](int exponent) {
    return std::max(std::ldexp(kThick * svg::kLineShare, exponent), kLeastOnLine);
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
