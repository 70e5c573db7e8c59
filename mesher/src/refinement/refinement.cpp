// The main loop, Split and Insert.
#include "refinement/refinement.hpp"

#include <algorithm>
#include <utility>

#include "delaunay/build.hpp"
#include "delaunay/spatial_order.hpp"
#include "refinement/ball_location.hpp"
#include "refinement/shell_lists.hpp"
#include "refinement/simplex_location.hpp"

namespace mesher::detail {

namespace {

// What is poor on the way, in units of rho [rules D9].
constexpr double kMeanwhile = 1.25;
// What has yielded is at least so far from vertices, in units of the distance before.
constexpr double kYieldedApart = 0.25;

}  // namespace

template <int D, class Mesh, class Location>
Refinement<D, Mesh, Location>::Refinement(const MeshBox<D>& box, std::span<const Point<D>> points,
                                          const Settings& settings)
    : Base(box, settings, points.size()),
      k_(settings.k),
      skinny2_(points.empty() ? rho2_ : kMeanwhile * kMeanwhile * rho2_),
      location_(points) {}

/// [Fig 2.5].
template <int D, class Mesh, class Location>
void Refinement<D, Mesh, Location>::run() {
  start();
  const auto is_crowded = [&](std::uint32_t v) { return location_.is_crowded(v); };
  for (std::size_t steps = 1;; ++steps) {
    this->watch(steps, kernel_.places());
    if (!conforms()) continue;
    if (const std::uint32_t s = queue_.take_skinny(); s != kNone) {
      split(s);
    } else if (const std::uint32_t v = queue_.crowded(is_crowded); v != kNone) {
      split_crowded(v);
    } else {
      skinny2_ = rho2_;  // no point is left
      const std::uint32_t moderate = queue_.take_moderate();
      if (moderate != kNone) {
        split(moderate);
      } else if (const std::uint32_t large = this->take_large(); large != kNone) {
        split_large(large);
      } else if (const auto sliver = this->dig_sliver()) {
        location_.add_vertex();
        insert_dug(*sliver, {});
      } else if (!this->looks_again()) {
        break;
      }
    }
  }
  if constexpr (kConforms) this->finish();
}

/// Once all points are vertices: else a vertex is inserted that is needed for it, or will be.
template <int D, class Mesh, class Location>
bool Refinement<D, Mesh, Location>::conforms() {
  if constexpr (kConforms) {
    if (location_.left() != 0) return true;
    if (!std::exchange(has_started_, true)) this->conformity_.start();
    if (const auto wanted = this->conformity_.next()) {
      if (const auto v = this->dig(*wanted)) {
        location_.add_vertex();
        insert_dug(*v, {});
      }
      return false;
    }
  }
  return true;
}

// --- Initialize [Fig 2.6] --------------------------------------------------------------------

template <int D, class Mesh, class Location>
void Refinement<D, Mesh, Location>::start() {
  add_box();
  if (location_.left() != 0) add_first_point();
  queue_.make_room(kernel_.simplices().places());
  this->look_at_all([&](std::uint32_t s, const Shape& shape) { look_at(s, shape); });
}

template <int D, class Mesh, class Location>
void Refinement<D, Mesh, Location>::add_box() {
  const std::vector<Point<D>> places = this->boundary();
  std::vector<std::uint32_t> vertices;
  for (const std::uint32_t i : spatial_order<D>(places)) {
    add_place(places[i], VertexKind::boundary);
    vertices.push_back(static_cast<std::uint32_t>(kernel_.places()));
  }
  build<D>(kernel_, vertices, [](std::uint32_t, std::uint32_t) {});
}

/// The nearest to the middle of the box.
template <int D, class Mesh, class Location>
std::uint32_t Refinement<D, Mesh, Location>::first_point() const {
  Point<D> middle;
  for (int i = 0; i < D; ++i) middle[i] = box_.lo[i] + box_.side / 2;
  std::uint32_t best = 0;
  for (std::uint32_t k = 1; k < location_.left(); ++k) {
    if (squared_distance(location_.place(k), middle) <
        squared_distance(location_.place(best), middle)) {
      best = k;
    }
  }
  return best;
}

template <int D, class Mesh, class Location>
void Refinement<D, Mesh, Location>::add_first_point() {
  const std::uint32_t first = first_point();
  add_place(location_.place(first), VertexKind::input, first);
  const auto v = static_cast<std::uint32_t>(kernel_.places());
  kernel_.insert(v);
  location_.start(kernel_, v, first, [&](std::uint32_t w) { queue_.add_crowded(w); });
}

template <int D, class Mesh, class Location>
void Refinement<D, Mesh, Location>::look_at(std::uint32_t s, const Shape& shape) {
  this->look_for_others(s);
  if (!this->is_poor(shape)) return;
  const bool skinny = shape.radius2 > skinny2_ * shape.shortest2;
  queue_.add(s, skinny ? WorkQueue::Wait::skinny : WorkQueue::Wait::moderately_skinny);
}

// --- Split [Fig 2.7] -------------------------------------------------------------------------

template <int D, class Mesh, class Location>
void Refinement<D, Mesh, Location>::split(std::uint32_t s) {
  if (this->is_below_floor(s)) return;
  if constexpr (kConforms) {
    if (has_started_ && !this->is_split(s)) return;
  }
  split_at_centre(s);
}

template <int D, class Mesh, class Location>
void Refinement<D, Mesh, Location>::split_large(std::uint32_t s) {
  if (const auto v = this->dig_on_lattice(s)) {
    location_.add_vertex();
    return insert_dug(*v, {});
  }
  split_at_centre(s);
}

template <int D, class Mesh, class Location>
void Refinement<D, Mesh, Location>::split_at_centre(std::uint32_t s) {
  const Centre<D> centre = this->centre_of(s);
  const bool warps = location_.left() != 0 && !centre.on_side;
  if (warps) {
    const Found found =
        location_.find_early(kernel_, s, centre.place, k_ * centre.radius, takes(s));
    if (found.point != kNone) {
      ++stats_.warped;
      return insert_point(found, s);
    }
  }
  centres_.require_apart(kernel_, s, centre);
  const std::uint32_t v =
      add_place(centre.place, centre.on_side ? VertexKind::boundary : VertexKind::steiner);
  kernel_.dig(v, s);
  const Found found =
      warps ? location_.find_late(kernel_, s, centre.place, k_ * centre.radius, takes(s)) : Found{};
  if (found.point != kNone) {
    ++stats_.warped;
    kernel_.undo_dig();
    kernel_.set_place(v, location_.place(found.point));
    set_point(v, found.point);
    kernel_.dig(v, s);
  } else if constexpr (kConforms) {
    if (!dig_yielding(v, centre, s)) return;
  }
  on_sides_ += centre.on_side ? 1 : 0;
  insert_dug(v, found);
}

/// v is dug at the centre; it stays there, or goes onto a feature, or is undone.
template <int D, class Mesh, class Location>
bool Refinement<D, Mesh, Location>::dig_yielding(std::uint32_t v, const Centre<D>& centre,
                                                 std::uint32_t s) {
  if constexpr (kConforms) {
    if (centre.on_side) return true;
    if (has_started_) {
      if (!this->conformity_.yields(v)) return true;
      undo_place();
      look_at(s, kernel_.measure(s));
      return false;
    }
    const auto y = this->conformity_.yield(centre.place, centre.radius);
    if (!y || !kernel_.conflicts(s, y->p)) return true;
    kernel_.undo_dig();
    kernel_.set_place(v, y->p);
    kernel_.dig(v, s);
    bool apart = true;
    const double least = kYieldedApart * centre.radius;
    kernel_.for_each_in_link([&](std::uint32_t w) {
      if (w != kInfinite && squared_distance(kernel_.place(w), y->p) < least * least) apart = false;
    });
    if (apart) {
      kinds_[v] = VertexKind::segment;
      this->conformity_.set_vertex(v, y->role, 0);
      return true;
    }
    kernel_.undo_dig();
    kernel_.set_place(v, centre.place);
    kernel_.dig(v, s);
  }
  return true;
}

/// Around a Steiner vertex any point can go in: none is near, or it would be there in its place.
template <int D, class Mesh, class Location>
void Refinement<D, Mesh, Location>::split_crowded(std::uint32_t v) {
  const bool is_input = kinds_[v] == VertexKind::input;
  const Found found = is_input ? location_.farthest(kernel_, v) : location_.any(kernel_, v);
  const Point<D> p = location_.place(found.point);
  const auto conflicts = [&](std::uint32_t s) { return kernel_.conflicts(s, p); };
  const auto is_deep = [&](std::uint32_t s) { return is_deep_in(s, p, v); };
  const std::uint32_t s = is_input ? kernel_.find_in_star(v, star_, is_deep)
                                   : kernel_.find_in_star(v, star_, conflicts);
  if (s != kNone) {
    ++stats_.crowded;
    insert_point(found, s);
  } else if (is_input && std::any_of(star_.begin(), star_.end(), conflicts)) {
    split(largest_in_star(v));
  } else {
    insert_lost(found);
  }
}

/// The simplex of v's star, in star_, with the largest ball.
template <int D, class Mesh, class Location>
std::uint32_t Refinement<D, Mesh, Location>::largest_in_star(std::uint32_t v) const {
  std::uint32_t largest = kNone;
  double radius2 = 0;
  for (const std::uint32_t s : star_) {
    const double r2 = squared_distance(kernel_.simplices().ball(s).centre, kernel_.place(v));
    if (r2 > radius2) largest = s, radius2 = r2;
  }
  return largest;
}

/// Whether p is in B(c, k r) of a simplex with corner v.
template <int D, class Mesh, class Location>
bool Refinement<D, Mesh, Location>::is_deep_in(std::uint32_t s, const Point<D>& p,
                                               std::uint32_t v) const {
  const Point<D>& c = kernel_.simplices().ball(s).centre;
  const double r2 = squared_distance(c, kernel_.place(v));
  return squared_distance(c, p) < k_ * k_ * r2;
}

/// Asks of a point whether its insertion takes s out.
template <int D, class Mesh, class Location>
auto Refinement<D, Mesh, Location>::takes(std::uint32_t s) const {
  return [this, s](std::uint32_t point) { return kernel_.conflicts(s, location_.place(point)); };
}

// --- Insert [Fig 2.8] ------------------------------------------------------------------------

template <int D, class Mesh, class Location>
std::uint32_t Refinement<D, Mesh, Location>::add_place(const Point<D>& p, VertexKind kind,
                                                       std::uint32_t point) {
  location_.add_vertex();
  if constexpr (kConforms) {
    return Base::add_place({p, {}}, kind, point == kNone ? 0 : this->handles_[point]);
  } else {
    return Base::add_place(p, kind);
  }
}

/// v is this point of the input.
template <int D, class Mesh, class Location>
void Refinement<D, Mesh, Location>::set_point(std::uint32_t v, std::uint32_t point) {
  kinds_[v] = VertexKind::input;
  if constexpr (kConforms) this->conformity_.set_vertex(v, {}, this->handles_[point]);
}

/// Requires: dug.
template <int D, class Mesh, class Location>
void Refinement<D, Mesh, Location>::undo_place() {
  if constexpr (kConforms) Base::undo_place();
  location_.drop_vertex();
}

/// Requires: it takes s out.
template <int D, class Mesh, class Location>
void Refinement<D, Mesh, Location>::insert_point(const Found& found, std::uint32_t s) {
  const std::uint32_t v = add_place(location_.place(found.point), VertexKind::input, found.point);
  kernel_.dig(v, s);
  insert_dug(v, found);
}

/// A point that is not in its owner's cell, but for rounding. It may be where a vertex is.
template <int D, class Mesh, class Location>
void Refinement<D, Mesh, Location>::insert_lost(const Found& found) {
  const Point<D>& p = location_.place(found.point);
  const std::uint32_t s = kernel_.walk(p, star_.front());
  for (const std::uint32_t w : kernel_.simplices().corners(s)) {
    if (kernel_.place(w) != p) continue;
    set_point(w, found.point);
    return location_.drop(kernel_, found);
  }
  insert_point(found, s);
}

/// `found`: the point that v is, if it is one.
template <int D, class Mesh, class Location>
void Refinement<D, Mesh, Location>::insert_dug(std::uint32_t v, const Found& found) {
  for (const std::uint32_t s : kernel_.doomed()) queue_.forget(s);
  if constexpr (kConforms) {
    if (has_started_) this->conformity_.before_fill(v);
  }
  Base::before_fill(v);
  const bool moves = location_.left() != 0;
  if (moves) {
    const std::uint32_t is_point = location_.take(kernel_, v);
    if (is_point != kNone) {
      set_point(v, is_point);
    } else if (found.point != kNone) {
      location_.drop(kernel_, found);
    }
  }
  kernel_.fill(v);
  if (moves) location_.give(kernel_, v, [&](std::uint32_t w) { queue_.add_crowded(w); });
  queue_.make_room(kernel_.simplices().places());
  const auto& made = kernel_.made();
  for (std::size_t k = 0; k < made.size(); ++k) look_at(made[k], kernel_.shape_made(k));
  Base::after_fill();
  if constexpr (kConforms) {
    if (has_started_) this->conformity_.after_fill(v);
  }
}

template <int D, class Mesh, class Location>
SvrStats Refinement<D, Mesh, Location>::stats() const {
  SvrStats stats = stats_;
  this->set_figures(stats);
  const LookedAt& looked_at = location_.looked_at();
  stats.looked_at_to_find = looked_at.to_find;
  stats.looked_at_to_move = looked_at.to_move;
  return stats;
}

template class Refinement<2, RefinedMesh<2>>;
template class Refinement<2, RefinedMesh<2>, VoronoiLocation<2, ShellLists<2>>>;
template class Refinement<2, RefinedMesh<2>, SimplexLocation<2>>;
template class Refinement<2, RefinedMesh<2>, BallLocation<2>>;
template class Refinement<2, ConformingMesh<2>>;
#ifndef MESHER_PLANE_ONLY
template class Refinement<3, RefinedMesh<3>>;
template class Refinement<3, RefinedMesh<3>, VoronoiLocation<3, ShellLists<3>>>;
template class Refinement<3, RefinedMesh<3>, SimplexLocation<3>>;
template class Refinement<3, RefinedMesh<3>, BallLocation<3>>;
template class Refinement<3, ConformingMesh<3>>;
#endif

}  // namespace mesher::detail
