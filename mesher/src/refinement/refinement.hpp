// Sparse Voronoi refinement of points [Fig 2.5-2.9].
//
// Beside the mesh are the points that are no vertices yet and the queue of what is to be done. All
// is a function of the points' order.
//
// Departures from the figures, by measurement [rules D]:
//   - a new vertex is an off-centre (centres.hpp; D8): 5% fewer vertices;
//   - while a point is left only simplices beyond 1.25 rho are skinny (D9): 3% to 8% fewer;
//   - a crowded input vertex has its farthest point inserted, if that is in some B(c, k r) around
//     it, before its largest simplex is split (D7): 10% fewer;
//   - of a complex, new vertices yield to the features beside them, by a look at the input, until
//     all points are vertices; then it is made to conform, and stays so (conformity.hpp);
//   - no circumcentre is outside of the box, whose sides begin with a grid that is fine enough
//     [L 4.4.1]; where the box is left all the same, the new vertex goes onto its side.
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "refinement/conforming_mesh.hpp"
#include "refinement/location.hpp"
#include "refinement/refined_mesh.hpp"
#include "refinement/svr.hpp"
#include "refinement/voronoi_lists.hpp"
#include "refinement/voronoi_location.hpp"
#include "refinement/work_queue.hpp"

namespace mesher::detail {

/// `Mesh`: RefinedMesh, or ConformingMesh. `Location`: where points wait, see location.hpp.
template <int D, class Mesh, class Location = VoronoiLocation<D, VoronoiLists<D>>>
class Refinement : public Mesh {
  using Base = Mesh;
  static constexpr bool kConforms = !std::is_same_v<Mesh, RefinedMesh<D>>;

 public:
  struct Settings : Base::Settings {
    double k = 0.9;
  };

  /// Of distinct points in the box's domain, in an order in which what is near is near.
  Refinement(const MeshBox<D>& box, std::span<const Point<D>> points, const Settings& settings);

  /// Throws: Error (too_many; too_close: rounding moves a new vertex too far), what watch() throws.
  void run();

  /// But for what is counted in the result.
  [[nodiscard]] SvrStats stats() const;

 private:
  using Base::box_, Base::centres_, Base::kernel_, Base::kinds_, Base::on_sides_, Base::rho2_;

  void start();
  void add_box();
  void add_first_point();
  [[nodiscard]] std::uint32_t first_point() const;
  void look_at(std::uint32_t s, const Shape& shape);

  void split(std::uint32_t s);
  void split_large(std::uint32_t s);
  void split_at_centre(std::uint32_t s);
  void split_crowded(std::uint32_t v);
  [[nodiscard]] std::uint32_t largest_in_star(std::uint32_t v) const;
  [[nodiscard]] bool is_deep_in(std::uint32_t s, const Point<D>& p, std::uint32_t v) const;
  [[nodiscard]] auto takes(std::uint32_t s) const;
  [[nodiscard]] bool conforms();
  [[nodiscard]] bool dig_yielding(std::uint32_t v, const Centre<D>& centre, std::uint32_t s);
  std::uint32_t add_place(const Point<D>& p, VertexKind kind, std::uint32_t point = kNone);
  void set_point(std::uint32_t v, std::uint32_t point);
  void undo_place();
  void insert_point(const Found& found, std::uint32_t s);
  void insert_lost(const Found& found);
  void insert_dug(std::uint32_t v, const Found& found);

  double k_, skinny2_;
  bool has_started_ = false;  // to conform
  Location location_;
  WorkQueue queue_;
  SvrStats stats_;                   // warped and crowded
  std::vector<std::uint32_t> star_;  // scratch
};

template <int D>
using PointRefinement = Refinement<D, RefinedMesh<D>>;
template <int D>
using ComplexSvr = Refinement<D, ConformingMesh<D>>;

}  // namespace mesher::detail
