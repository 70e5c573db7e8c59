// What refinements of points have in common: a Delaunay kernel in a box, whose simplices keep their
// balls, kinds of vertices, and figures of the run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include "delaunay/kernel.hpp"
#include "geometry/grid.hpp"
#include "refinement/centres.hpp"
#include "refinement/large_simplices.hpp"
#include "refinement/refine.hpp"
#include "refinement/space_slivers.hpp"

namespace mesher::detail {

// Along an edge of a coarse box. A ball with its centre beyond a side and no vertex inside meets
// the side in a disc of radius step / sqrt(2) at most, so it has its corners as near to that side:
// with four steps, half of the domain's distance to it. That is enough nearly always (with three,
// it was not for 10^5 random points), and where it is not, the run begins anew with the grid of gap
// balls. (With that grid from the start, eight steps, small complexes take up to three times as
// long, and meshes have up to 3% more vertices. To go on instead, from the centre to the side, need
// not end: a vertex beside a side, in the ball of one of its edges, halves the distance again and
// again.)
inline constexpr int kCoarseSteps = 4;
// Where only what polygons enclose is refined, little is beside the sides: 26 vertices in place of
// 98 halve the time of the smallest complexes, and save nothing of large ones.
inline constexpr int kCoarsestSteps = 2;
inline constexpr std::size_t kFewPoints = 1000;

/// A box with few vertices does not do: the run is to begin anew with more.
struct SideReached {};

template <int D>
class RefinedMesh {
 public:
  using Kernel = DelaunayKernel<D, BallLayout<D>>;

  struct Settings {
    double rho = 2;
    double min_dihedral = 0;                                       // in degrees, in space; 0: any
    bool thorough = true;                                          // with slivers: see there
    std::shared_ptr<const Limits<D>> limits{};                     // null: there are none
    double least_limit = std::numeric_limits<double>::infinity();  // of regions
    double growth = 0;                                             // of sizes; 0: any
    std::size_t most_vertices = 0;                                 // 0: any number
    bool follow_degrees = false;
    int box_steps = 0;                         // along its edges; 0: the grid of gap balls
    std::function<void(std::size_t)> watch{};  // called now and then with the number of vertices
  };

  [[nodiscard]] const Kernel& kernel() const noexcept { return kernel_; }
  /// By vertex; of infinity, too.
  [[nodiscard]] const std::vector<VertexKind>& kinds() const noexcept { return kinds_; }

 protected:
  RefinedMesh(const MeshBox<D>& box, const Settings& settings, std::size_t points);

  /// How many vertices there may be, if there are as many; else 0.
  [[nodiscard]] std::size_t full_with() const noexcept {
    return kernel_.places() >= settings_.most_vertices ? settings_.most_vertices : 0;
  }
  /// How many there may be: no more than `otherwise`, which holds if there is no limit.
  [[nodiscard]] std::size_t most_vertices(std::size_t otherwise) const noexcept {
    const std::size_t most = settings_.most_vertices;
    return most == 0 ? otherwise : std::min(most, otherwise);
  }
  [[nodiscard]] double rho() const noexcept { return settings_.rho; }
  /// Throws: Error(too_many) beyond settings.most_vertices, what add_place() of the kernel throws.
  std::uint32_t add_place(const Point<D>& p, VertexKind kind);
  /// Of the box with its grids.
  [[nodiscard]] std::vector<Point<D>> boundary() const;
  /// Where a poor simplex is split. Throws: SideReached, if the box has steps of its own.
  [[nodiscard]] Centre<D> centre_of(std::uint32_t s) const {
    const Centre<D> centre = centres_.of(kernel_, s);
    if (centre.on_side) require_box(kCoarseSteps + 1);
    return centre;
  }
  /// Throws: SideReached, if the box has fewer steps than `least`.
  void require_box(int least) const {
    if (settings_.box_steps != 0 && settings_.box_steps < least) throw SideReached();
  }
  /// Now and then, of `count` vertices.
  void watch(std::size_t step, std::size_t count) const {
    if (settings_.watch != nullptr && step % kBetweenWatches == 0) settings_.watch(count);
  }
  /// Whether the simplex is poor; of a ghost nothing is true.
  [[nodiscard]] bool is_poor(const Shape& shape) noexcept {
    if (shape.radius2 > worst2_ * shape.shortest2) worst2_ = shape.radius2 / shape.shortest2;
    return shape.radius2 > rho2_ * shape.shortest2;
  }
  /// Of a simplex that is new: whether it is large, or a sliver.
  void look_for_others(std::uint32_t s) {
    if (large_.started()) large_.look_at(kernel_, s);
    if constexpr (D == 3) {
      if (slivers_.started()) slivers_.look_at(kernel_, kinds_, s);
    }
  }
  /// Whether a poor simplex stays since slivers were split: see there.
  [[nodiscard]] bool is_below_floor([[maybe_unused]] std::uint32_t s) {
    if constexpr (D == 3) {
      return slivers_.started() &&
             slivers_.is_below_floor(kernel_, s, kernel_.measure(s).shortest2);
    }
    return false;
  }
  /// The next simplex that is too large; kNone: there is none. Requires: no simplex is poor.
  [[nodiscard]] std::uint32_t take_large() {
    return take_large_if([](std::uint32_t, double measure) { return std::optional(measure); });
  }
  /// The same with limits of its own: see LargeSimplices::take().
  template <class Limit>
  [[nodiscard]] std::uint32_t take_large_if(Limit&& limit) {
    if (!large_.any()) return kNone;
    return large_.take(kernel_, limit);
  }
  /// Digs a point of the lattice that splits a simplex, which take_large() has returned; nothing:
  /// none suits.
  [[nodiscard]] std::optional<std::uint32_t> dig_on_lattice(std::uint32_t s) {
    return dig_on_lattice_if(
        s, [&](const Point<D>& p) { return add_place(p, VertexKind::steiner); },
        [&] { drop_place(); }, [](std::uint32_t) { return true; });
  }
  /// The same, where fits(v). `add(p)` and `drop()`: of a place.
  template <class Add, class Drop, class Fits>
  [[nodiscard]] std::optional<std::uint32_t> dig_on_lattice_if(std::uint32_t s, Add&& add,
                                                               Drop&& drop, Fits&& fits);
  /// Digs a vertex that splits a sliver; nothing: there is none that one will split. Requires: no
  /// simplex is poor.
  [[nodiscard]] std::optional<std::uint32_t> dig_sliver() {
    return dig_sliver_if([](std::uint32_t) { return true; },
                         [&](const Point<D>& p) { return add_place(p, VertexKind::steiner); },
                         [&] { drop_place(); }, [] { return true; },
                         [](std::uint32_t, double) { return std::nullopt; });
  }
  /// The same, if is_split(sliver). `add(p)` and `drop()`: of a place; `fits()`: the vertex that is
  /// dug may be where it is; `otherwise(sliver, floor2)`: digs another vertex, if none may, or
  /// returns nothing. Where there is no room for vertices none is dug.
  template <class IsSplit, class Add, class Drop, class Fits, class Otherwise>
  [[nodiscard]] std::optional<std::uint32_t> dig_sliver_if(IsSplit&& is_split, Add&& add,
                                                           Drop&& drop, Fits&& fits,
                                                           Otherwise&& otherwise);
  /// Whether there may be more to do, after a look at all.
  [[nodiscard]] static constexpr bool looks_again() noexcept { return false; }
  /// Forgets a place that is no vertex.
  void drop_place() {
    kernel_.drop_place();
    kinds_.pop_back();
  }
  /// Of a vertex that is dug.
  void before_fill(std::uint32_t v) {
    count_degrees(kernel_.doomed(), -1);
    if (large_.started()) large_.before_fill(kernel_, v);
    if constexpr (D == 3) {
      if (slivers_.started()) slivers_.before_fill(kernel_, v);
    }
  }
  /// Of what was made.
  void after_fill() {
    made_ += kernel_.made().size();
    count_degrees(kernel_.made(), 1);
    if (large_.started()) large_.after_fill(kernel_);
  }
  /// Calls look(s, shape) for each simplex and counts them.
  template <class Look>
  void look_at_all(Look&& look);
  /// All but what is counted in the result.
  void set_figures(RefineStats& stats) const;

