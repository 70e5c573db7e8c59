// The main loop, Split and Insert.
#include "svr/refinement.hpp"

#include <algorithm>

#include "delaunay/build.hpp"
#include "delaunay/spatial_order.hpp"

namespace mesher::detail {

namespace {

// What is poor on the way, in units of rho [rules D9].
constexpr double kMeanwhile = 1.25;

}  // namespace

template <int D>
Refinement<D>::Refinement(const MeshBox<D>& box, std::span<const Point<D>> points,
                          const Settings& settings)
    : Base(box, settings, points.size()),
      k_(settings.k),
      skinny2_(points.empty() ? rho2_ : kMeanwhile * kMeanwhile * rho2_),
      lists_(points, box.side) {}

/// [Fig 2.5].
template <int D>
void Refinement<D>::run() {
  start();
  const auto is_crowded = [&](std::uint32_t v) { return lists_.is_crowded(v); };
  for (std::size_t steps = 1;; ++steps) {
    this->watch(steps, kernel_.places());
    if (const std::uint32_t s = queue_.take_skinny(); s != kNone) {
      split(s);
    } else if (const std::uint32_t v = queue_.crowded(is_crowded); v != kNone) {
      split_crowded(v);
    } else {
      skinny2_ = rho2_;  // no point is left
      const std::uint32_t moderate = queue_.take_moderate();
      if (moderate == kNone) break;
      split(moderate);
    }
  }
}

// --- Initialize [Fig 2.6] --------------------------------------------------------------------

template <int D>
void Refinement<D>::start() {
  add_box();
  if (lists_.left() != 0) add_first_point();
  queue_.make_room(kernel_.simplices().places());
  this->look_at_all([&](std::uint32_t s) { look_at(s, kernel_.measure(s)); });
}

template <int D>
void Refinement<D>::add_box() {
  const std::vector<Point<D>> places = this->boundary();
  std::vector<std::uint32_t> vertices;
  for (const std::uint32_t i : spatial_order<D>(places)) {
    add_place(places[i], VertexKind::boundary);
    vertices.push_back(static_cast<std::uint32_t>(kernel_.places()));
  }
  build<D>(kernel_, vertices, [](std::uint32_t, std::uint32_t) {});
}

/// The nearest to the middle of the box.
template <int D>
std::uint32_t Refinement<D>::first_point() const {
  Point<D> middle;
  for (int i = 0; i < D; ++i) middle[i] = box_.lo[i] + box_.side / 2;
  std::uint32_t best = 0;
  for (std::uint32_t k = 1; k < lists_.left(); ++k) {
    if (squared_distance(lists_.place(k), middle) < squared_distance(lists_.place(best), middle)) {
      best = k;
    }
  }
  return best;
}

template <int D>
void Refinement<D>::add_first_point() {
  const std::uint32_t first = first_point();
  add_place(lists_.place(first), VertexKind::input);
  const auto v = static_cast<std::uint32_t>(kernel_.places());
  kernel_.insert(v);
  lists_.start(v, kernel_.place(v), first);
  queue_.add_crowded(v);
}

template <int D>
void Refinement<D>::look_at(std::uint32_t s, const Shape& shape) {
  if (!this->is_poor(shape)) return;
  const bool skinny = shape.radius2 > skinny2_ * shape.shortest2;
  queue_.add(s, skinny ? WorkQueue::Wait::skinny : WorkQueue::Wait::moderately_skinny);
}

// --- Split [Fig 2.7] -------------------------------------------------------------------------

/// Of a point near the centre nearly always a corner of s is the owner: so they are asked before
/// anything is dug [rules D6].
template <int D>
void Refinement<D>::split(std::uint32_t s) {
  const Centre<D> centre = centres_.of(kernel_, s);
  const bool warps = lists_.left() != 0 && !centre.on_side;
  if (warps) {
    if (const Found found = point_near_corners(centre, s); found.point != kNone) {
      ++stats_.warped;
      return insert_point(found, s);
    }
  }
  centres_.require_apart(kernel_, s, centre);
  const std::uint32_t v =
      add_place(centre.place, centre.on_side ? VertexKind::boundary : VertexKind::steiner);
  on_sides_ += centre.on_side ? 1 : 0;
  kernel_.dig(v, s);
  const Found found = warps ? point_near_link(centre, s) : Found{};
  if (found.point != kNone) {
    ++stats_.warped;
    kernel_.undo_dig();
    kernel_.set_place(v, lists_.place(found.point));
    kinds_[v] = VertexKind::input;
    kernel_.dig(v, s);
  }
  insert_dug(v, found);
}

/// Around a Steiner vertex any point can go in: none is near, or it would be there in its place.
template <int D>
void Refinement<D>::split_crowded(std::uint32_t v) {
  const bool is_input = kinds_[v] == VertexKind::input;
  const Found found{is_input ? lists_.farthest(v) : lists_.any(v), v};
  const Point<D> p = lists_.place(found.point);
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
template <int D>
std::uint32_t Refinement<D>::largest_in_star(std::uint32_t v) const {
  std::uint32_t largest = kNone;
  double radius2 = 0;
  for (const std::uint32_t s : star_) {
    const double r2 = squared_distance(kernel_.simplices().ball(s).centre, kernel_.place(v));
    if (r2 > radius2) largest = s, radius2 = r2;
  }
  return largest;
}

/// Whether p is in B(c, k r) of a simplex with corner v.
template <int D>
bool Refinement<D>::is_deep_in(std::uint32_t s, const Point<D>& p, std::uint32_t v) const {
  const Point<D>& c = kernel_.simplices().ball(s).centre;
  const double r2 = squared_distance(c, kernel_.place(v));
  return squared_distance(c, p) < k_ * k_ * r2;
}

template <int D>
auto Refinement<D>::point_near(const Centre<D>& centre, std::uint32_t w) const -> Found {
  const std::uint32_t point = lists_.find(w, kernel_.place(w), centre.place, k_ * centre.radius);
  return {point, w};
}

/// A point whose insertion takes s out.
template <int D>
auto Refinement<D>::point_near_corners(const Centre<D>& centre, std::uint32_t s) const -> Found {
  for (const std::uint32_t w : kernel_.simplices().corners(s)) {
    const Found found = point_near(centre, w);
    if (found.point != kNone && kernel_.conflicts(s, lists_.place(found.point))) return found;
  }
  return {};
}

/// The same in the lists of those around the hole that is dug at the centre.
template <int D>
auto Refinement<D>::point_near_link(const Centre<D>& centre, std::uint32_t s) const -> Found {
  Found best;
  kernel_.for_each_in_link([&](std::uint32_t w) {
    if (best.point != kNone) return;
    const Found found = point_near(centre, w);
    if (found.point != kNone && kernel_.conflicts(s, lists_.place(found.point))) best = found;
  });
  return best;
}

// --- Insert [Fig 2.8] ------------------------------------------------------------------------

template <int D>
std::uint32_t Refinement<D>::add_place(const Point<D>& p, VertexKind kind) {
  const std::uint32_t v = Base::add_place(p, kind);
  lists_.add_vertex();
  return v;
}

/// Requires: it takes s out.
template <int D>
void Refinement<D>::insert_point(const Found& found, std::uint32_t s) {
  const std::uint32_t v = add_place(lists_.place(found.point), VertexKind::input);
  kernel_.dig(v, s);
  insert_dug(v, found);
}

/// A point that is not in its owner's cell, but for rounding. It may be where a vertex is.
template <int D>
void Refinement<D>::insert_lost(const Found& found) {
  const Point<D>& p = lists_.place(found.point);
  const std::uint32_t s = kernel_.walk(p, star_.front());
  for (const std::uint32_t w : kernel_.simplices().corners(s)) {
    if (kernel_.place(w) != p) continue;
    kinds_[w] = VertexKind::input;
    return lists_.drop(found.owner, found.point);
  }
  insert_point(found, s);
}

/// `found`: the point that v is, if it is one.
template <int D>
void Refinement<D>::insert_dug(std::uint32_t v, const Found& found) {
  for (const std::uint32_t s : kernel_.doomed()) queue_.forget(s);
  this->count_degrees(kernel_.doomed(), -1);
  if (lists_.left() != 0) {
    const Point<D>& p = kernel_.place(v);
    bool is_point = false;
    kernel_.for_each_in_link([&](std::uint32_t w) {
      if (w != kInfinite) is_point |= lists_.relocate(v, p, w, kernel_.place(w));
    });
    if (is_point) {
      kinds_[v] = VertexKind::input;
    } else if (found.point != kNone) {
      lists_.drop(found.owner, found.point);
    }
    if (lists_.is_crowded(v)) queue_.add_crowded(v);
  }
  kernel_.fill(v);
  queue_.make_room(kernel_.simplices().places());
  const auto& made = kernel_.made();
  for (std::size_t k = 0; k < made.size(); ++k) look_at(made[k], kernel_.shape_made(k));
  this->count_made();
}

template <int D>
SvrStats Refinement<D>::stats() const {
  SvrStats stats = stats_;
  this->set_figures(stats);
  return stats;
}

template class Refinement<2>;
template class Refinement<3>;

}  // namespace mesher::detail
