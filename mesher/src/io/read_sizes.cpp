// Reads backgrounds of sizes: `.node` with one attribute, `.csv` with x, y, h.
#include <algorithm>
#include <utility>

#include "mesher/pslg.hpp"
#include "io/read_node.hpp"
#include "io/read_points.hpp"
#include "io/rows.hpp"
#include "io/text.hpp"

namespace mesher {
namespace {

// Samples as points, for what is asked of those, and their sizes.
struct Rows {
  PointFile<2> places;
  std::vector<double> sizes;
};

Rows read_node_sizes(const std::string& path) {
  const std::string content = text::read_file(path);
  text::FieldLines lines(path, content);
  const NodeHeader header = read_node_header(header_row(lines, path), 2);
  if (header.attributes != 1) {
    throw lines.line().error(
        ErrorCode::bad_header,
        std::to_string(header.attributes) + " attributes, expected one: the size at each place", 2);
  }
  Rows rows{{path, {}, {}, {}}, {}};
  while (std::cmp_less(rows.sizes.size(), header.count)) {
    const text::Line& line = next_row(lines, 1, rows.sizes.size(), header.count, "sizes");
    require_node_fields(lines, header);
    rows.places.ids.push_back(FeatureId{line.integer(0)});
    rows.places.points.push_back(read_node_point<2>(line, CoordinateRule::input));
    rows.places.lines.push_back(line.number());
    rows.sizes.push_back(line.coordinate(3));
  }
  require_end(lines, "sizes");
  return rows;
}

Rows split(PointFile<3> triples) {
  Rows rows{{triples.file, std::move(triples.ids), {}, std::move(triples.lines)}, {}};
  for (const auto& [x, y, h] : triples.points) {
    rows.places.points.push_back({x, y});
    rows.sizes.push_back(h);
  }
  return rows;
}

Rows read_any(const std::string& path) {
  const std::string extension = text::extension(path);
  if (extension == ".node") return read_node_sizes(path);
  if (extension == ".csv") return split(read_csv_sizes(path));
  throw Error(ErrorCode::unknown_format,
              "sizes are read from .node and .csv, not " + text::quoted(extension), {path});
}

void require_positive(const Rows& rows) {
  const auto bad =
      std::find_if(rows.sizes.begin(), rows.sizes.end(), [](double h) { return h <= 0; });
  if (bad == rows.sizes.end()) return;
  throw Error(ErrorCode::bad_number, "a size of " + text::to_text(*bad) + ": sizes are above 0",
              rows.places.place(static_cast<std::size_t>(bad - rows.sizes.begin())));
}

}  // namespace

SizeFile read_sizes(const std::string& path) {
  const Rows rows = read_any(path);
  require_distinct_ids(rows.places);
  require_distinct_points(rows.places);
  require_positive(rows);
  SizeFile file{path, {}, {}};
  for (std::size_t i = 0; i < rows.sizes.size(); ++i) {
    file.samples.push_back({rows.places.points[i], rows.sizes[i]});
    file.positions.push_back({rows.places.lines[i], 1});
  }
  return file;
}

}  // namespace mesher