  MeshBox<D> box_;
  double rho2_;
  Kernel kernel_;
  Centres<D> centres_;
  std::vector<VertexKind> kinds_{VertexKind::boundary};
  std::size_t on_sides_ = 0;

 private:
  static constexpr std::size_t kBetweenWatches = 256;

  void count_degrees(std::span<const std::uint32_t> simplices, int change);

  // To split a sliver takes as long as so many other steps, or longer.
  static constexpr std::size_t kSliverTakes = 16;

  LargeSimplices<D> large_;
  std::size_t taken_ = 0;  // slivers
  std::conditional_t<D == 3, Slivers, std::monostate> slivers_;
  Settings settings_;
  double worst2_ = 0;  // radius-edge ratio, squared
  std::size_t made_ = 0, largest_degree_ = 0;
  std::vector<std::size_t> star_size_;  // by vertex, if degrees are followed
};

template <int D>
template <class Look>
void RefinedMesh<D>::look_at_all(Look&& look) {
  kernel_.for_each_shape([&](std::uint32_t s, const Shape& shape) {
    count_degrees(std::span(&s, 1), 1);
    look(s, shape);
  });
}

template <int D>
template <class Add, class Drop, class Fits>
std::optional<std::uint32_t> RefinedMesh<D>::dig_on_lattice_if(std::uint32_t s, Add&& add,
                                                               Drop&& drop, Fits&& fits) {
  for (const Point<D>& p : large_.places(kernel_, s)) {
    const std::uint32_t v = add(p);
    if (kernel_.conflicts(s, p)) {
      kernel_.dig(v, s);
      if (large_.is_clear(kernel_, v) && fits(v)) return v;
      kernel_.undo_dig();
    }
    drop();
  }
  return std::nullopt;
}

template <int D>
template <class IsSplit, class Add, class Drop, class Fits, class Otherwise>
std::optional<std::uint32_t> RefinedMesh<D>::dig_sliver_if(IsSplit&& is_split, Add&& add,
                                                           Drop&& drop, Fits&& fits,
                                                           Otherwise&& otherwise) {
  if constexpr (D == 3) {
    if (!slivers_.any()) return std::nullopt;
    if (!slivers_.started()) slivers_.start(kernel_, kinds_);
    if (full_with() != 0) return std::nullopt;
    for (std::uint32_t s; (s = slivers_.take(kernel_)) != kNone;) {
      watch(kBetweenWatches / kSliverTakes * ++taken_, kernel_.places());
      if (!is_split(s)) continue;
      const std::uint32_t v = add(kernel_.simplices().ball(s).centre);
      if (slivers_.dig(kernel_, s, v, fits)) return v;
      drop();
      const std::optional<std::uint32_t> other = otherwise(s, slivers_.least_floor2(kernel_, s));
      if (other) return other;
    }
  }
  return std::nullopt;
}

}  // namespace mesher::detail
