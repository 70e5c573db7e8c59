// Who faces a part of a polygon, by samples.
#include "refinement/narrow_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/space_vectors.hpp"
#include "space/feature_search.hpp"
#include "space/polygon_shape.hpp"

namespace mesher::detail {

namespace {

constexpr int kHalvings = 3;  // that a part is halved, where the width of its gap is uneven
constexpr std::size_t kMostAsked = 1 << 17;
// Of the distance to a polygon that faces x, how much is upwards at least.
constexpr double kUpwards = 0.7;
// Widths of one part may differ by so much.
constexpr double kUneven = 3;

using Part = std::array<Point<3>, 3>;

Point<3> middle(const Point<3>& a, const Point<3>& b) { return scaled(0.5, plus(a, b)); }
Point<3> centre_of(const Part& t) { return scaled(1.0 / 3, plus(plus(t[0], t[1]), t[2])); }

}  // namespace

/// The nearest polygon above x, which is on f; no farther than `most`.
auto NarrowGaps::facing(const Polygon& f, const Point<3>& x, const Point<3>& up,
                        double most) noexcept -> std::optional<Facing> {
  ++asked_;
  double within = most;
  std::optional<Facing> found;
  store_.visit_nearest<Polygon>(x, within, [&](const Polygon& g) {
    if (g.self == f.self || !is_within(x, g, within * within)) return;
    const Point<3> there = minus(nearest_place(g, x), x);
    const double distance = std::sqrt(squared(there));
    if (!(distance < within) || dot(there, up) < kUpwards * distance || !disjoint(f, g)) return;
    found = Facing{g.self, distance};
    within = distance;
  });
  return found;
}

void NarrowGaps::add(const Polygon& f, const std::array<Point<3>, 3>& part,
                     const Point<3>& beside) {
  const double side = f.plane.height(beside) < f.plane.height(part[0]) ? -1 : 1;
  add(f, part, scaled(side, f.plane.normal), 0);
}

void NarrowGaps::add(const Polygon& f, const std::array<Point<3>, 3>& part, const Point<3>& up,
                     int level) {
  double longest2 = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    longest2 = std::max(longest2, squared_distance(part[i], part[(i + 1) % 3]));
  }
  const double most = std::sqrt(longest2);  // a gap that is wider takes no more vertices here
  const Point<3> centre = centre_of(part);
  const auto first = facing(f, centre, up, most);
  double least = std::numeric_limits<double>::infinity(), widest = 0;
  const auto note = [&](const std::optional<Facing>& there) {
    const double width = there ? there->distance : std::numeric_limits<double>::infinity();
    least = std::min(least, width), widest = std::max(widest, width);
  };
  note(first);
  constexpr double kInwards = 0.125;  // what f ends at is others', too
  for (const Point<3>& corner : part) {
    note(facing(f, plus(corner, scaled(kInwards, minus(centre, corner))), up, most));
  }
  if (std::isinf(least)) return;
  if (widest > kUneven * least && level < kHalvings && asked_ < kMostAsked) {
    const auto& [a, b, c] = part;
    const Point<3> ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Part& quarter :
         {Part{a, ab, ca}, Part{b, bc, ab}, Part{c, ca, bc}, Part{ab, bc, ca}}) {
      add(f, quarter, up, level + 1);
    }
    return;
  }
  if (std::isinf(widest)) return;
  const Point<3> across = cross(minus(part[1], part[0]), minus(part[2], part[0]));
  const double squares = std::sqrt(squared(across)) / 2 / (widest * widest);
  squares_ += squares;
  Found& found = by_polygon_[f.self];
  found.squares += squares;
  if (squares <= found.most) return;
  found.most = squares;
  found.gap = {f.self, first->other, first->distance, centre};
}

std::optional<NarrowGaps::Gap> NarrowGaps::worst() const {
  const Found* worst = nullptr;
  for (const auto& [f, found] : by_polygon_) {
    if (worst == nullptr || found.squares > worst->squares) worst = &found;
  }
  if (worst == nullptr) return std::nullopt;
  return worst->gap;
}

}  // namespace mesher::detail
