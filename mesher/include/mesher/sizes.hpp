// Sizes of simplices as functions of position.
//
// A size h at p limits a simplex with its centroid at p to the measure of a regular one with edges
// of length h: for a triangle the area sqrt(3) / 4 h^2, for a tetrahedron the volume h^3 / (6
// sqrt(2)). Where a size is infinite there is no limit.
//
// Example: fine around the origin, and coarser with the distance.
//   options.sizes = std::make_shared<mesher::SlopedSizes<2>>(
//       [](const mesher::Point<2>& p) { return 0.01 + 0.1 * std::hypot(p[0], p[1]); },
//       0.1, 0.01);
//
// The mesh is a function of the field: of its sizes and its bounds. Tight bounds make an even mesh.
// With a field that violates its own bounds no simplex is too large, but the mesh is less even and
// changes more under edits.
#pragma once

#include <functional>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher {

/// The area of an equilateral triangle with edges of length 1.
inline constexpr double kAreaOfSize = 0.43301270189221932;
/// The volume of a regular tetrahedron with edges of length 1.
inline constexpr double kVolumeOfSize = 0.11785113019775793;

/// The largest measure that a size h allows. D is 2 or 3.
template <int D>
[[nodiscard]] constexpr double measure_of_size(double h) noexcept {
  return D == 2 ? kAreaOfSize * h * h : kVolumeOfSize * h * h * h;
}

/// Bounds of sizes.
struct SizeRange {
  double least = 0;
  double most = 0;
  bool even = false;  ///< all finite sizes are known to be plateaus, see SizeField::plateaus
};

/// A size for each position: the same for as long as a mesh refers to it, and on all its threads.
template <int D>
class SizeField {
 public:
  virtual ~SizeField() = default;
  /// The size at p: > 0, perhaps infinite.
  [[nodiscard]] virtual double at(const Point<D>& p) const = 0;
  /// Bounds of the sizes in a box; 0 < least. Close to each other for a small box.
  [[nodiscard]] virtual SizeRange range(const Box<D>& box) const = 0;
  /// All finite sizes, if they are few: each then gets a lattice of its own. Otherwise empty.
  [[nodiscard]] virtual std::vector<double> plateaus() const { return {}; }
};

/// Sizes given by a function whose values at p and q differ by at most `slope` |pq|.
template <int D = 2>
class SlopedSizes final : public SizeField<D> {
 public:
  /// Requires: slope >= 0; 0 < least <= size(p) for all p.
  SlopedSizes(std::function<double(const Point<D>&)> size, double slope, double least)
      : size_(std::move(size)), slope_(slope), least_(least) {}

  [[nodiscard]] double at(const Point<D>& p) const override { return size_(p); }
  [[nodiscard]] SizeRange range(const Box<D>& box) const override;

 private:
  std::function<double(const Point<D>&)> size_;
  double slope_, least_;
};

/// The size of a background at a position. h: length of an edge, input units, > 0. D is 2 or 3.
template <int D>
struct SizeSample {
  Point<D> at{};
  double h = 0;
  friend bool operator==(const SizeSample&, const SizeSample&) = default;
};

/// A background of sizes: linear on the simplices of the Delaunay triangulation of its samples.
/// Around them it is extended to a square (a cube) four times as wide, and constant from its sides
/// outward; at its corners the size is that of the nearest sample. So the samples may all be on a
/// plane or a line, and a single sample is enough. D is 2 or 3.
/// Throws: Error (bad_option: no samples, or a size that is not above 0; duplicate_point; as
/// delaunay()).
/// Cost: as delaunay(); for each evaluation O(log n) where simplices are not long and thin.
template <int D = 2>
[[nodiscard]] std::shared_ptr<const SizeField<D>> sampled_sizes(
    const std::vector<std::type_identity_t<SizeSample<D>>>& samples);

/// Sets limits everywhere, or in a box, as Mesher::limit does. D is 2 or 3.
template <int D>
void set_limits(Options<D>& options, const SizeLimits<D>& limits);
template <int D>
void set_limits(Options<D>& options, const std::type_identity_t<Box<D>>& box,
                const SizeLimits<D>& limits);

}  // namespace mesher
