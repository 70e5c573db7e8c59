// Reads `.node` files (Triangle, TetGen).
//
//   # comment
//   count [dimension [attributes [markers]]]
//   id x y [z] [attributes...] [marker]
#include "io/read_node.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "io/rows.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

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

// What a mesh file says of its vertices beside their places, row by row.
class VertexColumns {
 public:
  explicit VertexColumns(const NodeHeader& header)
      : has_markers_(header.markers == 1),
        attributes_(static_cast<std::size_t>(header.attributes)),
        ours_(has_markers_ && (attributes_ == 1 || attributes_ == 2)) {}

  void add(const text::Line& line) {
    if (has_markers_) markers_.push_back(line.integer(line.size() - 1));
    if (attributes_ > 0 && first_.file.empty()) first_ = line.place(3);
    if (ours_ && attributes_ == 1) ours_ = add_kind(line);
    if (ours_ && attributes_ == 2) ours_ = add_kind_and_origin(line);
  }

  // A marker of a plain file that only says "boundary grid" is told by the kind.
  template <int D>
  void give(NodeFile<D>& nodes) {
    const std::size_t n = nodes.rows.ids.size();
    if (ours_) {
      nodes.kinds = std::move(kinds_);
      nodes.origins = std::move(origins_);
    } else {
      nodes.kinds.assign(n, VertexKind::steiner);
      if (attributes_ > 0 && n > 0) nodes.notes.push_back({"attributes are not used", first_});
    }
    if (!ours_ || attributes_ == 2 || !markers_say_kind(nodes.kinds)) {
      nodes.markers = std::move(markers_);
    }
  }

 private:
  // Whether the attribute and the marker can say "input point" and "boundary grid".
  bool add_kind(const text::Line& line) {
    const std::string_view input = line[line.size() - 2], boundary = line[line.size() - 1];
    const auto is_one = [](std::string_view field) { return field == "1"; };
    if ((input != "0" && !is_one(input)) || (boundary != "0" && !is_one(boundary))) return false;
    if (is_one(input) && is_one(boundary)) return false;
    kinds_.push_back(is_one(input)      ? VertexKind::input
                     : is_one(boundary) ? VertexKind::boundary
                                        : VertexKind::steiner);
    return true;
  }

  // Whether the two attributes can be a kind and an id.
  bool add_kind_and_origin(const text::Line& line) {
    const std::string_view kind = line[line.size() - 3];
    const std::string_view origin = line[line.size() - 2];
    if (kind.size() != 1 || kind[0] < '0' || kind[0] > '3') return false;
    if (origin.find_first_not_of("-0123456789") != std::string_view::npos) return false;
    kinds_.push_back(static_cast<VertexKind>(kind[0] - '0'));
    origins_.emplace_back(FeatureKind::none, line.integer(line.size() - 2));
    return true;
  }

  [[nodiscard]] bool markers_say_kind(const std::vector<VertexKind>& kinds) const {
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      if (markers_[i] != (kinds[i] == VertexKind::boundary ? 1 : 0)) return false;
    }
    return true;
  }

  bool has_markers_;
  std::size_t attributes_;
  bool ours_;  // as far as the rows have shown
  std::vector<VertexKind> kinds_;
  std::vector<Feature> origins_;
  std::vector<std::int64_t> markers_;
  FileLocation first_;
};

}  // namespace

NodeHeader read_node_header(const text::Line& line, int dimension) {
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
void require_node_fields(const text::FieldLines& lines, const NodeHeader& header) {
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

// What a header says may be wrong: a field is a digit and a blank at least.
std::size_t most_rows(const NodeHeader& header, std::size_t bytes) {
  return std::min(static_cast<std::size_t>(header.count), bytes / (2 * header.fields()));
}

template <int D>
NodeFile<D> read_node(const text::Share& share, CoordinateRule rule) {
  text::FieldLines lines(share);
  const NodeHeader header = read_node_header(header_row(lines, share.file), D);
  VertexColumns columns(header);
  NodeFile<D> nodes;
  nodes.rows.file = share.file;
  const std::size_t most = most_rows(header, share.lines.size());
  nodes.rows.ids.reserve(most);
  nodes.rows.points.reserve(most);
  nodes.rows.lines.reserve(most);
  const auto rows = [&] { return share.rows_before + nodes.rows.ids.size(); };
  FilePosition end = lines.line().position(lines.line().size());  // of what has been read
  while (lines.next()) {
    const text::Line& line = lines.line();
    if (std::cmp_greater_equal(rows(), header.count)) {
      throw line.error(ErrorCode::wrong_count,
                       "more points than the " + std::to_string(header.count) + " of the header",
                       0);
    }
    require_node_fields(lines, header);
    nodes.rows.ids.push_back(PointId{line.integer(0)});
    nodes.rows.points.push_back(read_node_point<D>(line, rule));
    nodes.rows.lines.push_back(line.number());
    end = line.position(line.size());
    if (rule == CoordinateRule::finite) {
      columns.add(line);
    } else if (header.markers == 1) {
      nodes.markers.push_back(line.integer(line.size() - 1));
    }
  }
  if (!share.is_followed && std::cmp_less(rows(), header.count)) {
    throw Error(ErrorCode::truncated,
                "the file ends after " + std::to_string(rows()) + " of " +
                    std::to_string(header.count) + " points",
                {share.file, end.line, end.column});
  }
  if (rule == CoordinateRule::finite) columns.give(nodes);
  return nodes;
}

template NodeFile<2> read_node<2>(const text::Share&, CoordinateRule);
#ifndef MESHER_PLANE_ONLY
template NodeFile<3> read_node<3>(const text::Share&, CoordinateRule);
#endif

}  // namespace mesher
