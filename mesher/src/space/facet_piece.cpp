// Rectangles in a frame.
#include "space/facet_piece.hpp"

#include <algorithm>
#include <cmath>

#include "space/feature_search.hpp"

namespace mesher::detail {

namespace {

// Nearly sqrt(1/2), and short: then coordinates in the frame are sums of few terms, and exact.
constexpr double kAspect = 181.0 / 256;

// A vertex is at least this many longer sides from the edges and points on the polygon. Nearer ones
// would split the edges once more, farther ones leave room that Complete has to fill: measured.
constexpr double kClear = 0.4;

// The longer side of the piece that has all of the polygon: a power of two.
double whole_side(const Polygon& f) {
  const double width = f.bounds.hi[0] - f.bounds.lo[0], height = f.bounds.hi[1] - f.bounds.lo[1];
  int exponent = 0;
  const bool is_power = std::frexp(std::max(width, height / kAspect), &exponent) == 0.5;
  return std::ldexp(1.0, is_power ? exponent - 1 : exponent);
}

bool is_clear(const Polygon& f, const Point<2>& uv, double room, const FeatureStore& store) {
  if (!contains(f, uv)) return false;
  const Point<3> x = f.plane.at(uv);
  const auto is_near = [&](const auto& feature) { return distance2_to(x, feature) < room * room; };
  return !visit_edges_near(f, x, room, [&](EdgeHandle e) { return is_near(store.edges()[e]); }) &&
         !visit_points_near(f, x, room, [&](VertexHandle v) { return is_near(store.points()[v]); });
}

}  // namespace

std::array<double, 2> FacetPiece::sides() const noexcept {
  const double whole = whole_side(*polygon);
  return {std::ldexp(whole, -((level + 1) / 2)), kAspect * std::ldexp(whole, -(level / 2))};
}

double FacetPiece::longer_side() const noexcept { return sides()[is_wide() ? 0 : 1]; }

Point<2> FacetPiece::middle() const noexcept {
  const auto [width, height] = sides();
  const Point<2>& corner = polygon->bounds.lo;
  return {corner[0] + (static_cast<double>(column) + 0.5) * width,
          corner[1] + (static_cast<double>(row) + 0.5) * height};
}

Point<2> FacetPiece::place() const noexcept {
  Point<2> x = middle();
  const double off = longer_side() / 4;
  const bool is_odd = ((is_wide() ? row : column) & 1) != 0;
  x[is_wide() ? 0 : 1] += is_odd ? off : -off;
  return x;
}

std::array<FacetPiece, 2> FacetPiece::halves() const noexcept {
  std::array<FacetPiece, 2> halves{*this, *this};
  for (FacetPiece& half : halves) {
    ++half.level;
    (is_wide() ? half.column : half.row) *= 2;
  }
  ++(is_wide() ? halves[1].column : halves[1].row);
  return halves;
}

bool FacetPiece::meets_polygon() const {
  const auto [width, height] = sides();
  return is_within(polygon->plane.at(middle()), *polygon, (width * width + height * height) / 4);
}

std::ostream& operator<<(std::ostream& out, const FacetPiece& p) {
  const char* separator = "(";
  for (const double x : p.polygon->plane.at(p.middle())) out << separator << x, separator = " ";
  const auto [width, height] = p.sides();
  return out << ") " << width << " x " << height;
}

void label_bytes(sac::LabelSink& sink, const FacetPiece& p) {
  for (const auto* places : {&p.polygon->places, &p.polygon->inside}) {
    for (const Point<3>& at : *places) {
      for (const double x : at) sink.number(std::bit_cast<std::uint64_t>(x));
    }
  }
  for (const std::uint32_t end : p.polygon->loop_end) sink.number(end);
  for (const std::int64_t x : {std::int64_t{p.level}, p.row, p.column}) {
    sink.number(static_cast<std::uint64_t>(x));
  }
}

std::optional<Point<3>> vertex_place(const FacetPiece& piece, const FeatureStore& store) {
  const Polygon& f = *piece.polygon;
  const double room = kClear * piece.longer_side();
  for (const Point<2>& uv : {piece.place(), piece.middle()}) {
    if (is_clear(f, uv, room, store)) return f.plane.at(uv);
  }
  return std::nullopt;
}

}  // namespace mesher::detail
