// The readers of single formats behind read(), and what they share.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/note_counter.hpp"
#include "io/poly_tables.hpp"
#include "mesher/graph.hpp"

namespace mesher {

/// Throws: Error as read(), but ids and ends are not looked at.
[[nodiscard]] GraphFile<2> read_poly(const std::string& path, PointsBeside beside);
/// Throws: Error as read(); ids and ends are right by the way they come about.
[[nodiscard]] GraphFile<2> read_geojson(const std::string& path);
[[nodiscard]] GraphFile<2> read_obj_lines(const std::string& path);
[[nodiscard]] GraphFile<2> read_vtu_lines(const std::string& path);

/// A name of a group, "" for none, and where it is.
struct NameInFile {
  std::string text;
  FileLocation place;
};

/// A graph in the making, for formats without ids: numbers points and lines from 1.
class PslgBuilder {
 public:
  explicit PslgBuilder(const std::string& file) { out_.file = out_.point_file = file; }

  /// Adds a point, whatever lies there.
  PointId add_point(const Point<2>& at, std::int64_t marker, FilePosition position);
  /// The point at these coordinates, added if it is the first; it gets `marker` if it has none.
  PointId point_at(const Point<2>& at, std::int64_t marker, FilePosition position);
  /// Adds a line of two or more points: two are a segment, more a polyline.
  LineId add_line(std::vector<PointId> points, std::int64_t marker, FilePosition position);
  void add_hole(const Point<2>& at, FilePosition position);
  void add_region(const Point<2>& at, double attribute, std::optional<double> max_area,
                  FilePosition position);

  /// Name what has a marker, or a region.
  void name_marker(std::int64_t marker, const NameInFile& name);
  void name_region(double attribute, const NameInFile& name);

  /// Notes that something is not used.
  void note(const std::string& what, const FileLocation& place) { notes_.add(what, place); }

  [[nodiscard]] GraphFile<2> finish();

 private:
  GraphFile<2> out_;
  std::int64_t lines_ = 0, holes_ = 0, regions_ = 0;
  std::map<Point<2>, std::size_t> at_;  // positions in out_.graph.points
  NoteCounter notes_;
};

}  // namespace mesher
