// Formats of points alone that have a line for each point: .node, .xyz and .csv. Several processes
// may read one file, each a share of its lines.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/point_file.hpp"
#include "text/text.hpp"

namespace mesher {

/// Whether a file, by its name, has one of these formats.
[[nodiscard]] bool has_line_points(const std::string& path);

/// What all shares of such a file need of it: its first lines. Throws: Error(cannot_read).
[[nodiscard]] std::string head_of(const std::string& path);

/// Whether that is all that is_in_space() needs.
[[nodiscard]] bool head_tells_dimension(const std::string& path);

/// How many points there are in a share, if nothing is wrong.
[[nodiscard]] std::size_t count_rows(const text::Share& share);

/// Whether one of a share's points is in space: as dimension_of, which is 3 if one is.
[[nodiscard]] bool is_in_space(const text::Share& share);

/// Reads a share. Throws: Error as read(), but repeated ids and duplicate points are not looked
/// for, and of the file's end the first of all shares is right that throws.
template <int D>
[[nodiscard]] GraphFile<D> read_share(const text::Share& share);

/// `markers`: one for each row, or none.
template <int D>
[[nodiscard]] GraphFile<D> points_alone(PointFile<D> rows,
                                        const std::vector<std::int64_t>& markers = {});

// --- In detail -------------------------------------------------------------------------------

/// Throws: Error as read_points, but duplicate points are not looked for.
template <int D>
[[nodiscard]] PointFile<D> read_xyz(const text::Share& share);
template <int D>
[[nodiscard]] PointFile<D> read_csv(const text::Share& share);
template <>
PointFile<2> read_csv<2>(const text::Share& share);
template <>
PointFile<3> read_csv<3>(const text::Share& share);

[[nodiscard]] bool node_is_in_space(const text::Share& share);
/// Whether a z is not 0.
[[nodiscard]] bool xyz_is_in_space(const text::Share& share);
/// Whether the file has three columns, or columns named x, y and z with a z that is not 0.
[[nodiscard]] bool csv_is_in_space(const text::Share& share);

[[nodiscard]] std::string csv_head(const std::string& path);
[[nodiscard]] std::size_t csv_rows(const text::Share& share);

/// Whether a field is the number 0; what is no finite number is not.
[[nodiscard]] bool is_zero(const text::Line& line, std::size_t i);

/// The lines of a file up to the first that AllLines finds.
template <class AllLines>
[[nodiscard]] std::string head_of(const std::string& path) {
  for (std::size_t most = std::size_t{1} << 12;; most *= 16) {
    text::Share start{.file = path, .lines = text::read_file(path, most)};
    AllLines lines(start);
    const bool found = lines.next();
    const std::size_t rest = lines.rest().size();
    if (start.lines.size() == most && (!found || rest == 0)) continue;  // it may be cut
    start.lines.resize(start.lines.size() - rest);
    return start.lines;
  }
}

}  // namespace mesher
