// Building it, reading stars.
#include "index/live_triangulation.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>

#include "delaunay/build.hpp"
#include "delaunay/facets.hpp"
#include "delaunay/spatial_order.hpp"
#include "geometry/plane_vectors.hpp"
#include "geometry/space_vectors.hpp"
#include "sac/check.hpp"

namespace mesher::detail {

namespace {

// How many simplices insertions may make, a vertex, before it is given up. In the order of
// spatial_order those of evenly spread points make some 6 in the plane and 25 in space, and those
// of surfaces some more; of a line and a circle they make as many as there are points.
constexpr std::size_t kMostMade = 64;
constexpr std::size_t kMostMadeAtFirst = 4096;

// Of a squared circumradius that has to be surely less than another: the kernel's are off by 2^-21.
constexpr double kSurely = 1 - 0x1p-18;

struct TooMany {};

}  // namespace

template <int D>
auto LiveTriangulation<D>::of(const VertexPool<D>& pool, double good2,
                              const std::function<void()>& step, Of which)
    -> std::unique_ptr<LiveTriangulation> {
  std::unique_ptr<LiveTriangulation> live(new LiveTriangulation(good2));
  return live->build(pool, step, which) ? std::move(live) : nullptr;
}

template <int D>
bool LiveTriangulation<D>::build(const VertexPool<D>& pool, const std::function<void()>& step,
                                 Of which) {
  const std::size_t n = pool.size();
  const std::size_t expected = n + n / 2 + 1024;
  kernel_.reserve(expected);
  simplices_.reserve((D == 2 ? 2 : 7) * expected);
  around_.reserve(expected);
  number_.reserve(expected);
  std::vector<VertexHandle> handles;
  handles.reserve(n);
  pool.for_each([&](const Vertex<D>& v) {
    if (which == Of::vertices && !v.alive) return;
    SAC_EXPECTS(which == Of::vertices || v.self == handles.size() + 1);
    handles.push_back(v.self);
    while (kernel_.places() < v.self) kernel_.add_place(v.p);
  });
  const std::vector<VertexHandle> order =
      in_spatial_order<D>(handles, [&](VertexHandle v) { return pool[v].p; });
  std::size_t inserted = 0, made = 0;
  const auto watch = [&] {
    step();
    made += kernel_.made().size();
    if (made > kMostMade * ++inserted + kMostMadeAtFirst) throw TooMany();
  };
  try {
    // No two are in one place, and the box's corners are in no plane.
    mesher::detail::build<D>(
        kernel_, order, [](std::uint32_t, std::uint32_t) {}, watch);
  } catch (const TooMany&) {
    return false;
  }
  make_room();
  note_all();
  return true;
}

template <int D>
void LiveTriangulation<D>::make_room() {
  if (const std::size_t n = kernel_.simplices().places(); n > simplices_.size()) {
    simplices_.resize(n);
  }
  if (const std::size_t n = kernel_.places() + 1; n > around_.size()) {
    number_.resize(n);
    around_.resize(n);
  }
}

template <int D>
void LiveTriangulation<D>::note(std::uint32_t s, const Shape& shape) {
  const bool good = shape.radius2 < good2_ * shape.shortest2;
  simplices_[s].is_good = good;
  if (good) return;
  for (const std::uint32_t u : kernel_.simplices().corners(s)) ++around_[u].poor;
}

template <int D>
void LiveTriangulation<D>::note_distance(VertexHandle u, VertexHandle v) {
  const double d2 = squared_distance(kernel_.place(u), kernel_.place(v));
  note_nearer(around_[u].nearest, v, d2);
  note_nearer(around_[v].nearest, u, d2);
  least2_ = std::min(least2_, d2);
}

template <int D>
void LiveTriangulation<D>::note_nearer(Nearest& nearest, VertexHandle u, double d2) const {
  if (d2 > nearest.distance2) return;
  if (d2 == nearest.distance2 && kernel_.place(nearest.handle) < kernel_.place(u)) return;
  nearest = {u, d2};
}

template <int D>
void LiveTriangulation<D>::note_all() {
  kernel_.for_each_shape([&](std::uint32_t s, const Shape& shape) {
    note(s, shape);
    const auto& corners = kernel_.simplices().corners(s);
    const float outer2 = kernel_.simplices().ball(s).outer2;
    for (std::size_t i = 0; i <= D; ++i) {
      around_[corners[i]].reach2 = std::max(around_[corners[i]].reach2, outer2);
      for (std::size_t k = 0; k < i; ++k) {
        if (corners[i] != kInfinite && corners[k] != kInfinite)
          note_distance(corners[i], corners[k]);
      }
    }
  });
}

template <int D>
void LiveTriangulation<D>::note_doomed() {
  for (const std::uint32_t s : kernel_.doomed()) {
    if (simplices_[s].is_good != 0) continue;
    for (const std::uint32_t u : kernel_.simplices().corners(s)) --around_[u].poor;
  }
}

template <int D>
bool LiveTriangulation<D>::insert(const Vertex<D>& v) {
  SAC_EXPECTS(v.self > kernel_.places() || !kernel_.has(v.self));
  const std::uint32_t s = kernel_.walk(v.p, recent_simplex());
  for (const std::uint32_t w : kernel_.simplices().corners(s)) {
    if (w != kInfinite && kernel_.place(w) == v.p) return false;
  }
  const std::uint32_t u = v.self;
  while (kernel_.places() < u) static_cast<void>(kernel_.add_place(v.p));
  kernel_.set_place(u, v.p);
  make_room();
  kernel_.dig(u, s);
  note_doomed();
  kernel_.for_each_in_link([&](std::uint32_t w) {
    if (w != kInfinite) note_distance(u, w);
  });
  kernel_.fill(u);
  center_ = 0;
  make_room();
  const auto& made = kernel_.made();
  for (std::size_t k = 0; k < made.size(); ++k) {
    note(made[k], kernel_.shape_made(k));
    around_[u].reach2 = std::max(around_[u].reach2, kernel_.simplices().ball(made[k]).outer2);
  }
  return true;
}

// Those to whom it was nearest are among its neighbours.
template <int D>
void LiveTriangulation<D>::remove(const Vertex<D>& v) {
  SAC_EXPECTS(good2_ == 0 && kernel_.has(v.self));
  std::vector<VertexHandle> around;
  for_each_neighbour(v.self, [&](VertexHandle u) { around.push_back(u); });
  const bool removed = kernel_.remove(v.self);
  SAC_ENSURES(removed);
  static_cast<void>(removed);
  center_ = 0;
  make_room();
  around_[v.self] = {};
  for (const VertexHandle u : around) {
    if (around_[u].nearest.handle == v.self) find_nearest(u);
  }
}

// Of those around u.
template <int D>
void LiveTriangulation<D>::find_nearest(VertexHandle u) {
  Nearest nearest{0, std::numeric_limits<double>::infinity()};
  for_each_neighbour(u, [&](VertexHandle w) {
    note_nearer(nearest, w, squared_distance(kernel_.place(u), kernel_.place(w)));
  });
  around_[u].nearest = nearest;
}

// In the plane from one triangle to the next, counterclockwise; ghosts close the ring.
template <>
void LiveTriangulation<2>::look_around(VertexHandle v) {
  if (center_ == v) return;
  center_ = v;
  star_.clear();
  on_hull_ = false;
  farthest2_ = 0;
  const auto& simplices = kernel_.simplices();
  const std::uint32_t first = kernel_.simplex_at(v);
  std::uint32_t s = first;
  do {
    const std::uint32_t from = kFacet<2>[corner_of(simplices.corners(s), v)][0];
    star_.push_back(s);
    farthest2_ = std::max(farthest2_, simplices.ball(s).outer2);
    on_hull_ = on_hull_ || simplices.corners(s)[from] == kInfinite;
    s = simplices.across(s)[from] >> 2;
  } while (s != first);
}

#ifndef MESHER_PLANE_ONLY
template <>
void LiveTriangulation<3>::look_around(VertexHandle v) {
  if (center_ == v) return;
  center_ = v;
  star_.clear();
  on_hull_ = false;
  farthest2_ = 0;
  const auto& simplices = kernel_.simplices();
  const auto meet = [&](std::uint32_t s) {
    const std::uint32_t at = simplices_[s].in_star;
    if (at < star_.size() && star_[at] == s) return;
    simplices_[s].in_star = static_cast<std::uint32_t>(star_.size()) & 0x7fffffffu;
    star_.push_back(s);
  };
  meet(kernel_.simplex_at(v));
  for (std::size_t k = 0; k < star_.size(); ++k) {
    const auto& corners = simplices.corners(star_[k]);
    const auto& across = simplices.across(star_[k]);
    farthest2_ = std::max(farthest2_, simplices.ball(star_[k]).outer2);
    for (std::size_t i = 0; i <= 3; ++i) {
      on_hull_ = on_hull_ || corners[i] == kInfinite;
      if (corners[i] != v) meet(across[i] >> 2);
    }
  }
}
#endif

// Ghosts are not good.
template <int D>
bool LiveTriangulation<D>::is_settled(const Vertex<D>& v, double radius) {
  Around& around = around_[v.self];
  if (around.poor != 0) return false;
  const double inside2 = kSurely * radius * radius;
  if (static_cast<double>(around.reach2) < inside2) return true;
  look_around(v.self);
  around.reach2 = farthest2_;
  return static_cast<double>(farthest2_) < inside2;
}

template <int D>
void LiveTriangulation<D>::read(CellOf<D>& cell, const Vertex<D>& v, double radius) {
  look_around(v.self);
  if (!on_hull_) return read_star(cell, v, radius);
  ring_.clear();
  for_each_neighbour(v.self, [&](VertexHandle u) { ring_.push_back({u, kernel_.place(u)}); });
  cell.begin_among(v, radius, ring_);
}

// Those that a vertex at p would be joined to are ring_ afterwards.
template <int D>
void LiveTriangulation<D>::find_link(const Point<D>& p, std::uint32_t from) {
  const std::uint32_t s = kernel_.walk(p, from);
  const std::uint32_t u = kernel_.add_place(p);
  struct Undo {
    Kernel& kernel;
    bool dug = false;
    ~Undo() {
      if (dug) kernel.undo_dig();
      kernel.drop_place();
    }
  };
  ring_.clear();
  Undo undo{kernel_};
  kernel_.dig(u, s);
  undo.dug = true;
  kernel_.for_each_in_link([&](std::uint32_t w) { ring_.push_back({w, kernel_.place(w)}); });
}

template <int D>
void LiveTriangulation<D>::read_as_if(CellOf<D>& cell, const Vertex<D>& v, VertexHandle near,
                                      double radius) {
  find_link(v.p, kernel_.simplex_at(near));
  cell.begin_among(v, radius, ring_);
}

template <int D>
void LiveTriangulation<D>::list_near(const Vertex<D>& v, std::vector<VertexHandle>& all) {
  all.clear();
  if (has(v)) return for_each_neighbour(v.self, [&](VertexHandle u) { all.push_back(u); });
  find_link(v.p, recent_simplex());
  for (const auto& u : ring_) {
    if (u.code != kInfinite) all.push_back(u.code);
  }
}

template <>
void LiveTriangulation<2>::read_star(VoronoiCell& cell, const Vertex<2>& v, double radius) {
  ring_.clear();
  for (const std::uint32_t s : star_) {
    const auto& corners = kernel_.simplices().corners(s);
    const VertexHandle u = corners[kFacet<2>[corner_of(corners, v.self)][0]];
    ring_.push_back({u, kernel_.place(u)});
  }
  cell.adopt(v, radius, ring_);
}

#ifndef MESHER_PLANE_ONLY
template <>
void LiveTriangulation<3>::read_star(VoronoiCell3& cell, const Vertex<3>& v, double radius) {
  ring_.clear();
  faces_.clear();
  const auto number_of = [&](VertexHandle u) {
    const std::uint32_t number = number_[u];
    if (number < ring_.size() && ring_[number].code == u) return static_cast<int>(number);
    number_[u] = static_cast<std::uint32_t>(ring_.size());
    ring_.push_back({u, kernel_.place(u)});
    return static_cast<int>(number_[u]);
  };
  for (const std::uint32_t s : star_) {
    const auto& corners = kernel_.simplices().corners(s);
    const auto& across = kernel_.simplices().across(s);
    auto facet = kFacet<3>[corner_of(corners, v.self)];
    std::swap(facet[1], facet[2]);  // orient3d(v, a, b, c) > 0
    VoronoiCell3::Face face;
    for (std::size_t k = 0; k < 3; ++k) {
      face.end[k] = number_of(corners[facet[k]]);
      face.across[k] = static_cast<int>(simplices_[across[facet[k]] >> 2].in_star);
    }
    faces_.push_back(face);
  }
  cell.adopt(v, radius, ring_, faces_);
}
#endif

// Calls visit(u) for each neighbour of v once.
template <int D>
template <class Visit>
void LiveTriangulation<D>::for_each_neighbour(VertexHandle v, Visit&& visit) {
  look_around(v);
  near_.clear();
  for (const std::uint32_t s : star_) {
    for (const std::uint32_t u : kernel_.simplices().corners(s)) {
      if (u == v || u == kInfinite) continue;
      const std::uint32_t number = number_[u];
      if (number < near_.size() && near_[number] == u) continue;
      number_[u] = static_cast<std::uint32_t>(near_.size());
      near_.push_back(u);
      visit(u);
    }
  }
}

// The nearest vertex u is a neighbour. Another one, w, may be no farther as doubles have it, though
// it is no neighbour; but only if some two vertices are as near to each other as is asked here.
// Then it is looked for: those that are about as near as u are joined to v by edges between such.
//
// Proof. Doubles err by less than a factor of 1 + 2^-40 in squares: |vw|^2 is at most that times
// |uv|^2. Since vw is no edge, some vertex z is in the ball with this diameter: |vz|^2 + |zw|^2 <=
// |vw|^2, so z is nearer to v than w, and |zw|^2 <= |vw|^2 - |uv|^2 <= 2^-40 |uv|^2. As for the
// search: on the way from w to v one passes from w's cell to that of a neighbour that is nearer to
// v.
template <int D>
auto LiveTriangulation<D>::nearest(const Vertex<D>& v) -> Nearest {
  Nearest best = around_[v.self].nearest;
  if (best.handle != 0 && !kernel_.has(best.handle)) {  // removed, but for rounding not a neighbour
    find_nearest(v.self);
    best = around_[v.self].nearest;
  }
  if (least2_ > 0x1p-38 * best.distance2) return best;
  const double nearly2 = best.distance2 * (1 + 0x1p-40);
  nearly_.assign(1, v.self);
  for (std::size_t k = 0; k < nearly_.size(); ++k) {
    for_each_neighbour(nearly_[k], [&](VertexHandle u) {
      const double d2 = squared_distance(kernel_.place(u), v.p);
      if (d2 > nearly2 || std::find(nearly_.begin(), nearly_.end(), u) != nearly_.end()) return;
      nearly_.push_back(u);
      note_nearer(best, u, d2);
    });
  }
  return best;
}

template class LiveTriangulation<2>;
#ifndef MESHER_PLANE_ONLY
template class LiveTriangulation<3>;
#endif

}  // namespace mesher::detail
