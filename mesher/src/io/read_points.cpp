// Reads input points of any known format and refuses repeated ids and points.
#include "io/read_points.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "io/read_node.hpp"
#include "io/text.hpp"

namespace mesher {
namespace {

// Two rows of a file with equal keys; the later one is the first in the file to repeat an earlier.
struct Repeat {
  std::size_t earlier;
  std::size_t later;
};

// Nothing where all keys differ. Cost: O(n log n), O(n) where keys ascend.
template <class Key>
std::optional<Repeat> first_repeat(const std::vector<Key>& keys) {
  if (std::adjacent_find(keys.begin(), keys.end(), std::greater_equal<>()) == keys.end()) {
    return {};
  }
  std::vector<std::pair<Key, std::size_t>> order;
  order.reserve(keys.size());
  for (const Key& key : keys) order.emplace_back(key, order.size());
  std::sort(order.begin(), order.end());
  std::optional<Repeat> first;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (order[i - 1].first != order[i].first) continue;
    const Repeat repeat{order[i - 1].second, order[i].second};
    if (!first || repeat.later < first->later) first = repeat;
  }
  return first;
}

std::string id_text(FeatureId id) { return std::to_string(static_cast<std::int64_t>(id)); }

// Where there are lines.
template <int D>
std::string line_text(const PointFile<D>& rows, std::size_t i) {
  return rows.lines[i] > 0 ? " of line " + std::to_string(rows.lines[i]) : "";
}

template <int D>
using Read = PointFile<D> (*)(const std::string&);
template <int D>
using Readers = std::vector<std::pair<std::string_view, Read<D>>>;

template <int D>
PointFile<D> read_node_rows(const std::string& path) {
  return read_node<D>(path, CoordinateRule::input).rows;
}

template <int D>
Readers<D> readers() {
  return {{".node", read_node_rows<D>}, {".xyz", read_xyz<D>}, {".csv", read_csv<D>}};
}

template <>
Readers<3> readers() {
  return {{".node", read_node_rows<3>}, {".xyz", read_xyz<3>},     {".csv", read_csv<3>},
          {".off", read_off_points},    {".obj", read_obj_points}, {".ply", read_ply_points},
          {".stl", read_stl_points},    {".vtu", read_vtu_points}, {".vtk", read_vtk_points}};
}

template <int D>
PointFile<D> read_any(const std::string& path) {
  const std::string extension = text::extension(path);
  std::string known;
  for (const auto& [name, read] : readers<D>()) {
    if (extension == name) return read(path);
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  throw Error(ErrorCode::unknown_format,
              std::string(D == 3 ? "points in space" : "points") + " are read from " + known +
                  ", not " + text::quoted(extension),
              {path});
}

}  // namespace

void add_vertex(PointFile<3>& rows, Point<3> point, const Place& place) {
  for (double& x : point) {
    x += 0.0;  // no negative zero
    if (text::is_coordinate(x)) continue;
    throw Error(ErrorCode::magnitude,
                "point " + std::to_string(rows.points.size() + 1) + " at " +
                    text::to_text<3>(point) +
                    ": a coordinate is neither 0 nor of magnitude 2^-100 to 2^100",
                place);
  }
  add_row<3>(rows, point, place.line);
}

template <int D>
void require_distinct_ids(const PointFile<D>& rows) {
  const auto repeat = first_repeat(rows.ids);
  if (!repeat) return;
  throw Error(ErrorCode::repeated_id,
              "id " + id_text(rows.ids[repeat->later]) + " is given twice, first on line " +
                  std::to_string(rows.lines[repeat->earlier]),
              rows.place(repeat->later));
}

template <int D>
void require_distinct_points(const PointFile<D>& rows) {
  const auto repeat = first_repeat(rows.points);
  if (!repeat) return;
  throw Error(ErrorCode::duplicate_point,
              "point " + id_text(rows.ids[repeat->later]) + " lies on point " +
                  id_text(rows.ids[repeat->earlier]) + line_text(rows, repeat->earlier) +
                  ", both at " + text::to_text<D>(rows.points[repeat->later]),
              rows.place(repeat->later));
}

template <int D>
PointFile<D> read_points(const std::string& path) {
  PointFile<D> rows = read_any<D>(path);
  require_distinct_ids(rows);
  require_distinct_points(rows);
  return rows;
}

template void require_distinct_ids<2>(const PointFile<2>&);
template void require_distinct_points<2>(const PointFile<2>&);
template PointFile<2> read_points<2>(const std::string&);
template PointFile<3> read_points<3>(const std::string&);

}  // namespace mesher
