// The readers of single formats behind read_pslg, and what they share.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/note_counter.hpp"
#include "io/poly_tables.hpp"
#include "mesher/pslg.hpp"

namespace mesher {

/// Throws: Error as read_pslg, but ids and ends are not looked at.
[[nodiscard]] PslgFile read_poly(const std::string& path, PointsBeside beside);
/// Throws: Error as read_pslg; ids and ends are right by the way they come about.
[[nodiscard]] PslgFile read_geojson(const std::string& path);
[[nodiscard]] PslgFile read_obj_lines(const std::string& path);
[[nodiscard]] PslgFile read_vtu_lines(const std::string& path);

/// A graph in the making, for formats without ids: numbers points and lines from 1.
class PslgBuilder {
 public:
  explicit PslgBuilder(const std::string& file) { out_.file = out_.point_file = file; }

  /// Adds a point, whatever lies there.
  FeatureId add_point(const Point<2>& at, std::int64_t marker, FilePosition position);
  /// The point at these coordinates, added if it is the first; it gets `marker` if it has none.
  FeatureId point_at(const Point<2>& at, std::int64_t marker, FilePosition position);
  /// Adds a line of two or more points: two are a segment, more a polyline.
  FeatureId add_line(std::vector<FeatureId> points, std::int64_t marker, FilePosition position);
  void add_hole(const Point<2>& seed, FilePosition position);
  void add_region(const Point<2>& seed, double attribute, std::optional<double> max_area,
                  FilePosition position);

  /// Notes that something is not used.
  void note(const std::string& what, const FileLocation& place) { notes_.add(what, place); }

  [[nodiscard]] PslgFile finish();

 private:
  PslgFile out_;
  std::int64_t lines_ = 0;
  std::map<Point<2>, std::size_t> at_;  // positions in out_.pslg.points
  NoteCounter notes_;
};

}  // namespace mesher
