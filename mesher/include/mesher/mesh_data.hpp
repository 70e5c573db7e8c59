// A mesh together with what its features give it: origins, markers, regions, edges on lines.
//
// This is what writers take and what `read_mesh` returns. Which format keeps what is in io.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/mesh.hpp"

namespace mesher {

/// An edge of a mesh that lies on a line of the input, or on the boundary; low < high.
struct MeshEdge {
  std::uint32_t low = 0, high = 0;  ///< vertices
  std::optional<FeatureId> line{};  ///< the segment or polyline; nothing if none or not known
  std::int64_t marker = 0;          ///< of the line, or of the boundary
  friend bool operator==(const MeshEdge&, const MeshEdge&) = default;
};

/// A face of a mesh of tetrahedra that lies in a polygon of the input, or on the boundary.
/// Corners: the smallest first; on the boundary counterclockwise seen from outside, else ascending.
struct MeshFace {
  std::array<std::uint32_t, 3> corners{};  ///< vertices
  std::optional<FeatureId> polygon{};      ///< nothing if none or not known
  std::int64_t marker = 0;                 ///< of the polygon, or of the boundary

  /// The corners, ascending: the same for both sides.
  [[nodiscard]] std::array<std::uint32_t, 3> key() const {
    const auto [a, b, c] = corners;
    return b < c ? corners : std::array<std::uint32_t, 3>{a, c, b};
  }
  friend bool operator==(const MeshFace&, const MeshFace&) = default;
};

/// What is known of a mesh beside its simplices; an array that is empty says nothing.
struct MeshFeatures {
  /// One per vertex: the id of the input point (kind `input`) or line (kind `segment`) that it is
  /// or lies on; in space, of the polygon if it is on no segment; 0 for other kinds.
  std::vector<FeatureId> origins;
  std::vector<std::int64_t> markers;  ///< one per vertex; 0: none
  std::vector<double> regions;        ///< one per simplex: its region's attribute, finite
  std::vector<MeshEdge> edges;        ///< ascending by (low, high), none twice
  std::vector<MeshFace> faces;        ///< in space; ascending by key(), none twice

  [[nodiscard]] bool empty() const {
    return origins.empty() && markers.empty() && regions.empty() && edges.empty() && faces.empty();
  }
  friend bool operator==(const MeshFeatures&, const MeshFeatures&) = default;
};

/// A mesh of a file or for one.
template <int D>
struct MeshDataOf : Mesh<D> {
  MeshFeatures features;
  std::vector<Note> notes;  ///< what the file holds that is not used

  MeshDataOf() = default;
  explicit MeshDataOf(Mesh<D> mesh, MeshFeatures of = {})
      : Mesh<D>(std::move(mesh)), features(std::move(of)) {}
};
using MeshData = MeshDataOf<2>;

/// A mesh of a file that may hold either.
using AnyMesh = std::variant<MeshDataOf<2>, MeshDataOf<3>>;

/// A neighbour that is not there.
inline constexpr std::uint32_t kNoTriangle = UINT32_MAX;

/// For each triangle the triangle across from each of its corners, or kNoTriangle.
/// Requires: no edge borders more than two triangles. Cost: O(m log d) for vertices of degree d.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> neighbours(const Mesh<2>& mesh);

/// The edges of all triangles, (low, high) ascending. Cost: O(m log d).
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> edges(const Mesh<2>& mesh);

}  // namespace mesher
