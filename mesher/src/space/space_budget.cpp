// Counting vertices by feature, and a place among most of them.
#include "space/space_budget.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/input_point.hpp"
#include "space/placed.hpp"
#include "text/text.hpp"

namespace mesher::detail {

namespace {

using Places = std::vector<Point<3>>;
using ByFeature = std::pair<NamedFeature, Places>;

// The segments and polygons with more than one new vertex, by their numbers, most first; of equal
// ones the smallest id first. What is on an edge counts for a polygon that has it.
std::vector<ByFeature> features_by_vertices(const PlacesOnFeatures& by_handle,
                                            const SpaceNames& names, const FeatureStore& store) {
  std::map<std::pair<std::int64_t, bool>, Places> by_name;  // whether it is a segment
  for (const auto& [on, places] : by_handle) {
    const Role role{{}, on};
    const EdgeHandle e = edge_of(role);
    const PolygonHandle f = polygon_of(role);
    if (!(e != 0 ? store.edges()[e].alive : store.polygons()[f].alive)) continue;
    const Feature feature = e != 0 ? Feature(store.edges()[e]) : Feature(store.polygons()[f]);
    const bool is_segment = e != 0 && names.segment(e).has_value();
    Places& all = by_name[{named(feature, names, store).feature.number, is_segment}];
    all.insert(all.end(), places.begin(), places.end());
  }
  std::vector<ByFeature> features;
  for (auto& [key, places] : by_name) {
    if (places.size() < 2) continue;
    const auto [id, is_segment] = key;
    const mesher::Feature name =
        is_segment ? mesher::Feature(LineId{id}) : mesher::Feature(PolygonId{id});
    features.emplace_back(NamedFeature{text_of(name), name}, std::move(places));
  }
  std::stable_sort(features.begin(), features.end(), [](const ByFeature& a, const ByFeature& b) {
    return a.second.size() > b.second.size();
  });
  return features;
}

// Of some of the places the one that has half of all the nearest to it, and these.
std::pair<Point<3>, Places> densest_half(Places places) {
  constexpr std::size_t kTried = 64;
  std::sort(places.begin(), places.end());
  const std::size_t half = (places.size() + 1) / 2;
  std::vector<std::pair<double, Point<3>>> away(places.size());
  const auto sort_around = [&](const Point<3>& p) {
    for (std::size_t i = 0; i < away.size(); ++i) {
      away[i] = {squared_distance(places[i], p), places[i]};
    }
    std::nth_element(away.begin(), away.begin() + static_cast<std::ptrdiff_t>(half) - 1,
                     away.end());
    return away[half - 1].first;
  };
  const std::size_t tried = std::min(kTried, places.size());
  std::pair<double, Point<3>> best{sort_around(places[0]), places[0]};
  for (std::size_t i = 1; i < tried; ++i) {
    const Point<3>& p = places[i * places.size() / tried];
    best = std::min(best, {sort_around(p), p});
  }
  sort_around(best.second);
  Places nearest;
  for (std::size_t i = 0; i < half; ++i) nearest.push_back(away[i].second);
  return {best.second, std::move(nearest)};
}

// Where the places pile up: in half of them, and in half of these, and so on.
Point<3> densest(Places places) {
  constexpr std::size_t kFew = 8;
  Point<3> at = places[0];
  while (places.size() > kFew) {
    auto half = densest_half(std::move(places));
    at = half.first;
    places = std::move(half.second);
  }
  return at;
}

}  // namespace

Error too_many_vertices(const VertexSearch<3>& vertices, const SpaceNames* names,
                        const FeatureStore& store, std::size_t most) {
  PlacesOnFeatures on_features;
  vertices.pool().for_each([&](const Vertex<3>& v) {
    if (v.alive && v.on_segment) on_features[vertices.role(v).on].push_back(v.p);
  });
  return too_many_vertices(on_features, names, store, most);
}

Error too_many_vertices(const PlacesOnFeatures& on_features, const SpaceNames* names,
                        const FeatureStore& store, std::size_t most) {
  std::string text = "more than " + std::to_string(most) + " vertices are needed";
  std::vector<mesher::Feature> features;
  Places all;
  if (names != nullptr) {
    for (const auto& [name, places] : features_by_vertices(on_features, *names, store)) {
      text += (features.empty() ? "; so far " : " and ") + std::to_string(places.size());
      text += (features.empty() ? " are on " : " on ") + name.text;
      features.push_back(name.feature);
      all.insert(all.end(), places.begin(), places.end());
      if (features.size() == 2) break;
    }
  }
  std::vector<Position> places;
  if (!all.empty()) {
    const Point<3> at = densest(std::move(all));
    text += ", the closest to each other near " + place_text(at);
    places.push_back(at);
  }
  return Error(ErrorCode::too_many, text, {}, std::move(features), std::move(places));
}

SurelyTooMany too_many_between(const Polygon& f, const Polygon& g, double width, const Point<3>& at,
                               const SpaceNames* names, const FeatureStore& store,
                               std::size_t most) {
  std::string text = "more than " + std::to_string(most) + " vertices are needed";
  std::vector<mesher::Feature> features;
  if (names != nullptr) {
    const NamedFeature one = named(Feature(f), *names, store);
    const NamedFeature other = named(Feature(g), *names, store);
    text += ": " + one.text + " and " + other.text + " are " + text::to_text(width) +
            " apart near " + place_text(at) + ", and have much area beside each other";
    features = {one.feature, other.feature};
  }
  return SurelyTooMany(
      Error(ErrorCode::too_many, text, {}, std::move(features), {position_of(at)}));
}

}  // namespace mesher::detail
