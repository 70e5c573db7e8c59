// Unstructured grids of VTK's two formats (`.vtu`, `.vtk`) as they stand in the file.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "io/note_counter.hpp"
#include "mesher/error.hpp"
#include "mesher/mesh.hpp"

namespace mesher {

/// Cell types of VTK's vtkCellType.h.
enum class VtkCell : std::uint8_t {
  vertex = 1,
  poly_vertex = 2,
  line = 3,
  poly_line = 4,
  triangle = 5,
  polygon = 7,
  quad = 9,
  tetrahedron = 10,
  quadratic_line = 21,
  quadratic_triangle = 22,
  quadratic_tetrahedron = 24
};

/// Numbers under a name; all integers, or all doubles.
struct VtkArray {
  std::string name;
  std::size_t components = 1;
  bool is_integral = false;
  std::vector<double> reals;           ///< empty where integral
  std::vector<std::int64_t> integers;  ///< empty where not
  FileLocation place;

  [[nodiscard]] std::size_t size() const { return is_integral ? integers.size() : reals.size(); }
};

struct VtkGrid {
  std::string file;
  VtkArray points;                        ///< 3 components, reals
  VtkArray connectivity, offsets, types;  ///< integers; an offset is a cell's end
  std::vector<VtkArray> point_data, cell_data;
  NoteCounter notes;
  /// Of a grid without cells: whether its field data say that its dimension is 3.
  bool is_in_space = false;

  [[nodiscard]] std::size_t point_count() const { return points.size() / 3; }
  [[nodiscard]] std::size_t cell_count() const { return types.size(); }
  /// The vertices of a cell. Requires: consistent.
  [[nodiscard]] std::vector<std::uint32_t> cell(std::size_t i) const;
  [[nodiscard]] VtkCell type(std::size_t i) const {
    return static_cast<VtkCell>(types.integers[i]);
  }
  /// An array of integers, one for each item; nullptr if there is none of this name.
  [[nodiscard]] static const VtkArray* find_integers(const std::vector<VtkArray>& arrays,
                                                     std::string_view name);
  /// Of numbers of any kind, one for each item.
  [[nodiscard]] static const VtkArray* find(const std::vector<VtkArray>& arrays,
                                            std::string_view name);
};

/// Throws: Error as read_mesh. The grid is consistent: sizes agree, cells name points.
[[nodiscard]] VtkGrid read_vtu(const std::string& path);
[[nodiscard]] VtkGrid read_vtk(const std::string& path);

/// Throws: Error (wrong_count, bad_mesh, too_many) unless `grid` is consistent.
void require_consistent(const VtkGrid& grid);

/// Throws: Error(bad_dimension) unless z is the same everywhere. Requires: consistent.
void require_plane(const VtkGrid& grid);

/// Notes the arrays that are not among `used` (which may have nullptrs).
void note_unused(const std::vector<VtkArray>& arrays, std::initializer_list<const VtkArray*> used,
                 NoteCounter& notes);

}  // namespace mesher
