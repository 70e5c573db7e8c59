// Errors of input points say the id and the coordinates.
#include "input.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "io/text.hpp"

namespace mesher::detail {

namespace {

std::string named(const Point<2>& p, FeatureId id) {
  return "point " + std::to_string(static_cast<std::int64_t>(id)) + " " + place_text(p);
}

}  // namespace

std::string place_text(const Point<2>& p) {
  std::string text = "(";
  return text.append(text::to_text(p[0])).append(", ").append(text::to_text(p[1])).append(")");
}

void check_point(const Point<2>& p, const Box<2>& domain, FeatureId id) {
  for (int i = 0; i < 2; ++i) {
    if (std::isfinite(p[i])) continue;
    throw Error(ErrorCode::not_finite, named(p, id) + " is not finite", {}, {id});
  }
  for (int i = 0; i < 2; ++i) {
    if (text::is_coordinate(p[i])) continue;
    throw Error(ErrorCode::magnitude,
                named(p, id) + ": a coordinate must be 0 or of magnitude 2^-100 to 2^100", {},
                {id});
  }
  for (int i = 0; i < 2; ++i) {
    if (p[i] >= domain.lo[i] && p[i] <= domain.hi[i]) continue;
    throw Error(ErrorCode::outside_domain,
                named(p, id) + " lies outside the domain [" + text::to_text(domain.lo[0]) + ", " +
                    text::to_text(domain.hi[0]) + "] x [" + text::to_text(domain.lo[1]) + ", " +
                    text::to_text(domain.hi[1]) + "]",
                {}, {id});
  }
}

void fail_too_near(const Point<2>& p, FeatureId id, const Point<2>& other, FeatureId other_id) {
  if (p == other) {
    throw Error(ErrorCode::duplicate_point,
                named(p, id) + " lies on point " +
                    std::to_string(static_cast<std::int64_t>(other_id)),
                {}, {id, other_id});
  }
  throw Error(ErrorCode::too_close,
              named(p, id) + " is too close to " + named(other, other_id) +
                  ": they share a cell of 2^-50 of the meshing box's side",
              {}, {id, other_id});
}

std::vector<std::size_t> morton_order(const std::vector<Point<2>>& points, const MeshBox<2>& box) {
  std::vector<std::uint64_t> code(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool finite = std::isfinite(points[i][0]) && std::isfinite(points[i][1]);
    code[i] = finite ? morton<2>(box.fixed(points[i])) : 0;
  }
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return code[a] != code[b] ? code[a] < code[b] : a < b;
  });
  return order;
}

}  // namespace mesher::detail
