// How redraw() goes: lines by id lead along pieces between points; a piece belongs to the first
// that leads along it. A point that was not there has an id if somebody leads through it.
//
// The same in the plane and in space but for two things. In the plane a line is run after run of
// pieces, and the attributes of a new point are those of the line through it; in space each piece
// is a segment of its own, and a new point may lie in polygons alone: its attributes are those of
// the edge that it was made on. What becomes of polygons is in space_redrawing.hpp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "repair/redraw.hpp"

namespace mesher::detail {

/// The next id after the last one, which it is then. Throws: Error(too_many).
[[nodiscard]] std::int64_t next_number(std::int64_t& last);
template <class Id>
[[nodiscard]] Id next_id(std::int64_t& last) {
  return Id{next_number(last)};
}

/// One use: redraw() takes what it has made along.
template <int D>
class Redrawing {
 public:
  Redrawing(const GraphFile<D>& file, const Drawing<D>& drawing, const Drawn<D>& drawn);
  virtual ~Redrawing() = default;
  Redrawing(const Redrawing&) = delete;
  Redrawing& operator=(const Redrawing&) = delete;

  Repaired<D> redraw();

 protected:
  // A point that was not there: who leads through it, and what the first of these makes it, lines
  // before polygons.
  struct NewPoint {
    PointId id{};
    std::int64_t marker = 0;
    std::vector<double> attributes;
    FileLocation location;
    std::set<LineId> lines;
    std::set<PolygonId> polygons;

    [[nodiscard]] bool is_used() const noexcept { return !lines.empty() || !polygons.empty(); }
  };

  // In space: which new points polygons have, and what becomes of polygons.
  virtual void look_at_new_points() {}
  virtual void draw_polygons() {}

  [[nodiscard]] NewPoint& news(Spot s) {
    return news_[drawn_.number_of(s) - drawn_.keepers.size()];
  }
  [[nodiscard]] PointId id(Spot s) {
    return drawn_.is_new(s) ? news(s).id : file_.graph.points[drawn_.keeper(s)].id;
  }
  [[nodiscard]] const Point<D>& place(Spot s) const { return drawing_.place(s); }
  // Where a point of the file was.
  [[nodiscard]] const Point<D>& place_of(PointId id) const {
    return file_.graph.points[drawn_.by_id.at(id)].at;
  }
  // Of the i-th point of the file.
  [[nodiscard]] std::span<const double> attributes_of(std::size_t i) const {
    const std::size_t n = file_.graph.attributes_per_point;
    return std::span(file_.graph.attributes).subspan(i * n, n);
  }
  [[nodiscard]] std::span<const double> attributes(Spot s) {
    return drawn_.is_new(s) ? news(s).attributes : attributes_of(drawn_.keeper(s));
  }
  // Those at p, which is along ab: linear from what a has to what b has.
  [[nodiscard]] static std::vector<double> between(const Point<D>& p, const Point<D>& a,
                                                   const Point<D>& b, std::span<const double> at_a,
                                                   std::span<const double> at_b);
  RepairNote<D>& note(RepairKind kind, std::vector<LineId> lines, std::vector<PointId> points,
                      const Point<D>& at, FileLocation location) {
    out_.notes.push_back({kind, std::move(lines), std::move(points), at, std::move(location)});
    return out_.notes.back();
  }
  void deviates_by(double distance2) { out_.deviation = std::max(out_.deviation, distance2); }

  const GraphFile<D>& file_;
  const Drawing<D>& drawing_;
  const Drawn<D>& drawn_;
  std::vector<NewPoint> news_;
  Repaired<D> out_;  // the deviation squared, until it is done

 private:
  struct Line {
    LineId id{};
    std::int64_t marker = 0;
    std::vector<PointId> points;
    FilePosition position;
    bool segment = false;
    std::vector<std::vector<Spot>> runs;  // along pieces of its own, gaps between them
    bool ring = false;
  };

  [[nodiscard]] static std::vector<Line> lines_of(const GraphFile<D>& f);
  [[nodiscard]] FileLocation location(const Line& line) const {
    return {file_.file, line.position.line, line.position.column};
  }
  void merge_points();
  void add_point(PointId id, const Point<D>& at, std::int64_t marker, FilePosition position,
                 std::span<const double> attributes);
  void add_new_points();
  void draw(std::size_t rank);
  [[nodiscard]] std::vector<Spot> way(std::size_t rank, Spot from, Spot to) const;
  void lead_through(const Line& line, std::size_t from, std::size_t to, Spot s);
  void step(std::size_t line, Spot from, Spot to, bool& is_open);
  void close_ring(Line& line);
  void keep(const Line& line);
  void rename_rest(const Line& line);
  void add(LineId id, const Line& line, const std::vector<Spot>& run, bool as_segment);
  void copy_rest();
  void sort_notes();

  std::vector<Line> lines_;
  std::vector<std::size_t> order_;                         // lines by id
  std::unordered_map<std::uint64_t, std::size_t> owners_;  // of pieces, by their ends: in lines_
  std::set<std::pair<std::size_t, std::size_t>> lost_;     // of this line, to that
  std::int64_t last_line_ = 0;
};

}  // namespace mesher::detail
