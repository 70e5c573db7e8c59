// Errors of input points say the id and the coordinates.
#include "geometry/input_point.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "sets/counting_sort.hpp"
#include "text/text.hpp"

namespace mesher::detail {

namespace {

template <std::size_t N>
std::string named(const std::array<double, N>& p, PointId id) {
  return "point " + std::to_string(static_cast<std::int64_t>(id)) + " " + place_text(p);
}

template <int D>
std::string box_text(const Box<D>& box) {
  std::string text;
  for (std::size_t i = 0; i < D; ++i) {
    text.append(i == 0 ? "[" : " x [").append(text::to_text(box.lo[i]));
    text.append(", ").append(text::to_text(box.hi[i])).append("]");
  }
  return text;
}

}  // namespace

template <std::size_t N>
std::string place_text(const std::array<double, N>& p) {
  std::string text = "(";
  for (std::size_t i = 0; i < N; ++i) text.append(i == 0 ? "" : ", ").append(text::to_text(p[i]));
  return text.append(")");
}

template <std::size_t N>
void check_coordinates(const std::array<double, N>& p, PointId id) {
  for (const double x : p) {
    if (std::isfinite(x)) continue;
    throw Error(ErrorCode::not_finite, named(p, id) + " is not finite", {}, {mesher::Feature(id)});
  }
  for (const double x : p) {
    if (text::is_coordinate(x)) continue;
    throw Error(ErrorCode::magnitude,
                named(p, id) + ": a coordinate must be 0 or of magnitude 2^-100 to 2^100", {},
                {mesher::Feature(id)}, {position_of(p)});
  }
}

template <std::size_t N>
void check_point(const std::array<double, N>& p, const Box<static_cast<int>(N)>& domain,
                 PointId id) {
  check_coordinates(p, id);
  for (std::size_t i = 0; i < N; ++i) {
    if (p[i] >= domain.lo[i] && p[i] <= domain.hi[i]) continue;
    throw Error(ErrorCode::outside_domain,
                named(p, id) + " lies outside the domain " + box_text(domain), {},
                {mesher::Feature(id)}, {position_of(p)});
  }
}

template <std::size_t N>
void fail_too_near(const std::array<double, N>& p, PointId id, const std::array<double, N>& other,
                   PointId other_id) {
  if (p == other) {
    throw Error(
        ErrorCode::duplicate_point,
        named(p, id) + " lies on point " + std::to_string(static_cast<std::int64_t>(other_id)), {},
        {mesher::Feature(id), mesher::Feature(other_id)}, {position_of(p), position_of(other)});
  }
  throw Error(ErrorCode::too_close,
              named(p, id) + " is too close to " + named(other, other_id) +
                  ": they share a cell of 2^-50 of the meshing box's side",
              {}, {mesher::Feature(id), mesher::Feature(other_id)},
              {position_of(p), position_of(other)});
}

template <std::size_t N>
std::vector<std::size_t> morton_order(const std::vector<std::array<double, N>>& points,
                                      const MeshBox<static_cast<int>(N)>& box) {
  std::vector<std::uint64_t> code(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    bool finite = true;
    for (const double x : points[i]) finite = finite && std::isfinite(x);
    code[i] = finite ? morton<static_cast<int>(N)>(box.fixed(points[i])) : 0;
  }
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  sort_spread(
      order, [&](std::size_t i) { return code[i]; },
      [&](std::size_t a, std::size_t b) { return code[a] != code[b] ? code[a] < code[b] : a < b; });
  return order;
}

template std::string place_text(const Point<2>&);
template void check_coordinates(const Point<2>&, PointId);
template void check_point(const Point<2>&, const Box<2>&, PointId);
template void fail_too_near(const Point<2>&, PointId, const Point<2>&, PointId);
template std::vector<std::size_t> morton_order(const std::vector<Point<2>>&, const MeshBox<2>&);
#ifndef MESHER_PLANE_ONLY
template std::string place_text(const Point<3>&);
template void check_coordinates(const Point<3>&, PointId);
template void check_point(const Point<3>&, const Box<3>&, PointId);
template void fail_too_near(const Point<3>&, PointId, const Point<3>&, PointId);
template std::vector<std::size_t> morton_order(const std::vector<Point<3>>&, const MeshBox<3>&);
template std::string place_text(const Point<4>&);
template void fail_too_near(const Point<4>&, PointId, const Point<4>&, PointId);
#endif

}  // namespace mesher::detail
