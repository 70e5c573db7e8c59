// Distances from the features near an edge, one by one.
#include "check/lonely_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "check/gave_in.hpp"
#include "geometry/cube_around.hpp"
#include "geometry/space_distances.hpp"
#include "sets/make_set.hpp"

namespace mesher::detail {

namespace {

constexpr double kRoundedLength = 1e-9;  // of lengths, in favour of the mesh

bool meet(const std::vector<FeatureId>& a, const std::vector<FeatureId>& b) {
  return std::any_of(a.begin(), a.end(),
                     [&](FeatureId x) { return std::binary_search(b.begin(), b.end(), x); });
}

std::vector<Point<3>> places_of(const Plc& complex) {
  std::vector<Point<3>> places;
  for (const auto& p : complex.points) places.push_back(p.at);
  return places;
}

}  // namespace

LonelyEdges::LonelyEdges(const Plc& complex)
    : cube_(cube_around<3>(places_of(complex))), tree_(cube_) {
  std::map<FeatureId, Point<3>> at;
  for (const auto& p : complex.points) at[p.id] = p.at;
  const auto corner = [&](FeatureId id) { return Corner{id, at.at(id)}; };
  std::map<std::vector<FeatureId>, Beside> lines;  // by their ends
  const auto line = [&](FeatureId a, FeatureId b, const Beside& name) {
    lines.try_emplace({std::min(a, b), std::max(a, b)}, name);
    return std::array{corner(a), corner(b)};
  };
  for (const auto& s : complex.segments) line(s.from, s.to, {s.id, false});
  std::vector<Feature> polygons;
  for (const auto& facet : complex.facets) {
    const mesher::Polygon& f = facet.polygon;
    Feature polygon;
    polygon.kind = Kind::polygon;
    polygon.name = {f.id, true};
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
    for (const FeatureId id : f.points) polygon.others.push_back(corner(id));
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
  for (const auto& [id, p] : at) add(straight(Kind::point, {id, false}, {id, p}, {id, p}));
}

LonelyEdges::Feature LonelyEdges::straight(Kind kind, const Beside& name, const Corner& a,
                                           const Corner& b) {
  Feature f;
  f.kind = kind;
  f.name = name;
  f.points = {a.id, b.id};
  f.lines = {{a, b}};
  make_set(f.points);
  return f;
}

void LonelyEdges::add(Feature f) {
  f.middle = f.lines[0][0].at;
  for (const auto& ends : f.lines) {
    for (const Corner& c : ends) {
      f.reach = std::max(f.reach, std::sqrt(squared_distance(c.at, f.middle)));
    }
  }
  tree_.insert(f.middle, f.reach * (1 + kRoundedLength), static_cast<std::uint32_t>(features_.size()));
  features_.push_back(std::move(f));
}

std::vector<const LonelyEdges::Feature*> LonelyEdges::find_near(const Point<3>& x,
                                                                double within) const {
  std::vector<std::uint32_t> found;
  tree_.visit_near(x, x, within, [&](std::uint32_t i) { found.push_back(i); });
  std::sort(found.begin(), found.end());
  std::vector<const Feature*> near;
  for (const std::uint32_t i : found) near.push_back(&features_[i]);
  return near;
}

bool LonelyEdges::has_two_parts(const Feature& f, const Point<3>& x, double within) {
  const double within2 = within * within;
  std::set<FeatureId> corners;
  std::vector<std::array<FeatureId, 2>> lines;
  const auto look_at = [&](const Corner& c) {
    if (squared_distance(c.at, x) <= within2) corners.insert(c.id);
  };
  for (const auto& [a, b] : f.lines) {
    look_at(a), look_at(b);
    if (distance2(x, a.at, b.at) <= within2) lines.push_back({a.id, b.id});
  }
  for (const Corner& c : f.others) look_at(c);
  if (corners.size() > 1) return true;
  const auto has = [](const std::array<FeatureId, 2>& ends, FeatureId id) {
    return ends[0] == id || ends[1] == id;
  };
  return std::any_of(lines.begin(), lines.end(), [&](const auto& s) {
    if (!corners.empty() && !has(s, *corners.begin())) return true;
    return std::any_of(lines.begin(), lines.end(),
                       [&](const auto& t) { return !has(s, t[0]) && !has(s, t[1]); });
  });
}

double LonelyEdges::distance(const Feature& f, const Point<3>& x) {
  if (f.shape && f.shape->contains(FlatPolygon::wide(x))) {
    return static_cast<double>(std::abs(f.shape->height(x)));
  }
  double least2 = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : f.lines) least2 = std::min(least2, distance2(x, a.at, b.at));
  return std::sqrt(least2);
}

std::optional<LonelyEdges::Beside> LonelyEdges::find(const Point<3>& p, const Point<3>& q) const {
  const Point<3> middle = scaled(0.5, plus(p, q));
  const double length = std::sqrt(squared_distance(p, q));
  const double within = kLonely * length * (1 - kRoundedLength);
  std::vector<std::pair<double, const Feature*>> near;
  for (const Feature* f : find_near(middle, within)) {
    const double away = distance(*f, middle);
    if (away <= within) near.emplace_back(away, f);
  }
  NearestBeside beside;
  for (const auto& [away, f] : near) {
    if (f->kind == Kind::point || away > kBesideEdge * length * (1 + kRoundedLength)) continue;
    const bool lonely = std::none_of(near.begin(), near.end(), [&, g = f](const auto& other) {
      return !meet(g->points, other.second->points);
    });
    if (lonely && !has_two_parts(*f, middle, within)) {
      beside.show(away, f->kind == Kind::polygon, f->name);
    }
  }
  return beside.found(length);
}

}  // namespace mesher::detail
