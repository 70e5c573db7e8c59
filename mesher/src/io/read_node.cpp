// Reads `.node` files (Triangle, TetGen).
//
//   # comment
//   count [dimension [attributes [markers]]]
//   id x y [z] [attributes...] [marker]
#include "io/read_node.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "io/text.hpp"

namespace mesher {
namespace {

struct NodeHeader {
  std::int64_t count = 0;
  std::int64_t dimension = 2;
  std::int64_t attributes = 0;
  std::int64_t markers = 0;

  // Fields of a row: the id, the coordinates, and the rest. Requires: all parts in range.
  [[nodiscard]] std::size_t fields() const {
    return static_cast<std::size_t>(1 + dimension + attributes + markers);
  }
};

// A header's number. Throws: Error(bad_header) beyond lowest..highest.
std::int64_t header_number(const text::Line& line, std::size_t i, const char* what,
                           std::int64_t highest) {
  const std::int64_t value = line.integer(i);
  if (value >= 0 && value <= highest) return value;
  throw line.error(ErrorCode::bad_header,
                   std::string(what) + " " + std::to_string(value) + " is not within 0 to " +
                       std::to_string(highest),
                   i);
}

NodeHeader read_header(const text::Line& line, int dimension) {
  constexpr std::int64_t kMostAttributes = 1 << 20;  // a row of more would be megabytes long
  NodeHeader header;
  if (line.size() > 4) {
    throw line.error(ErrorCode::bad_header,
                     "the header is 'count dimension attributes markers', four numbers at most", 4);
  }
  header.count = header_number(line, 0, "count", INT64_MAX);
  if (line.size() > 1) header.dimension = line.integer(1);
  if (header.dimension != dimension) {
    throw line.error(ErrorCode::bad_dimension,
                     "points of dimension " + std::to_string(header.dimension) + ", expected " +
                         std::to_string(dimension),
                     1);
  }
  if (line.size() > 2) header.attributes = header_number(line, 2, "attributes", kMostAttributes);
  if (line.size() > 3) header.markers = header_number(line, 3, "markers", 1);
  return header;
}

// A row that is too short is the file's end where nothing follows, and a mistake elsewhere.
void require_fields(const text::FieldLines& lines, const NodeHeader& header) {
  const text::Line& line = lines.line();
  if (line.size() == header.fields()) return;
  const bool cut = line.size() < header.fields() && lines.at_end();
  throw line.error(cut ? ErrorCode::truncated : ErrorCode::wrong_count,
                   std::to_string(line.size()) + " fields, but the header asks for " +
                       std::to_string(header.fields()) + " (id, " +
                       std::to_string(header.dimension) + " coordinates, " +
                       std::to_string(header.attributes) + " attributes, " +
                       std::to_string(header.markers) + " markers)",
                   std::min(line.size(), header.fields()));
}

template <int D>
Point<D> read_point(const text::Line& line, CoordinateRule rule) {
  Point<D> point;
  for (int i = 0; i < D; ++i) {
    point[i] = rule == CoordinateRule::input ? line.coordinate(i + 1) : line.finite(i + 1);
  }
  return point;
}

// Requires: a row with one attribute and a marker, as write_mesh writes it.
VertexKind read_kind(const text::Line& line) {
  if (line[line.size() - 2] == "1") return VertexKind::input;
  return line[line.size() - 1] == "1" ? VertexKind::boundary : VertexKind::steiner;
}

}  // namespace

template <int D>
NodeFile<D> read_node(const std::string& path, CoordinateRule rule) {
  const std::string content = text::read_file(path);
  text::FieldLines lines(path, content);
  if (!lines.next()) throw Error(ErrorCode::truncated, "no header: the file is empty", {path});
  const NodeHeader header = read_header(lines.line(), D);
  const bool has_kinds = header.attributes == 1 && header.markers == 1;
  NodeFile<D> nodes;
  nodes.rows.file = path;
  while (lines.next()) {
    const text::Line& line = lines.line();
    if (std::cmp_equal(nodes.rows.ids.size(), header.count)) {
      throw line.error(ErrorCode::wrong_count,
                       "more points than the " + std::to_string(header.count) + " of the header",
                       0);
    }
    require_fields(lines, header);
    nodes.rows.ids.push_back(FeatureId{line.integer(0)});
    nodes.rows.points.push_back(read_point<D>(line, rule));
    nodes.rows.lines.push_back(line.number());
    nodes.kinds.push_back(has_kinds ? read_kind(line) : VertexKind::steiner);
  }
  if (std::cmp_less(nodes.rows.ids.size(), header.count)) {
    throw lines.line().error(ErrorCode::truncated,
                             "the file ends after " + std::to_string(nodes.rows.ids.size()) +
                                 " of " + std::to_string(header.count) + " points",
                             lines.line().size());
  }
  return nodes;
}

template NodeFile<2> read_node<2>(const std::string&, CoordinateRule);
template NodeFile<3> read_node<3>(const std::string&, CoordinateRule);

}  // namespace mesher
