// What refinements of lines and polygons have in common: a refined mesh that is made to conform.
#pragma once

#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "refinement/conformity.hpp"
#include "refinement/plane_conformity.hpp"
#include "refinement/refined_mesh.hpp"

namespace mesher::detail {

template <int D>
class ConformingMesh : public RefinedMesh<D> {
  using Base = RefinedMesh<D>;

 public:
  using Conforms = std::conditional_t<D == 2, PlaneConformity, Conformity>;
  using Placed = typename Conforms::Placed;

  struct Settings : Base::Settings {
    typename Conforms::Store* store = nullptr;  // the features of the points, by handles
    const SpaceNames* names = nullptr;          // of these, in space: errors tell them
    std::vector<VertexHandle> handles{};        // those of the points
    bool only_enclosed = false;                 // else all of the box
    std::vector<Point<D>> holes{};
    std::vector<LimitedRegion<D>> regions{};
  };

  [[nodiscard]] const Conforms& conformity() const noexcept { return conformity_; }

 protected:
  using Base::kernel_, Base::kinds_;

  /// Requires: there is a store, which lives as long as this.
  ConformingMesh(const MeshBox<D>& box, const Settings& settings, std::size_t points);

  std::uint32_t add_place(const Placed& place, VertexKind kind, VertexHandle point = 0);
  /// Requires: dug.
  void undo_place();
  /// Digs a vertex that is to make the mesh conform; or nothing, if it yields. Throws: Error
  /// (too_close: there is a vertex, as add_place()).
  [[nodiscard]] std::optional<std::uint32_t> dig(const typename Conforms::Wanted& wanted);
  /// Whether a poor simplex is split: it is in what is wanted, and not poor by a small angle.
  /// Requires: conformity_.next() has returned nothing, and nothing was inserted since. Throws:
  /// SurelyTooMany, where narrow gaps of a complex need more vertices than there may be.
  [[nodiscard]] bool is_split(std::uint32_t s);
  /// As of points: nothing is too large that is outside of what is wanted, and regions have limits
  /// of their own. Requires: as is_split().
  [[nodiscard]] std::uint32_t take_large();
  /// As of points, outside of the balls of pieces and tiles. Requires: as is_split().
  [[nodiscard]] std::optional<std::uint32_t> dig_on_lattice(std::uint32_t s);
  /// As of points, but pieces and tiles stay. Where they leave no place, the longest piece on the
  /// sliver is split, if it is not shorter than the floors allow: often it is where polygons meet
  /// at nearly 180 degrees. (Not of poor slivers: in a fan of polygons that goes on and on.)
  /// Requires: as is_split().
  [[nodiscard]] std::optional<std::uint32_t> dig_sliver();
  /// Whether there may be more to do, after a look at all. Requires: as is_split().
  [[nodiscard]] bool looks_again() { return conformity_.looks_again(); }
  /// At the end. Requires: as is_split().
  void finish();

  std::vector<VertexHandle> handles_;  // of points
  const SpaceNames* names_;
  Conforms conformity_;

 private:
  [[nodiscard]] static bool is_taken(const typename Conforms::Wanted& wanted,
                                     const Point<D>& there);
  void drop_place();
  [[nodiscard]] bool has_outside();
  [[nodiscard]] bool stays(std::uint32_t s) const;

  [[nodiscard]] std::optional<double> limit_in_region(std::uint32_t s, double measure);
  void find_regions();
  void judge();

  bool only_enclosed_, has_regions_ = false;
  std::size_t judged_with_;  // so many vertices it is asked whether there will be too many
  std::vector<Point<D>> holes_;
  std::vector<LimitedRegion<D>> regions_;
  std::vector<double> limits_;       // by the names of regions
  std::vector<std::uint32_t> star_;  // scratch
};

}  // namespace mesher::detail
