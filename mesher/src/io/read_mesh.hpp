// The readers of single mesh formats behind read_mesh, and what they share.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "mesher/io.hpp"
#include "io/text.hpp"

namespace mesher {

/// Throws: Error as read_mesh. Edges may be in any order and twice, low and high exchanged.
[[nodiscard]] MeshData read_triangle_files(const std::string& path);
[[nodiscard]] MeshData read_off(const std::string& path);
[[nodiscard]] MeshData read_obj_mesh(const std::string& path);
[[nodiscard]] MeshData read_vtu_mesh(const std::string& path);
[[nodiscard]] MeshData read_vtk_mesh(const std::string& path);
[[nodiscard]] MeshData read_msh(const std::string& path);
[[nodiscard]] MeshData read_medit(const std::string& path);

/// Fields first .. first+2 of `line` as a triangle, each made an index by index_of(field).
/// Throws: Error(bad_mesh) if two are the same.
template <class IndexOf>
[[nodiscard]] Mesh<2>::Simplex read_corners(const text::Line& line, std::size_t first,
                                            IndexOf index_of) {
  const Mesh<2>::Simplex t{index_of(first), index_of(first + 1), index_of(first + 2)};
  if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) return t;
  throw line.error(ErrorCode::bad_mesh, "a triangle with the same corner twice", first);
}

namespace detail {
[[noreturn]] void fail_no_vertex(std::int64_t value, std::size_t count, std::int64_t first,
                                 const Place& place);
[[noreturn]] void fail_other_height(double z, double first, const Place& place);
}  // namespace detail

/// `value` as an index into `count` vertices that are numbered from `first`.
/// Throws: Error(bad_mesh) of the place that `place()` gives, saying that there is none.
template <class PlaceOf>
[[nodiscard]] std::uint32_t vertex_index(std::int64_t value, std::size_t count, std::int64_t first,
                                         PlaceOf place) {
  if (value < first || std::cmp_greater_equal(value - first, count)) {
    detail::fail_no_vertex(value, count, first, place());
  }
  return static_cast<std::uint32_t>(value - first);
}

/// Throws: Error(bad_mesh) of that place for an edge from a vertex to itself.
template <class PlaceOf>
[[nodiscard]] MeshEdge edge_of(std::uint32_t a, std::uint32_t b, PlaceOf place) {
  if (a == b) throw Error(ErrorCode::bad_mesh, "an edge from a vertex to itself", place());
  MeshEdge edge;
  edge.low = std::min(a, b);
  edge.high = std::max(a, b);
  return edge;
}

/// The value of a third coordinate, which must be the same everywhere.
class PlaneHeight {
 public:
  /// Throws: Error(bad_dimension) of that place.
  template <class PlaceOf>
  void require(double z, PlaceOf place) {
    if (!z_) z_ = z;
    if (z != *z_) detail::fail_other_height(z, *z_, place());
  }

 private:
  std::optional<double> z_;
};

}  // namespace mesher
