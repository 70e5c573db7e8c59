// The tables that `.poly` files have in the plane (Triangle) and in space (TetGen): points, holes
// and regions.
#pragma once

#include <filesystem>
#include <optional>
#include <utility>

#include "io/note_counter.hpp"
#include "io/read_node.hpp"
#include "io/rows.hpp"
#include "mesher/graph.hpp"
#include "text/text.hpp"

namespace mesher {

/// What becomes of a `.node` file beside a `.poly` file without points.
enum class PointsBeside : std::uint8_t { read, ignore };

// Requires: `header` is that of the current line.
template <int D>
void read_point_rows(text::FieldLines& lines, const NodeHeader& header, Graph<D>& input,
                     GraphFile<D>& parts) {
  input.attributes_per_point = static_cast<std::size_t>(header.attributes);
  while (std::cmp_less(input.points.size(), header.count)) {
    const text::Line& line = next_row(lines, 1, input.points.size(), header.count, "points");
    require_node_fields(lines, header);
    const Point<D> at = read_node_point<D>(line, CoordinateRule::input);
    for (std::size_t i = 0; i < input.attributes_per_point; ++i) {
      input.attributes.push_back(line.finite(D + 1 + i));
    }
    const std::int64_t marker = header.markers == 0 ? 0 : line.integer(line.size() - 1);
    input.points.push_back({PointId{line.integer(0)}, at, marker});
    parts.points.push_back(line.position(0));
  }
}

/// The points, those of the `.node` file beside if there are none and it is to be read.
/// Throws: Error as read(); so do the others.
template <int D>
void read_point_table(text::FieldLines& lines, PointsBeside beside, Graph<D>& input,
                      GraphFile<D>& parts) {
  const auto read_from = [&](text::FieldLines& from, const std::string& path) {
    const NodeHeader header = read_node_header(header_row(from, path), D);
    parts.point_file = path;
    read_point_rows(from, header, input, parts);
    return header.count;
  };
  if (read_from(lines, parts.file) > 0 || beside == PointsBeside::ignore) return;
  const std::string path = text::with_extension(parts.file, ".node");
  if (!std::filesystem::exists(path)) return;
  const std::string content = text::read_file(path);
  text::FieldLines others(path, content);
  read_from(others, path);
  require_end(others, "points");
}

template <int D>
void read_hole_table(text::FieldLines& lines, Graph<D>& input, GraphFile<D>& parts) {
  const text::Line& header = next_header(lines, "holes");
  const std::int64_t count = read_count(header, 0);
  require_header(header, 1);
  for (std::size_t i = 0; std::cmp_less(i, count); ++i) {
    const text::Line& line = next_row(lines, D + 1, i, count, "holes");
    require_fields(line, D + 1, D + 1);
    input.seeds.push_back(
        hole_seed<D>(line.integer(0), read_node_point<D>(line, CoordinateRule::input)));
    parts.seeds.push_back(line.position(0));
  }
}

// The limit of size of a region. D: the dimension.
template <int D>
std::optional<double> region_limit(const text::Line& line, NoteCounter& notes) {
  if (line.size() < D + 3) {
    notes.add(std::string("a region with one value: taken as its attribute, not as a limit of ") +
                  (D == 2 ? "area" : "volume"),
              line.place(D + 1));
    return std::nullopt;
  }
  const double limit = line.finite(D + 2);
  return limit > 0 ? std::optional(limit) : std::nullopt;
}

/// To the end of the file. There may be no table.
template <int D>
void read_region_table(text::FieldLines& lines, Graph<D>& input, GraphFile<D>& parts,
                       NoteCounter& notes) {
  if (!lines.next()) return;
  const std::int64_t count = read_count(lines.line(), 0);
  require_header(lines.line(), 1);
  for (std::size_t i = 0; std::cmp_less(i, count); ++i) {
    const text::Line& line = next_row(lines, D + 2, i, count, "regions");
    require_fields(line, D + 2, D + 3);
    input.seeds.push_back(region_seed<D>(line.integer(0),
                                         read_node_point<D>(line, CoordinateRule::input),
                                         line.finite(D + 1), region_limit<D>(line, notes)));
    parts.seeds.push_back(line.position(0));
  }
  require_end(lines, "regions");
}

}  // namespace mesher
