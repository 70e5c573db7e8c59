// Sparse Voronoi refinement of points [Fig 2.5-2.9].
//
// The mesh is a Delaunay kernel whose simplices keep their balls; beside it are the points that are
// no vertices yet and the queue of what is to be done. All is a function of the points' order.
//
// Departures from the figures, by measurement [rules D]:
//   - a new vertex is an off-centre [Ungor 2004], on the way from the middle of the shortest edge
//   to
//     the circumcentre, in space at most rho edges from the middle (D8): 5% fewer vertices;
//   - while a point is left only simplices beyond 1.25 rho are skinny (D9): 3% to 8% fewer;
//   - a crowded input vertex has its farthest point inserted, if that is in some B(c, k r) around
//     it, before its largest simplex is split (D7): 10% fewer;
//   - no circumcentre is outside of the box, whose sides begin with a grid that is fine enough
//     [L 4.4.1]; where the box is left all the same, the new vertex goes onto its side.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "delaunay/kernel.hpp"
#include "geometry/grid.hpp"
#include "mesher/svr.hpp"
#include "svr/voronoi_lists.hpp"
#include "svr/work_queue.hpp"

namespace mesher::detail {

template <int D>
class Refinement {
 public:
  using Kernel = DelaunayKernel<D, BallLayout<D>>;

  struct Settings {
    double rho = 2, k = 0.9;
    std::size_t most_vertices = 0;  // 0: any number
    bool follow_degrees = false;
    std::function<void(std::size_t)> watch{};  // called now and then with the number of vertices
  };

  /// Of distinct points in the box's domain, in an order in which what is near is near.
  Refinement(const MeshBox<D>& box, std::span<const Point<D>> points, const Settings& settings);

  /// Throws: Error (too_many; too_close: rounding moves a new vertex too far), what watch() throws.
  void run();

  [[nodiscard]] const Kernel& kernel() const noexcept { return kernel_; }
  /// By vertex; of infinity, too.
  [[nodiscard]] const std::vector<VertexKind>& kinds() const noexcept { return kinds_; }
  /// But for what is counted in the result.
  [[nodiscard]] const SvrStats& stats() const noexcept { return stats_; }

 private:
  // Where a simplex is split: in its ball, `radius` from the nearest of its corners.
  struct Centre {
    Point<D> place;
    double radius;
    bool on_side;  // of the box
  };
  // A point, and the vertex that has it on its list; or none.
  struct Found {
    std::uint32_t point = kNone, owner = kNone;
  };

  void start();
  void add_box();
  void add_first_point();
  [[nodiscard]] std::uint32_t first_point() const;
  void look_at_all();
  void look_at(std::uint32_t s, const Shape& shape);

  void split(std::uint32_t s);
  void split_crowded(std::uint32_t v);
  [[nodiscard]] std::uint32_t largest_in_star(std::uint32_t v) const;
  [[nodiscard]] bool is_deep_in(std::uint32_t s, const Point<D>& p, std::uint32_t v) const;
  [[nodiscard]] Centre centre_of(std::uint32_t s) const;
  [[nodiscard]] Centre moved_to_sides(const Centre& centre, double margin) const;
  void require_apart(std::uint32_t s, const Centre& centre) const;
  [[nodiscard]] Found point_near(const Centre& centre, std::uint32_t w) const;
  [[nodiscard]] Found point_near_corners(const Centre& centre, std::uint32_t s) const;
  [[nodiscard]] Found point_near_link(const Centre& centre, std::uint32_t s) const;

  std::uint32_t add_place(const Point<D>& p, VertexKind kind);
  void insert_point(const Found& found, std::uint32_t s);
  void insert_lost(const Found& found);
  void insert_dug(std::uint32_t v, const Found& found);
  void count_degrees(std::span<const std::uint32_t> simplices, int change);

  MeshBox<D> box_;
  Settings settings_;
  double rho2_, skinny2_;
  double height_;  // of an off-centre, in units of the edge
  double tiny_;
  Kernel kernel_;
  VoronoiLists<D> lists_;
  WorkQueue queue_;
  std::vector<VertexKind> kinds_;
  SvrStats stats_;
  double worst2_ = 0;                   // radius-edge ratio, squared
  std::vector<std::uint32_t> star_;     // scratch
  std::vector<std::size_t> star_size_;  // by vertex, if degrees are followed
};

}  // namespace mesher::detail
