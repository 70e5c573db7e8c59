// Vertices on features, and what is left alone.
#include "refinement/conforming_mesh.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "space/polygon_shape.hpp"

namespace mesher::detail {

namespace {

// Of the box's side: within this of a wall rounding decides on which side of it a place is, or that
// the wall is not quite flat (space/polygon_shape.hpp).
constexpr double kNearWall = 0x1p-24;

// A mesh with so many vertices, and so many times as many as there are points, is asked whether
// gaps will fill it up; then when it is four times as large.
constexpr std::size_t kMany = std::size_t{1} << 17;
constexpr std::size_t kManyTimes = 8;
constexpr std::size_t kLater = 4;
// Of a mesh in space, a vertex.
constexpr std::size_t kSimplices = 7;

}  // namespace

template <int D>
ConformingMesh<D>::ConformingMesh(const MeshBox<D>& box, const Settings& settings,
                                  std::size_t points)
    : Base(box, settings, points),
      handles_(settings.handles),
      names_(settings.names),
      conformity_(*settings.store, kernel_),
      only_enclosed_(settings.only_enclosed),
      judged_with_(std::max(kMany, kManyTimes * points)),
      holes_(settings.holes),
      regions_(settings.regions) {}

template <int D>
std::uint32_t ConformingMesh<D>::add_place(const Placed& place, VertexKind kind,
                                           VertexHandle point) {
  if (const std::size_t most = this->full_with(); most != 0) {
    if constexpr (D == 2) {
      conformity_.fail_too_many(most);
    } else {
      conformity_.fail_too_many(most, names_);
    }
  }
  const std::uint32_t v = Base::add_place(place.p, kind);
  conformity_.add_vertex(place.role, point);
  return v;
}

template <int D>
void ConformingMesh<D>::undo_place() {
  kernel_.undo_dig();
  drop_place();
}

template <int D>
void ConformingMesh<D>::drop_place() {
  Base::drop_place();
  conformity_.drop_vertex();
}

/// Whether a vertex there is where one is wanted; if there is a choice, but for rounding: it may be
/// computed in another way from the same labels.
template <int D>
bool ConformingMesh<D>::is_taken(const typename Conforms::Wanted& wanted, const Point<D>& there) {
  const Point<D>& p = wanted.place.p;
  if constexpr (D == 3) {
    const double near = resolution(p, 0);
    if (wanted.otherwise) return squared_distance(p, there) <= near * near;
  }
  return there == p;
}

template <int D>
std::optional<std::uint32_t> ConformingMesh<D>::dig(const typename Conforms::Wanted& wanted) {
  const auto any = [](std::uint32_t) { return true; };
  const std::uint32_t from = kernel_.find_in_star(wanted.beside, star_, any);
  const std::uint32_t s = kernel_.walk(wanted.place.p, from);
  for (const std::uint32_t w : kernel_.simplices().corners(s)) {
    if (w == kInfinite || !is_taken(wanted, kernel_.place(w))) continue;
    if (!wanted.otherwise) conformity_.fail_occupied(wanted.place);
    conformity_.take_otherwise();
    return dig({*wanted.otherwise, wanted.beside});
  }
  const std::uint32_t v = add_place(wanted.place, VertexKind::segment);
  kernel_.dig(v, s);
  if (edge_of(wanted.place.role) != 0 || !conformity_.yields_to_edges(v)) return v;
  undo_place();
  return std::nullopt;
}

template <int D>
bool ConformingMesh<D>::is_split(std::uint32_t s) {
  if (D == 3 && kernel_.places() >= judged_with_) judge();
  return !(has_outside() && conformity_.is_outside(s)) && !stays(s);
}

template <int D>
void ConformingMesh<D>::judge() {
  judged_with_ = kLater * kernel_.places();
  if constexpr (D == 3) {
    const std::size_t most = this->most_vertices(Base::Kernel::Store::kMost / kSimplices);
    const bool all = !has_outside();
    const NarrowGaps gaps =
        conformity_.narrow_gaps([&](std::uint32_t s) { return !all && conformity_.is_outside(s); });
    const auto worst = gaps.worst();
    if (!worst || gaps.vertices(this->rho()) <= static_cast<double>(most)) return;
    conformity_.fail_between(*worst, most, names_);
  }
}

template <int D>
std::optional<std::uint32_t> ConformingMesh<D>::dig_sliver() {
  if constexpr (D == 3) {
    return Base::dig_sliver_if(
        [&](std::uint32_t s) { return !(has_outside() && conformity_.is_outside(s)); },
        [&](const Point<D>& p) {
          return add_place({p, {}}, VertexKind::steiner);
        },
        [&] { drop_place(); }, [&] { return !conformity_.is_disturbed(); },
        [&](std::uint32_t s, double least2) -> std::optional<std::uint32_t> {
          if (this->is_poor(kernel_.measure(s))) return std::nullopt;
          if (!conformity_.wants_piece_of(s, least2)) return std::nullopt;
          return dig(*conformity_.next());
        });
  }
  return std::nullopt;
}

template <int D>
void ConformingMesh<D>::finish() {
  if constexpr (D == 3) {
    if (has_outside()) conformity_.put_flat_outside();
  }
}

/// Whether what is outside is not wanted. Requires: as is_split().
template <int D>
bool ConformingMesh<D>::has_outside() {
  if (only_enclosed_) find_regions();
  return only_enclosed_;
}

/// If all of the box is wanted, holes are regions without limits.
template <int D>
void ConformingMesh<D>::find_regions() {
  if (std::exchange(has_regions_, true)) return;
  const double near = kNearWall * this->box_.side;
  if (only_enclosed_ && !conformity_.find_regions(holes_, near)) {
    only_enclosed_ = false;
    this->require_box(kCoarseSteps);
  }
  std::uint32_t name = 0;
  const auto add = [&](const Point<D>& p, double measure, bool outside_too) {
    limits_.push_back(measure);
    conformity_.name_region(p, name++, near, outside_too);
  };
  if (!only_enclosed_) {
    static_cast<void>(conformity_.find_regions({}, near));
    for (const Point<D>& hole : holes_) add(hole, std::numeric_limits<double>::infinity(), false);
  }
  for (const LimitedRegion<D>& r : regions_) add(r.at, r.max_measure, !only_enclosed_);
}

template <int D>
std::optional<double> ConformingMesh<D>::limit_in_region(std::uint32_t s, double measure) {
  if (only_enclosed_ || !regions_.empty()) find_regions();
  if (only_enclosed_ && conformity_.is_outside(s)) return std::nullopt;
  if (regions_.empty()) return measure;
  const std::uint32_t region = conformity_.region(s);
  return region == kNone ? measure : std::min(measure, limits_[region]);
}

template <int D>
std::uint32_t ConformingMesh<D>::take_large() {
  return Base::take_large_if(
      [&](std::uint32_t s, double measure) { return limit_in_region(s, measure); });
}

template <int D>
std::optional<std::uint32_t> ConformingMesh<D>::dig_on_lattice(std::uint32_t s) {
  return Base::dig_on_lattice_if(
      s,
      [&](const Point<D>& p) {
        return add_place({p, {}}, VertexKind::steiner);
      },
      [&] { drop_place(); },
      [&](std::uint32_t v) { return !conformity_.encroaches_on_features(v); });
}

/// Its shortest edge is as short as the angle of features makes it. In the plane the simplex is on
/// the left of that edge.
template <int D>
bool ConformingMesh<D>::stays(std::uint32_t s) const {
  const auto& corners = kernel_.simplices().corners(s);
  std::pair<std::uint32_t, std::uint32_t> shortest;
  double shortest2 = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i <= D; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double length2 = squared_distance(kernel_.place(corners[i]), kernel_.place(corners[k]));
      if (length2 >= shortest2) continue;
      shortest2 = length2;
      shortest = {corners[k], corners[i]};
      if (i - k == 2) std::swap(shortest.first, shortest.second);
    }
  }
  return conformity_.keeps(shortest.first, shortest.second);
}

template class ConformingMesh<2>;
#ifndef MESHER_PLANE_ONLY
template class ConformingMesh<3>;
#endif

}  // namespace mesher::detail
