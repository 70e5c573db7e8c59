// Traditional Delaunay refinement of points [Fig 2.1], with the gamma-bucketed queue [Fig 1.5] or a
// strict one.
//
// A simplex that is gone leaves its entry: each place of a simplex counts how many there were, and
// an entry names the one that it is for.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/refine.hpp"
#include "svr/bucketed_queue.hpp"
#include "svr/refined_mesh.hpp"
#include "svr/strict_queue.hpp"

namespace mesher::detail {

template <int D, template <class> class Queue>
class DelaunayRefinement : public RefinedMesh<D> {
  using Base = RefinedMesh<D>;

 public:
  struct Settings : Base::Settings {
    RefineOrder order = RefineSettings{}.order;
  };

  /// Of distinct points in the box's domain. `points` has to live until run().
  DelaunayRefinement(const MeshBox<D>& box, std::span<const Point<D>> points,
                     const Settings& settings);

  /// Throws: Error (too_many; too_close: rounding moves a new vertex too far), what watch() throws.
  void run();

  /// But for what is counted in the result.
  [[nodiscard]] RefineStats stats() const;

 private:
  using Base::centres_, Base::kernel_, Base::on_sides_;
  struct Entry {
    std::uint32_t simplex, age;
  };

  void triangulate();
  void look_at(std::uint32_t s, const Shape& shape);
  [[nodiscard]] double key_of(const Shape& shape) const noexcept;
  void split(std::uint32_t s);

  std::span<const Point<D>> points_;
  RefineOrder order_;
  Queue<Entry> queue_;
  std::vector<std::uint32_t> age_;  // by simplex
};

/// Of squares.
template <class Item>
using PowersOfTwo = ComputedBuckets<Item>;
template <int D>
using BucketedRefinement = DelaunayRefinement<D, PowersOfTwo>;
template <int D>
using StrictRefinement = DelaunayRefinement<D, StrictQueue>;

}  // namespace mesher::detail
