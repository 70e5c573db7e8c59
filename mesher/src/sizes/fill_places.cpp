// Cells of about as many vertices of lattices each.
#include "sizes/fill_places.hpp"

#include <algorithm>
#include <cstdint>
#include <queue>

#include "geometry/box.hpp"
#include "sac/label.hpp"

namespace mesher::detail {

namespace {

constexpr std::size_t kCells = 4096;
constexpr double kMostPlaces = 1 << 18;

// How many vertices the finest lattice in it would have there.
template <int D>
double fill_of(const Limits<D>& limits, const Box<D>& area) {
  const double pitch = limits.pitches_in(area).least;
  if (pitch == Limits<D>::kNone) return 0;
  double fill = D == 2 ? 1 / (2 * Lattice<D>::kMeasure) : 1 / (6 * Lattice<D>::kMeasure);
  for (std::size_t i = 0; i < D; ++i) fill *= (area.hi[i] - area.lo[i]) / pitch;
  return fill;
}

template <int D>
struct FillCell {
  Cell<D> cell;
  Box<D> area;  // in the domain
  double fill;
  friend bool operator<(const FillCell& a, const FillCell& b) noexcept {
    return a.fill != b.fill ? a.fill < b.fill : a.cell.corner < b.cell.corner;
  }
};

// The fullest are halved first.
template <int D>
std::vector<FillCell<D>> fill_cells(const Limits<D>& limits, const MeshBox<D>& box,
                                    const Box<D>& domain) {
  std::priority_queue<FillCell<D>> open;
  std::vector<FillCell<D>> done;
  const auto add = [&](const Cell<D>& cell) {
    const Box<D> area = common(box.box_of(cell), domain);
    if (is_empty(area)) return;
    const FillCell<D> one{cell, area, fill_of(limits, area)};
    if (one.fill > 0) open.push(one);
  };
  add(Cell<D>());
  while (!open.empty() && open.size() < kCells && open.top().fill > 1) {
    const Cell<D> cell = open.top().cell;
    open.pop();
    MeshBox<D>::for_each_child(cell, add);
  }
  for (; !open.empty(); open.pop()) done.push_back(open.top());
  return done;
}

}  // namespace

template <int D>
std::vector<Point<D>> places_of_work(std::vector<std::type_identity_t<Point<D>>> points,
                                     const Limits<D>& limits, const MeshBox<D>& box,
                                     const std::type_identity_t<Box<D>>& domain) {
  if (!limits.any()) return points;
  const std::vector<FillCell<D>> cells = fill_cells(limits, box, domain);
  double work = static_cast<double>(points.size());
  for (const auto& c : cells) work += kWorkOfFill * c.fill;
  const double part = std::min(1.0, kMostPlaces / work);
  std::vector<Point<D>> places;
  double due = 0;
  const auto add = [&](double much, auto&& place) {
    for (due += part * much; due >= 1; --due) places.push_back(place());
  };
  for (const Point<D>& p : points) add(1, [&] { return p; });
  std::uint64_t drawn = 0;
  for (const auto& c : cells) {
    add(kWorkOfFill * c.fill, [&] {
      Point<D> p;
      for (std::size_t i = 0; i < D; ++i) {
        p[i] = c.area.lo[i] + 0x1p-53 * static_cast<double>(sac::mix(++drawn) >> 11) *
                                  (c.area.hi[i] - c.area.lo[i]);
      }
      return p;
    });
  }
  return places;
}

template std::vector<Point<2>> places_of_work<2>(std::vector<Point<2>>, const Limits<2>&,
                                                 const MeshBox<2>&, const Box<2>&);
#ifndef MESHER_PLANE_ONLY
template std::vector<Point<3>> places_of_work<3>(std::vector<Point<3>>, const Limits<3>&,
                                                 const MeshBox<3>&, const Box<3>&);
#endif

}  // namespace mesher::detail
