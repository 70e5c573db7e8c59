// Distances from the features near an edge, one by one.
#include "check/isolated_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "check/poor_beside.hpp"
#include "geometry/cube_around.hpp"
#include "geometry/space_distances.hpp"
#include "sets/make_set.hpp"

namespace mesher::detail {

namespace {

constexpr double kRoundedLength = 1e-9;  // of lengths, in favour of the mesh

bool meet(const std::vector<PointId>& a, const std::vector<PointId>& b) {
  return std::any_of(a.begin(), a.end(),
                     [&](PointId x) { return std::binary_search(b.begin(), b.end(), x); });
}

}  // namespace

IsolatedEdges::IsolatedEdges(const Graph<3>& complex)
    : cube_(cube_around<3>(places_of(complex))), tree_(cube_) {
  std::map<PointId, Point<3>> at;
  for (const auto& p : complex.points) at[p.id] = p.at;
  const auto corner = [&](PointId id) { return Corner{id, at.at(id)}; };
  std::map<std::vector<PointId>, Beside> lines;  // by their ends
  const auto line = [&](PointId a, PointId b, const Beside& name) {
    lines.try_emplace({std::min(a, b), std::max(a, b)}, name);
    return std::array{corner(a), corner(b)};
  };
  for (const auto& s : segments_of(complex)) line(s.from, s.to, s.id);
  std::vector<Feature> polygons;
  for (const mesher::Polygon& f : complex.polygons) {
    Feature polygon;
    polygon.kind = Kind::polygon;
    polygon.name = f.id;
    polygon.points = f.points;
    std::vector<std::vector<Point<3>>> places;
    for (const auto& loop : f.loops) {
      auto& corners = places.emplace_back();
      for (std::size_t i = 0; i < loop.size(); ++i) {
        polygon.lines.push_back(line(loop[i], loop[(i + 1) % loop.size()], polygon.name));
        corners.push_back(at.at(loop[i]));
      }
    }
    for (const auto& [a, b] : f.edges) polygon.lines.push_back(line(a, b, polygon.name));
    for (const PointId id : f.points) polygon.others.push_back(corner(id));
    for (const auto& [a, b] : polygon.lines)
      polygon.points.insert(polygon.points.end(), {a.id, b.id});
    make_set(polygon.points);
    polygon.shape.emplace(places);
    polygons.push_back(std::move(polygon));
  }
  for (const auto& [ends, name] : lines) {
    add(straight(Kind::line, name, corner(ends[0]), corner(ends[1])));
  }
  for (Feature& f : polygons) add(std::move(f));
  for (const auto& [id, p] : at) add(straight(Kind::point, id, {id, p}, {id, p}));
}

IsolatedEdges::Feature IsolatedEdges::straight(Kind kind, const Beside& name, const Corner& a,
                                               const Corner& b) {
  Feature f;
  f.kind = kind;
  f.name = name;
  f.points = {a.id, b.id};
  f.lines = {{a, b}};
  make_set(f.points);
  return f;
}

void IsolatedEdges::add(Feature f) {
  f.middle = f.lines[0][0].at;
  for (const auto& ends : f.lines) {
    for (const Corner& c : ends) {
      f.reach = std::max(f.reach, std::sqrt(squared_distance(c.at, f.middle)));
    }
  }
  tree_.insert(f.middle, f.reach * (1 + kRoundedLength),
               static_cast<std::uint32_t>(features_.size()));
  features_.push_back(std::move(f));
}

std::vector<const IsolatedEdges::Feature*> IsolatedEdges::find_near(const Point<3>& x,
                                                                    double within) const {
  std::vector<std::uint32_t> found;
  tree_.visit_near(x, x, within, [&](std::uint32_t i) { found.push_back(i); });
  std::sort(found.begin(), found.end());
  std::vector<const Feature*> near;
  for (const std::uint32_t i : found) near.push_back(&features_[i]);
  return near;
}

bool IsolatedEdges::has_two_parts(const Feature& f, const Point<3>& x, double within) {
  const double within2 = within * within;
  std::set<PointId> corners;
  std::vector<std::array<PointId, 2>> lines;
  const auto look_at = [&](const Corner& c) {
    if (squared_distance(c.at, x) <= within2) corners.insert(c.id);
  };
  for (const auto& [a, b] : f.lines) {
    look_at(a), look_at(b);
    if (distance2(x, a.at, b.at) <= within2) lines.push_back({a.id, b.id});
  }
  for (const Corner& c : f.others) look_at(c);
  if (corners.size() > 1) return true;
  const auto has = [](const std::array<PointId, 2>& ends, PointId id) {
    return ends[0] == id || ends[1] == id;
  };
  return std::any_of(lines.begin(), lines.end(), [&](const auto& s) {
    if (!corners.empty() && !has(s, *corners.begin())) return true;
    return std::any_of(lines.begin(), lines.end(),
                       [&](const auto& t) { return !has(s, t[0]) && !has(s, t[1]); });
  });
}

double IsolatedEdges::distance(const Feature& f, const Point<3>& x) {
  if (f.shape && f.shape->contains(FlatPolygon::wide(x))) {
    return static_cast<double>(std::abs(f.shape->height(x)));
  }
  double least2 = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : f.lines) least2 = std::min(least2, distance2(x, a.at, b.at));
  return std::sqrt(least2);
}

std::optional<IsolatedEdges::Beside> IsolatedEdges::find(const Point<3>& p,
                                                         const Point<3>& q) const {
  const Point<3> middle = scaled(0.5, plus(p, q));
  const double length = std::sqrt(squared_distance(p, q));
  const double within = kIsolated * length * (1 - kRoundedLength);
  std::vector<std::pair<double, const Feature*>> near;
  for (const Feature* f : find_near(middle, within)) {
    const double away = distance(*f, middle);
    if (away <= within) near.emplace_back(away, f);
  }
  NearestBeside beside;
  for (const auto& [away, f] : near) {
    if (f->kind == Kind::point || away > kBesideEdge * length * (1 + kRoundedLength)) continue;
    const bool isolated = std::none_of(near.begin(), near.end(), [&, g = f](const auto& other) {
      return !meet(g->points, other.second->points);
    });
    if (isolated && !has_two_parts(*f, middle, within)) {
      beside.show(away, f->kind == Kind::polygon, f->name);
    }
  }
  return beside.found(length);
}

}  // namespace mesher::detail
