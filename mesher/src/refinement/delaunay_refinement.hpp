// Traditional Delaunay refinement [Fig 2.1], with the gamma-bucketed queue [Fig 1.5] or a
// strict one.
//
// A simplex that is gone leaves its entry: each place of a simplex counts how many there were, and
// an entry names the one that it is for.
//
// Of lines and polygons (`Mesh` is ConformingMesh) what the mesh needs to conform comes before poor
// simplices. A centre that encroaches on features yields: these are split first.
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "refinement/bucketed_queue.hpp"
#include "refinement/conforming_mesh.hpp"
#include "refinement/refine.hpp"
#include "refinement/refined_mesh.hpp"
#include "refinement/strict_queue.hpp"

namespace mesher::detail {

/// `Mesh`: RefinedMesh, or ConformingMesh.
template <int D, template <class> class Queue, class Mesh = RefinedMesh<D>>
class DelaunayRefinement : public Mesh {
  using Base = Mesh;
  static constexpr bool kConforms = !std::is_same_v<Mesh, RefinedMesh<D>>;

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
  std::uint32_t add(const Point<D>& p, VertexKind kind, std::uint32_t point = kNone);
  [[nodiscard]] bool conforms();
  void look_at(std::uint32_t s, const Shape& shape);
  [[nodiscard]] double key_of(const Shape& shape) const noexcept;
  void split(std::uint32_t s);
  void split_large(std::uint32_t s);
  void split_at_centre(std::uint32_t s);
  void fill(std::uint32_t v);

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
template <int D>
using ComplexRefinement = DelaunayRefinement<D, PowersOfTwo, ConformingMesh<D>>;

}  // namespace mesher::detail
