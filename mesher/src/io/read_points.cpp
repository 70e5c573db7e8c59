// Reads input points of any known format and refuses repeated ids and points.
#include "io/read_points.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "io/line_points.hpp"
#include "io/read_node.hpp"
#include "io/rows.hpp"
#include "mesher/read.hpp"
#include "sets/counting_sort.hpp"
#include "text/id_text.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

// A row by a hash of its key.
struct Hashed {
  std::uint64_t hash;
  std::size_t row;
};

// Nothing where all keys differ. Cost: O(n) expected.
template <class Key>
std::optional<Repeat> first_repeat(const std::vector<Key>& keys) {
  if (std::adjacent_find(keys.begin(), keys.end(), std::greater_equal<>()) == keys.end()) {
    return {};
  }
  std::vector<Hashed> order(keys.size());
  for (std::size_t row = 0; row < keys.size(); ++row) order[row] = {row_hash(keys[row]), row};
  detail::sort_spread(
      order, [](const Hashed& h) { return h.hash; },
      [&](const Hashed& a, const Hashed& b) {
        if (a.hash != b.hash) return a.hash < b.hash;
        return std::tie(keys[a.row], a.row) < std::tie(keys[b.row], b.row);
      });
  std::optional<Repeat> first;
  for (std::size_t i = 1; i < order.size(); ++i) {
    const Repeat repeat{order[i - 1].row, order[i].row};
    if (order[i - 1].hash != order[i].hash || keys[repeat.earlier] != keys[repeat.later]) continue;
    if (!first || repeat.later < first->later) first = repeat;
  }
  return first;
}

// Where there are lines.
template <int D>
std::string line_text(const PointFile<D>& rows, std::size_t i) {
  return rows.lines[i] > 0 ? " of line " + std::to_string(rows.lines[i]) : "";
}

template <int D>
using ReadPoints = PointFile<D> (*)(const std::string&);
template <int D>
using PointReaders = std::vector<std::pair<std::string_view, ReadPoints<D>>>;

template <int D>
PointFile<D> read_node_rows(const std::string& path) {
  return read_node<D>(text::whole_file(path), CoordinateRule::input).rows;
}
template <int D>
PointFile<D> read_xyz_rows(const std::string& path) {
  return read_xyz<D>(text::whole_file(path));
}
template <int D>
PointFile<D> read_csv_rows(const std::string& path) {
  return read_csv<D>(text::whole_file(path));
}

template <int D>
PointReaders<D> readers() {
  return {{".node", read_node_rows<D>}, {".xyz", read_xyz_rows<D>}, {".csv", read_csv_rows<D>}};
}

#ifndef MESHER_PLANE_ONLY
template <>
PointReaders<3> readers() {
  return {{".node", read_node_rows<3>}, {".xyz", read_xyz_rows<3>}, {".csv", read_csv_rows<3>},
          {".off", read_off_points},    {".obj", read_obj_points},  {".ply", read_ply_points},
          {".stl", read_stl_points},    {".vtu", read_vtu_points},  {".vtk", read_vtk_points}};
}
#endif

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

// Once for a file.
void note_rounded(PointFile<3>& rows, const FileLocation& place) {
  const std::string what = "a coordinate below 2^-100 is taken as 0";
  for (const Note& note : rows.notes) {
    if (note.text == what) return;
  }
  rows.notes.push_back({what, place});
}

}  // namespace

void add_vertex(PointFile<3>& rows, Point<3> point, const FileLocation& place) {
  for (double& x : point) {
    x += 0.0;  // no negative zero
    if (text::is_coordinate(x)) continue;
    if (without_noise(x) == 0) {
      x = 0;
      note_rounded(rows, place);
      continue;
    }
    throw Error(ErrorCode::magnitude,
                "point " + std::to_string(rows.points.size() + 1) + " at " +
                    text::to_text<3>(point) + ": a coordinate is beyond 2^100",
                place);
  }
  add_row<3>(rows, point, place.line);
}

template <int D>
void fail_repeated_id(const PointFile<D>& rows, Repeat repeat) {
  throw Error(ErrorCode::repeated_id,
              "id " + id_text(rows.ids[repeat.later]) + " is given twice, first on line " +
                  std::to_string(rows.lines[repeat.earlier]),
              rows.location(repeat.later), {mesher::Feature(rows.ids[repeat.later])});
}

template <int D>
void fail_duplicate_point(const PointFile<D>& rows, Repeat repeat) {
  throw Error(ErrorCode::duplicate_point,
              "point " + id_text(rows.ids[repeat.later]) + " lies on point " +
                  id_text(rows.ids[repeat.earlier]) + line_text(rows, repeat.earlier) +
                  ", both at " + text::to_text<D>(rows.points[repeat.later]),
              rows.location(repeat.later),
              {mesher::Feature(rows.ids[repeat.later]), mesher::Feature(rows.ids[repeat.earlier])},
              {position_of(rows.points[repeat.later])})
      .with_locations({rows.location(repeat.later), rows.location(repeat.earlier)});
}

template <int D>
void require_distinct_ids(const PointFile<D>& rows) {
  if (const auto repeat = first_repeat(rows.ids)) fail_repeated_id(rows, *repeat);
}

template <int D>
void require_distinct_points(const PointFile<D>& rows) {
  if (const auto repeat = first_repeat(rows.points)) fail_duplicate_point(rows, *repeat);
}

template <int D>
PointFile<D> read_points(const std::string& path, CoincidingPoints coinciding) {
  PointFile<D> rows = read_any<D>(path);
  require_indexable(rows.points.size(), path);
  require_distinct_ids(rows);
  if (coinciding == CoincidingPoints::refused) require_distinct_points(rows);
  return rows;
}

template void fail_repeated_id(const PointFile<2>&, Repeat);
template void fail_duplicate_point(const PointFile<2>&, Repeat);
template void require_distinct_ids<2>(const PointFile<2>&);
template void require_distinct_points<2>(const PointFile<2>&);
template PointFile<2> read_points<2>(const std::string&, CoincidingPoints);
#ifndef MESHER_PLANE_ONLY
template void fail_repeated_id(const PointFile<3>&, Repeat);
template void fail_duplicate_point(const PointFile<3>&, Repeat);
template PointFile<3> read_points<3>(const std::string&, CoincidingPoints);
#endif

}  // namespace mesher
