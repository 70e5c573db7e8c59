// What must hold of a grid before its cells are looked at.
#include "io/vtk_grid.hpp"

#include <algorithm>

#include "io/read_mesh.hpp"
#include "io/rows.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

void require_size(const VtkArray& array, std::size_t items, const std::string& what) {
  if (array.size() == items * array.components) return;
  throw Error(ErrorCode::wrong_count,
              "the array " + text::quoted(array.name) + " has " + std::to_string(array.size()) +
                  " values, expected " + std::to_string(items * array.components) + " for " +
                  std::to_string(items) + " " + what,
              array.place);
}

void require_offsets(const VtkGrid& grid) {
  std::int64_t before = 0;
  for (std::size_t i = 0; i < grid.offsets.integers.size(); ++i) {
    const std::int64_t end = grid.offsets.integers[i];
    if (end < before || end > static_cast<std::int64_t>(grid.connectivity.size())) {
      throw Error(ErrorCode::bad_mesh,
                  "cell " + std::to_string(i) + " ends at " + std::to_string(end) + ", expected " +
                      std::to_string(before) + " to " + std::to_string(grid.connectivity.size()),
                  grid.offsets.place);
    }
    before = end;
  }
  if (before == static_cast<std::int64_t>(grid.connectivity.size())) return;
  throw Error(ErrorCode::wrong_count,
              "the cells name " + std::to_string(before) + " vertices, the connectivity has " +
                  std::to_string(grid.connectivity.size()),
              grid.connectivity.place);
}

void require_indices(const VtkGrid& grid) {
  for (const std::int64_t v : grid.connectivity.integers) {
    (void)vertex_index(v, grid.point_count(), 0, [&] { return grid.connectivity.place; });
  }
}

}  // namespace

std::vector<std::uint32_t> VtkGrid::cell(std::size_t i) const {
  const auto first = connectivity.integers.begin();
  return {first + (i == 0 ? 0 : offsets.integers[i - 1]), first + offsets.integers[i]};
}

const VtkArray* VtkGrid::find(const std::vector<VtkArray>& arrays, std::string_view name) {
  const auto found =
      std::find_if(arrays.begin(), arrays.end(), [&](const VtkArray& a) { return a.name == name; });
  return found == arrays.end() || found->components != 1 ? nullptr : &*found;
}

const VtkArray* VtkGrid::find_integers(const std::vector<VtkArray>& arrays, std::string_view name) {
  const VtkArray* const found = find(arrays, name);
  return found != nullptr && found->is_integral ? found : nullptr;
}

void require_consistent(const VtkGrid& grid) {
  require_size(grid.points, grid.points.size() / 3, "points");
  require_indexable(grid.point_count(), grid.file);
  require_size(grid.offsets, grid.cell_count(), "cells");
  require_offsets(grid);
  require_indices(grid);
  for (const VtkArray& array : grid.point_data) require_size(array, grid.point_count(), "points");
  for (const VtkArray& array : grid.cell_data) require_size(array, grid.cell_count(), "cells");
}

void require_plane(const VtkGrid& grid) {
  const auto& values = grid.points.reals;
  for (std::size_t i = 2; i < values.size(); i += 3) {
    if (values[i] == values[2]) continue;
    throw Error(ErrorCode::bad_dimension,
                "z is not the same everywhere: " + text::to_text(values[i]) + " at vertex " +
                    std::to_string(i / 3) + ", " + text::to_text(values[2]) + " at vertex 0",
                grid.points.place);
  }
}

void note_unused(const std::vector<VtkArray>& arrays, std::initializer_list<const VtkArray*> used,
                 NoteCounter& notes) {
  for (const VtkArray& array : arrays) {
    if (std::find(used.begin(), used.end(), &array) != used.end()) continue;
    notes.add("the array " + text::quoted(array.name) + " is not used", array.place);
  }
}

}  // namespace mesher
