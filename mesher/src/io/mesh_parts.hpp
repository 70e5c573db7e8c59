// A mesh under construction from a file whose format supports both dimensions: vertices in space,
// triangles and tetrahedra. Its dimension is known when all is read: three if there are tetrahedra,
// or if the mesh is empty and the file says so, else two.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/note_counter.hpp"
#include "mesh/simplex_name.hpp"
#include "mesher/mesh.hpp"

namespace mesher {

namespace detail {
[[noreturn]] void fail_other_height(double z, double first, const FileLocation& place);
}  // namespace detail

/// The value of a third coordinate, which must be the same everywhere in the plane.
class PlaneHeight {
 public:
  /// `place()` is asked for once, where z differs.
  template <class PlaceOf>
  void see(double z, PlaceOf place) {
    if (!first_) first_ = z;
    if (z != *first_ && !other_) other_ = {z, place()};
  }
  /// Throws: Error(bad_dimension) of the place where z differed first.
  void require_same() const {
    if (other_) detail::fail_other_height(other_->first, *first_, other_->second);
  }

 private:
  std::optional<double> first_;
  std::optional<std::pair<double, FileLocation>> other_;
};

/// Whether all corners differ. N is small.
template <std::size_t N>
[[nodiscard]] bool are_different(const std::array<std::uint32_t, N>& corners) {
  for (std::size_t i = 0; i < N; ++i) {
    if (std::count(corners.begin(), corners.end(), corners[i]) > 1) return false;
  }
  return true;
}

/// Takes the vertices out that are nodes of second order between corners, and no corners.
/// `is_midpoint`: one per vertex, or fewer.
template <int D>
void drop_midpoints(MeshData<D>& mesh, const std::vector<bool>& is_midpoint);

class MeshParts {
 public:
  explicit MeshParts(std::string file) : file_(std::move(file)) {}

  /// `place()` tells where z stands.
  template <class PlaceOf>
  void add_vertex(const Point<3>& p, PlaceOf place) {
    height_.see(p[2], place);
    vertices_.push_back(p);
  }
  [[nodiscard]] std::size_t vertices() const { return vertices_.size(); }

  /// Requires: corners are different.
  template <int D>
  void add(const typename Mesh<D>::Simplex& corners, double region) {
    cells<D>().simplices.push_back(corners);
    cells<D>().regions.push_back(region);
  }
  /// Likewise; what a triangle is if there are tetrahedra: a face.
  void add_triangle(const Mesh<2>::Simplex& corners, double region, std::int64_t marker,
                    std::optional<PolygonId> polygon = {}) {
    add<2>(corners, region);
    faces_.push_back(face_of(corners, marker, polygon));
  }
  [[nodiscard]] static MeshFace face_of(Mesh<2>::Simplex corners, std::int64_t marker = 0,
                                        std::optional<PolygonId> polygon = {}) {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return {corners, polygon, marker};
  }
  /// How many simplices of dimension D there are.
  template <int D>
  [[nodiscard]] std::size_t count() {
    return cells<D>().simplices.size();
  }

  /// What a node of second order is that a cell has between its corners.
  void add_midpoint(std::uint32_t vertex) {
    if (is_midpoint_.size() < vertices_.size()) is_midpoint_.resize(vertices_.size());
    is_midpoint_[vertex] = true;
  }
  /// The name of a group of cells of that dimension, with that marker or region.
  void add_name(int dimension, std::int64_t number, std::string_view name,
                const FileLocation& place) {
    names_.push_back({dimension, number, std::string(name), place});
  }

  /// One per vertex, or none.
  std::vector<VertexKind> kinds;
  std::vector<Feature> origins;  // by number: the kind shows when all is read
  std::vector<std::int64_t> markers;
  std::vector<MeshEdge> edges;
  NoteCounter notes;
  /// The file says that it is of space, be there tetrahedra or not.
  bool is_in_space = false;

  /// Throws: Error(bad_dimension) if there are no tetrahedra and z is not the same everywhere.
  [[nodiscard]] AnyMesh finish();

 private:
  template <int D>
  struct Cells {
    std::vector<typename Mesh<D>::Simplex> simplices;
    std::vector<double> regions;
  };
  template <int D>
  Cells<D>& cells() {
    if constexpr (D == 2) {
      return triangles_;
    } else {
      return tetrahedra_;
    }
  }
  template <int D>
  [[nodiscard]] MeshData<D> take();
  template <int D>
  [[nodiscard]] GroupNames take_names();
  struct NamedGroup {
    int dimension;
    std::int64_t number;
    std::string name;
    FileLocation place;
  };

  std::string file_;
  std::vector<Point<3>> vertices_;
  Cells<2> triangles_;
  std::vector<MeshFace> faces_;  // the same
  Cells<3> tetrahedra_;
  PlaneHeight height_;
  std::vector<bool> is_midpoint_;  // for the first vertices, or all
  std::vector<NamedGroup> names_;
};

}  // namespace mesher
