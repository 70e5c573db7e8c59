// In which dimension the input of a file is: as much is looked at as tells.
#include <cstdint>
#include <optional>
#include <string_view>

#include "io/line_points.hpp"
#include "io/vtk_grid.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

// Nothing if it is none: the reader will say so.
std::optional<double> number(const text::Line& line, std::size_t i) {
  try {
    return line.finite(i);
  } catch (const Error&) {
    return std::nullopt;
  }
}

// Of a table of points.
text::Share first_lines(const std::string& path) { return {path, head_of<text::FieldLines>(path)}; }

bool obj_is_in_space(const std::string& path) {
  const std::string content = text::read_file(path);
  std::optional<double> first;
  for (text::FieldLines lines(path, content); lines.next();) {
    const text::Line& line = lines.line();
    if (line[0] != "v" || line.size() < 3) continue;
    const std::optional<double> z = line.size() > 3 ? number(line, 3) : 0;
    if (!z || (first && *z != *first)) return true;
    first = z;
  }
  return false;
}

bool vtu_is_in_space(const std::string& path) {
  const auto z = read_vtu(path).points.reals;
  for (std::size_t i = 2; i < z.size(); i += 3) {
    if (z[i] != z[2]) return true;
  }
  return false;
}

}  // namespace

int dimension_of(const std::string& path) {
  const std::string extension = text::extension(path);
  const auto is = [&](std::string_view name) { return extension == name; };
  if (is(".off") || is(".stl") || is(".ply") || is(".vtk") || is(".smesh")) return 3;
  const bool in_space = ((is(".node") || is(".poly")) && node_is_in_space(first_lines(path))) ||
                        ((is(".xyz") || is(".csv")) && is_in_space(text::whole_file(path))) ||
                        (is(".obj") && obj_is_in_space(path)) ||
                        (is(".vtu") && vtu_is_in_space(path));
  return in_space ? 3 : 2;
}

}  // namespace mesher
