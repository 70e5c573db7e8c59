// Reads backgrounds of sizes: `.node` with one attribute, `.csv` with x, y (and z), h.
#include <algorithm>
#include <utility>

#include "io/read_node.hpp"
#include "io/read_points.hpp"
#include "io/rows.hpp"
#include "mesher/graph.hpp"
#include "mesher/read.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

// Samples as points, for what is asked of those, and their sizes.
template <int D>
struct Rows {
  PointFile<D> places;
  std::vector<double> sizes;
};

template <int D>
Rows<D> read_node_sizes(const std::string& path) {
  const std::string content = text::read_file(path);
  text::FieldLines lines(path, content);
  const NodeHeader header = read_node_header(header_row(lines, path), D);
  if (header.attributes != 1) {
    throw lines.line().error(
        ErrorCode::bad_header,
        std::to_string(header.attributes) + " attributes, expected one: the size at each place", 2);
  }
  Rows<D> rows{{path, {}, {}, {}}, {}};
  while (std::cmp_less(rows.sizes.size(), header.count)) {
    const text::Line& line = next_row(lines, 1, rows.sizes.size(), header.count, "sizes");
    require_node_fields(lines, header);
    rows.places.ids.push_back(PointId{line.integer(0)});
    rows.places.points.push_back(read_node_point<D>(line, CoordinateRule::input));
    rows.places.lines.push_back(line.number());
    rows.sizes.push_back(line.coordinate(1 + D));
  }
  require_end(lines, "sizes");
  return rows;
}

template <int D>
Rows<D> split(PointFile<D + 1> all) {
  Rows<D> rows{{all.file, std::move(all.ids), {}, std::move(all.lines)}, {}};
  for (const Point<D + 1>& row : all.points) {
    Point<D> place;
    std::copy_n(row.begin(), D, place.begin());
    rows.places.points.push_back(place);
    rows.sizes.push_back(row[D]);
  }
  return rows;
}

template <int D>
Rows<D> read_any_sizes(const std::string& path) {
  const std::string extension = text::extension(path);
  if (extension == ".node") return read_node_sizes<D>(path);
  if (extension == ".csv") return split<D>(read_csv_sizes<D>(path));
  throw Error(ErrorCode::unknown_format,
              "sizes are read from .node and .csv, not " + text::quoted(extension), {path});
}

template <int D>
void require_positive(const Rows<D>& rows) {
  const auto bad =
      std::find_if(rows.sizes.begin(), rows.sizes.end(), [](double h) { return h <= 0; });
  if (bad == rows.sizes.end()) return;
  throw Error(ErrorCode::bad_number, "a size of " + text::to_text(*bad) + ": sizes are above 0",
              rows.places.location(static_cast<std::size_t>(bad - rows.sizes.begin())));
}

}  // namespace

template <int D>
SizeFile<D> read_sizes(const std::string& path) {
  const Rows<D> rows = read_any_sizes<D>(path);
  require_distinct_ids(rows.places);
  require_distinct_points(rows.places);
  require_positive(rows);
  SizeFile<D> file{path, {}, {}};
  for (std::size_t i = 0; i < rows.sizes.size(); ++i) {
    file.samples.push_back({rows.places.points[i], rows.sizes[i]});
    file.positions.push_back({rows.places.lines[i], 1});
  }
  return file;
}
template SizeFile<2> read_sizes<2>(const std::string&);
#ifndef MESHER_PLANE_ONLY
template SizeFile<3> read_sizes<3>(const std::string&);
#endif

}  // namespace mesher
