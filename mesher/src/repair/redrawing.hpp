// How redraw() goes: lines by id lead along rods; a rod belongs to the first that leads along it.
#pragma once

#include <cstdint>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "repair/redraw.hpp"

namespace mesher::detail {

/// One use: redraw() takes what it has made along.
class Redrawing {
 public:
  Redrawing(const GraphFile<2>& file, const Drawing& drawing, const std::vector<Spot>& spots,
            const std::vector<std::size_t>& keepers);
  Repaired<2> redraw();

 private:
  struct Line {
    LineId id{};
    std::int64_t marker = 0;
    std::vector<PointId> points;
    FilePosition position;
    bool segment = false;
    std::vector<std::vector<Spot>> runs;  // along rods of its own, gaps between them
    bool ring = false;
  };
  static constexpr std::uint32_t kNobody = ~std::uint32_t{0};

  // A point that was not there: the lines through it, and what the first of these makes it.
  struct NewPoint {
    PointId id{};
    std::int64_t marker = 0;
    std::vector<double> attributes;
    FileLocation place;
    std::set<LineId> lines;
  };

  [[nodiscard]] bool is_new(Spot s) const { return s >= keepers_.size(); }
  [[nodiscard]] NewPoint& news(Spot s) { return news_[s - keepers_.size()]; }
  [[nodiscard]] PointId id(Spot s) {
    return is_new(s) ? news(s).id : file_.graph.points[keepers_[s]].id;
  }
  [[nodiscard]] FileLocation place(const Line& line) const {
    return {file_.file, line.position.line, line.position.column};
  }
  void note(RepairKind kind, std::vector<LineId> lines, std::vector<PointId> points, Spot at,
            FileLocation place) {
    out_.notes.push_back(
        {kind, std::move(lines), std::move(points), drawing_.place(at), std::move(place)});
  }

  [[nodiscard]] static std::vector<Line> lines_of(const GraphFile<2>& f);
  void merge_points();
  void draw_lines();
  void draw(std::uint32_t line);
  void lead_through(const Line& line, std::size_t from, std::size_t to, Spot s);
  void step(std::uint32_t line, Spot from, Spot to, bool& is_open);
  void close_ring(Line& line);
  void add_new_points();
  void keep(const Line& line);
  void rename_rest(const Line& line);
  void add(LineId id, const Line& line, const std::vector<Spot>& run, bool as_segment);
  void copy_rest();
  void sort_notes();

  const GraphFile<2>& file_;
  const Drawing& drawing_;
  const std::vector<Spot>& spots_;
  const std::vector<std::size_t>& keepers_;
  std::unordered_map<PointId, std::size_t> by_id_;
  std::vector<Line> lines_;
  std::vector<std::uint32_t> order_;                        // lines by id
  std::vector<std::uint32_t> owners_;                       // of rods, in lines_
  std::set<std::pair<std::uint32_t, std::uint32_t>> lost_;  // of this line, to that
  std::vector<NewPoint> news_;
  std::int64_t last_line_ = 0;
  Repaired<2> out_;
};

}  // namespace mesher::detail
