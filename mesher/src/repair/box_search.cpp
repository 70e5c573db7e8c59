// Boxes and their halves.
#include "repair/box_search.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/box.hpp"
#include "repair/crossing_place.hpp"

namespace mesher::detail {

BoxSearch::Content BoxSearch::all(bool with_spots) const {
  Content c;
  const auto& places = drawing_.places();
  c.box = bounding_box<2>(places);
  for (std::uint32_t r = 0; r < drawing_.rods().size(); ++r) {
    if (drawing_.rods()[r].whole()) c.rods.push_back({r, 0, 1});
  }
  if (!with_spots) return c;
  for (Spot s = 0; s < places.size(); ++s) c.spots.push_back(s);
  return c;
}

// Leaves of a part what is at most (sign 1) or at least (sign -1) at `bound`; false if nothing is.
// `axis_a`, `along`: of the rod, on the axis of the bound.
bool BoxSearch::clip(Part& part, double axis_a, double along, double bound, int sign) const {
  if (std::abs(along) <= slack_) {
    const double end = axis_a + along;
    return sign > 0 ? std::min(axis_a, end) <= bound : std::max(axis_a, end) >= bound;
  }
  const double at = (bound - axis_a) / along;
  if (sign * along > 0) {
    part.hi = std::min(part.hi, at);
  } else {
    part.lo = std::max(part.lo, at);
  }
  return part.lo <= part.hi;
}

// Rods that come within `slack` of a half; that covers the rounding of what is clipped.
std::array<BoxSearch::Content, 2> BoxSearch::halves(const Content& c) const {
  const int axis = c.longer_axis();
  const double middle = c.box.lo[axis] + (c.box.hi[axis] - c.box.lo[axis]) / 2;
  std::array<Content, 2> half{Content{c.box, {}, {}}, Content{c.box, {}, {}}};
  half[0].box.hi[axis] = half[1].box.lo[axis] = middle;
  for (const Spot s : c.spots) half[drawing_.place(s)[axis] < middle ? 0 : 1].spots.push_back(s);
  for (const Part& part : c.rods) {
    const Rod& r = drawing_.rods()[part.rod];
    const double a = drawing_.place(r.a)[axis], along = drawing_.place(r.b)[axis] - a;
    for (const int sign : {1, -1}) {
      Part there = part;
      if (!clip(there, a, along, middle + sign * slack_, sign)) continue;
      half[sign > 0 ? 0 : 1].rods.push_back(there);
    }
  }
  return half;
}

bool BoxSearch::has_new_rod(const Content& c, const News& news) const {
  return std::any_of(c.rods.begin(), c.rods.end(),
                     [&](const Part& part) { return part.rod >= news.rod; });
}

bool BoxSearch::has_new(const Content& c, const News& news) const {
  return has_new_rod(c, news) ||
         std::any_of(c.spots.begin(), c.spots.end(), [&](Spot s) { return s >= news.spot; });
}

bool BoxSearch::may_be_cable(const Content& c) const {
  std::size_t through = 0;
  for (const Part& part : c.rods) {
    const Rod& r = drawing_.rods()[part.rod];
    const Point<2>&a = drawing_.place(r.a), &b = drawing_.place(r.b);
    const double length = std::max(std::abs(b[0] - a[0]), std::abs(b[1] - a[1]));
    through += (part.hi - part.lo) * length >= c.side() / 2;
  }
  return 2 * through >= c.rods.size();
}

// The margin covers rounding, and is less than what is between wires that do not cross.
std::vector<BoxSearch::Breadth> BoxSearch::cable(const Content& c) const {
  if (!may_be_cable(c)) return {};
  const auto place = [&](const Rod& r, double t) {
    const Point<2>&a = drawing_.place(r.a), &b = drawing_.place(r.b);
    return Point<2>{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
  };
  const Rod& one = drawing_.rods()[c.rods[c.rods.size() / 2].rod];
  const Point<2>&a = drawing_.place(one.a), &b = drawing_.place(one.b);
  const double x = b[0] - a[0], y = b[1] - a[1], length = std::sqrt(x * x + y * y);
  const auto across = [&](const Point<2>& p) {
    return (x * (p[1] - a[1]) - y * (p[0] - a[0])) / length;
  };
  const double margin = drawing_.tolerance() / 8;
  std::vector<Breadth> wires;
  for (const Part& part : c.rods) {
    const Rod& r = drawing_.rods()[part.rod];
    const auto [lo, hi] = std::minmax({across(place(r, part.lo)), across(place(r, part.hi))});
    wires.push_back({lo - margin, hi + margin, part.rod});
  }
  std::sort(wires.begin(), wires.end(), [](const Breadth& u, const Breadth& w) {
    return u.lo != w.lo ? u.lo < w.lo : u.rod < w.rod;
  });
  std::size_t beside = 0;
  for (std::size_t i = 0; i < wires.size(); ++i) {
    const auto end = std::upper_bound(wires.begin(), wires.end(), wires[i].hi,
                                      [](double hi, const Breadth& w) { return hi < w.lo; });
    beside += static_cast<std::size_t>(end - wires.begin()) - i;
  }
  return beside <= kFewBeside * wires.size() ? wires : std::vector<Breadth>{};
}

std::size_t BoxSearch::gather_spokes(std::vector<Part>& rods) const {
  std::size_t most = 0;
  Spot hub = 0;
  for (const std::size_t i : {std::size_t{0}, rods.size() / 2, rods.size() - 1}) {
    const Rod& sample = drawing_.rods()[rods[i].rod];
    for (const Spot s : {sample.a, sample.b}) {
      const auto count =
          static_cast<std::size_t>(std::count_if(rods.begin(), rods.end(), [&](const Part& part) {
            return drawing_.rods()[part.rod].has(s);
          }));
      if (count > most) most = count, hub = s;
    }
  }
  std::stable_partition(rods.begin(), rods.end(),
                        [&](const Part& part) { return drawing_.rods()[part.rod].has(hub); });
  return most;
}

// The square of the sine of their angle.
double BoxSearch::sine2(std::uint32_t r, std::uint32_t t) const {
  const auto along = [&](std::uint32_t rod) {
    const Point<2>& a = drawing_.place(drawing_.rods()[rod].a);
    const Point<2>& b = drawing_.place(drawing_.rods()[rod].b);
    return Point<2>{b[0] - a[0], b[1] - a[1]};
  };
  const Point<2> u = along(r), w = along(t);
  const double cross = u[0] * w[1] - u[1] * w[0];
  return cross * cross / ((u[0] * u[0] + u[1] * u[1]) * (w[0] * w[0] + w[1] * w[1]));
}

// Of the knot's two rods, the one at the larger angle.
std::uint32_t BoxSearch::partner(const Knot& knot, std::uint32_t rod) const {
  return knot.rods[sine2(knot.rods[0], rod) >= sine2(knot.rods[1], rod) ? 0 : 1];
}

bool BoxSearch::is_in(const Knot& knot, std::uint32_t rod) const {
  const Rod& r = drawing_.rods()[rod];
  const double most = drawing_.tolerance() / 4;
  return distance2(knot.at, drawing_.place(r.a), drawing_.place(r.b)) <= most * most &&
         drawing_.cross(r, drawing_.rods()[partner(knot, rod)]);
}

// Where a rod crosses some other, if most of some pass there.
std::optional<BoxSearch::Knot> BoxSearch::knot_of(const std::vector<Part>& rods,
                                                  std::uint32_t rod) const {
  constexpr std::size_t kSamples = 8;
  const Rod& r = drawing_.rods()[rod];
  const auto place = [&](Spot s) { return drawing_.place(s); };
  const auto sample = [&](std::size_t i) { return rods[i * (rods.size() - 1) / kSamples].rod; };
  for (std::size_t i = 0; i <= kSamples; i += 2) {
    const Rod& t = drawing_.rods()[sample(i)];
    if (sine2(rod, sample(i)) < 0x1p-16 || !drawing_.cross(r, t)) continue;
    const Knot knot{crossing_place(place(r.a), place(r.b), place(t.a), place(t.b)),
                    {rod, sample(i)}};
    std::size_t count = 0;
    for (std::size_t k = 0; k <= kSamples; ++k) count += is_in(knot, sample(k));
    if (2 * count > kSamples) return knot;
  }
  return std::nullopt;
}

std::optional<BoxSearch::Knot> BoxSearch::find_knot(const std::vector<Part>& rods) const {
  for (const std::size_t i : {rods.size() / 2, rods.size() / 4, 3 * rods.size() / 4}) {
    if (const auto knot = knot_of(rods, rods[i].rod)) return knot;
  }
  return std::nullopt;
}

std::size_t BoxSearch::gather(const Knot& knot, std::vector<Part>& rods) const {
  const auto rest = std::stable_partition(rods.begin(), rods.end(),
                                          [&](const Part& part) { return is_in(knot, part.rod); });
  return static_cast<std::size_t>(rest - rods.begin());
}

}  // namespace mesher::detail
