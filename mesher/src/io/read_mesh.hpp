// The readers of single mesh formats behind read_mesh, and what they share.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "io/mesh_parts.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"
#include "text/text.hpp"

namespace mesher {

/// Throws: Error as read_mesh. Edges may be in any order and twice, low and high exchanged.
[[nodiscard]] AnyMesh read_node_mesh(const std::string& path);
[[nodiscard]] AnyMesh read_off(const std::string& path);
[[nodiscard]] AnyMesh read_obj_mesh(const std::string& path);
[[nodiscard]] AnyMesh read_vtu_mesh(const std::string& path);
[[nodiscard]] AnyMesh read_vtk_mesh(const std::string& path);
[[nodiscard]] AnyMesh read_msh(const std::string& path);
[[nodiscard]] AnyMesh read_medit(const std::string& path);

/// Fields first .. first+D of `line` as a simplex, each made an index by index_of(field).
/// Throws: Error(bad_mesh) if two are the same.
template <int D, class IndexOf>
[[nodiscard]] typename Mesh<D>::Simplex read_corners(const text::Line& line, std::size_t first,
                                                     IndexOf index_of) {
  typename Mesh<D>::Simplex corners;
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = index_of(first + i);
  if (are_different(corners)) return corners;
  throw line.error(ErrorCode::bad_mesh,
                   "a " + std::string(kSimplexName<D>) + " with the same corner twice", first);
}

namespace detail {
[[noreturn]] void fail_no_vertex(std::int64_t value, std::size_t count, std::int64_t first,
                                 const FileLocation& place);
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

}  // namespace mesher
