// Twins by their places: all of one side are moved, and found on the other.
#include "facade/twin_lines.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "sets/make_set.hpp"

namespace mesher::detail {
namespace {

// Of the largest coordinate: how far a vertex may be off its line to be on it [check_mesh (b)].
constexpr double kRounding = 0x1p-48;

Error no_twins(std::string text, std::vector<mesher::Feature> features = {},
               std::vector<Position> places = {}) {
  return {ErrorCode::bad_option,
          "periodic sides: " + std::move(text),
          {},
          std::move(features),
          std::move(places)};
}

std::string text_of(const PeriodicMarkers& pair) {
  return std::to_string(pair.from) + "=" + std::to_string(pair.to);
}

void require_own_markers(const std::vector<PeriodicMarkers>& pairs) {
  std::set<std::int64_t> seen;
  for (const PeriodicMarkers& pair : pairs) {
    for (const std::int64_t marker : {pair.from, pair.to}) {
      if (marker == 0) throw no_twins("0 is no marker");
      if (!seen.insert(marker).second) {
        throw no_twins("the marker " + std::to_string(marker) + " is named twice");
      }
    }
  }
}

std::vector<LinePiece> pieces_of(const Graph<2>& graph, std::int64_t marker) {
  std::vector<LinePiece> pieces;
  for (const mesher::Segment& s : graph.segments) {
    if (s.marker == marker) pieces.push_back({s.id, 0, s.from, s.to});
  }
  for (const Polyline& l : graph.polylines) {
    if (l.marker != marker) continue;
    for (std::size_t i = 1; i < l.points.size(); ++i) {
      pieces.push_back({l.id, i - 1, l.points[i - 1], l.points[i]});
    }
  }
  if (pieces.empty()) throw no_twins("no line has the marker " + std::to_string(marker));
  return pieces;
}

// The points of one side.
class Side {
 public:
  Side(const std::vector<LinePiece>& pieces, const Places& places) {
    std::vector<PointId> ids;
    for (const LinePiece& piece : pieces) {
      for (const PointId id : {piece.from, piece.to}) {
        if (!places.contains(id)) {
          throw Error(ErrorCode::unknown_id,
                      mesher::text_of(piece.line) + ": " + mesher::text_of(id) + " is not there",
                      {}, {piece.line, id});
        }
        ids.push_back(id);
      }
    }
    make_set(ids);
    for (const PointId id : ids) points_.emplace_back(places.at(id), id);
    std::sort(points_.begin(), points_.end());
  }

  [[nodiscard]] std::size_t size() const { return points_.size(); }
  [[nodiscard]] Point<2> low() const {
    Point<2> low = points_.front().first;
    for (const auto& [p, id] : points_) low[1] = std::min(low[1], p[1]);
    return low;
  }
  [[nodiscard]] double largest() const {
    double most = 0;
    for (const auto& [p, id] : points_) most = std::max({most, std::abs(p[0]), std::abs(p[1])});
    return most;
  }
  // The point at a place, up to rounding.
  [[nodiscard]] std::optional<PointId> at(const Point<2>& p, double rounding) const {
    auto it = std::lower_bound(points_.begin(), points_.end(), p[0] - rounding,
                               [](const auto& point, double x) { return point.first[0] < x; });
    for (; it != points_.end() && it->first[0] <= p[0] + rounding; ++it) {
      if (std::abs(it->first[1] - p[1]) <= rounding) return it->second;
    }
    return std::nullopt;
  }
  [[nodiscard]] const std::vector<std::pair<Point<2>, PointId>>& points() const { return points_; }

 private:
  std::vector<std::pair<Point<2>, PointId>> points_;  // ascending
};

std::map<PointId, PointId> twin_points(const PeriodicMarkers& pair, const Side& from,
                                       const Side& to, const Point<2>& by) {
  const double rounding = kRounding * std::max(from.largest(), to.largest());
  std::map<PointId, PointId> twins;
  std::set<PointId> taken;
  for (const auto& [p, id] : from.points()) {
    const auto twin = to.at({p[0] + by[0], p[1] + by[1]}, rounding);
    if (twin && taken.insert(*twin).second) {
      twins.emplace(id, *twin);
      continue;
    }
    throw no_twins(mesher::text_of(id) + ", moved as the pair " + text_of(pair) +
                       " says, is no point of a line of marker " + std::to_string(pair.to),
                   {id}, {position_of(p)});
  }
  if (twins.size() == to.size()) return twins;
  throw no_twins("lines of marker " + std::to_string(pair.to) + " have " +
                 std::to_string(to.size()) + " points, those of marker " +
                 std::to_string(pair.from) + " " + std::to_string(twins.size()));
}

TwinLines twins_of(const Graph<2>& graph, const Places& places, const PeriodicMarkers& pair) {
  const auto pieces = pieces_of(graph, pair.from), others = pieces_of(graph, pair.to);
  const Side from(pieces, places), to(others, places);
  const Point<2> low = from.low(), other_low = to.low();
  TwinLines twins{pair, {other_low[0] - low[0], other_low[1] - low[1]}, {}};
  if (twins.translation == Point<2>{0, 0}) {
    throw no_twins("lines of the markers " + text_of(pair) +
                   " have one lowest corner: nothing is moved");
  }
  const auto points = twin_points(pair, from, to, twins.translation);
  std::map<std::pair<PointId, PointId>, LinePiece> by_ends;
  for (const LinePiece& b : others) by_ends.emplace(std::minmax(b.from, b.to), b);
  for (const LinePiece& a : pieces) {
    const PointId start = points.at(a.from), end = points.at(a.to);
    const auto found = by_ends.find(std::minmax(start, end));
    if (found == by_ends.end()) {
      throw no_twins(mesher::text_of(a.line) + ", moved as the pair " + text_of(pair) +
                         " says, is no line of marker " + std::to_string(pair.to),
                     {a.line}, {position_of(places.at(a.from))});
    }
    twins.pieces.push_back({a, found->second, found->second.from != start});
    by_ends.erase(found);
  }
  if (by_ends.empty()) return twins;
  const LineId rest = by_ends.begin()->second.line;
  throw no_twins(mesher::text_of(rest) + " is no line of marker " + std::to_string(pair.from) +
                     ", moved as the pair " + text_of(pair) + " says",
                 {rest});
}

}  // namespace

std::vector<TwinLines> twin_lines(const Graph<2>& graph, const Places& places,
                                  const std::vector<PeriodicMarkers>& pairs) {
  require_own_markers(pairs);
  std::vector<TwinLines> all;
  for (const PeriodicMarkers& pair : pairs) all.push_back(twins_of(graph, places, pair));
  return all;
}

}  // namespace mesher::detail
