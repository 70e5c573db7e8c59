// Commands as lines of a script.
#include "input_index.hpp"

#include <algorithm>

#include "graph_edits.hpp"

namespace tool::view {
namespace {

using mesher::Feature;
using mesher::FeatureKind;
using mesher::Graph;
using mesher::PointId;

// Whether a line or polygon, the only one in the graph, has this point. What once had it may not.
template <int D>
bool hangs_on(const Graph<D>& graph, PointId id) {
  const auto has = [&](const auto& points) {
    return std::find(points.begin(), points.end(), id) != points.end();
  };
  for (const auto& line : graph.polylines) {
    if (has(line.points)) return true;
  }
  if constexpr (D == 3) {
    for (const auto& f : graph.polygons) {
      if (has(f.points) || std::any_of(f.loops.begin(), f.loops.end(), has)) return true;
      if (std::any_of(f.edges.begin(), f.edges.end(), has)) return true;
    }
  }
  return false;
}

}  // namespace

template <int D>
std::vector<Feature> features_of(const Graph<D>& graph) {
  std::vector<Feature> all;
  for (const auto& p : graph.points) all.emplace_back(p.id);
  for (const auto& s : graph.segments) all.emplace_back(s.id);
  for (const auto& l : graph.polylines) all.emplace_back(l.id);
  if constexpr (D == 3) {
    for (const auto& f : graph.polygons) all.emplace_back(f.id);
  }
  for (const auto& s : graph.seeds) all.emplace_back(s.id);
  return all;
}

// Which features hang on which points, and the largest ids.
template <int D>
void InputIndex<D>::take(const Graph<D>& graph) {
  for (const Feature& f : features_of(graph)) {
    std::int64_t& largest = largest_[f.kind];
    largest = std::max(largest, f.number);
  }
  for (const auto& seed : graph.seeds) seeds_.insert(seed.id);
  for (const auto& s : graph.segments) {
    uses_[s.from].insert(s.id);
    uses_[s.to].insert(s.id);
  }
  for (const auto& l : graph.polylines) {
    for (const PointId p : l.points) uses_[p].insert(l.id);
  }
  if constexpr (D == 3) {
    for (const auto& f : graph.polygons) {
      for (const auto& loop : f.loops) {
        for (const PointId p : loop) uses_[p].insert(f.id);
      }
      for (const auto& edge : f.edges) {
        for (const PointId p : edge) uses_[p].insert(f.id);
      }
      for (const PointId p : f.points) uses_[p].insert(f.id);
    }
  }
}

template <int D>
Graph<D> InputIndex<D>::part(const std::set<Feature>& features) const {
  Graph<D> graph;
  for (const Feature& f : features) {
    if (const auto id = f.point()) {
      if (const auto p = mesher_->point(*id)) graph.points.push_back(*p);
    } else if (const auto line_id = f.line()) {
      if (const auto line = mesher_->line(*line_id)) graph.polylines.push_back(*line);
    } else if (const auto seed_id = f.seed()) {
      if (const auto seed = mesher_->seed(*seed_id)) graph.seeds.push_back(*seed);
    }
    if constexpr (D == 3) {
      if (const auto polygon_id = f.polygon()) {
        if (const auto polygon = mesher_->polygon(*polygon_id)) graph.polygons.push_back(*polygon);
      }
    }
  }
  return graph;
}

template <int D>
std::vector<PointId> InputIndex<D>::points_of(const Feature& feature) const {
  const Graph<D> graph = part({feature});
  std::set<PointId> points;
  for (const auto& p : graph.points) points.insert(p.id);
  for (const auto& l : graph.polylines) points.insert(l.points.begin(), l.points.end());
  if constexpr (D == 3) {
    for (const auto& f : graph.polygons) {
      for (const auto& loop : f.loops) points.insert(loop.begin(), loop.end());
      for (const auto& edge : f.edges) points.insert(edge.begin(), edge.end());
      points.insert(f.points.begin(), f.points.end());
    }
  }
  return {points.begin(), points.end()};
}

template <int D>
std::vector<std::string> InputIndex<D>::path_lines(const Json& command, bool polygon) {
  const Json& through = field(command, "through");
  if (!through.is_array() || through.size() > kMostFeatures) throw refusal("'through' is no list");
  const bool closed = polygon || flag_of(command, "closed");
  const std::string end = marker_words(marker_of(command));
  if (through.size() < (closed ? 3U : 2U))
    throw refusal("a line has two points, a closed one three");
  std::vector<std::string> lines;
  std::string points, first;
  std::int64_t next = largest_[FeatureKind::point];
  for (const Json& at : through) {
    std::string word;
    if (at.is_array()) {
      word = id_word(++next);
      lines.push_back("+point" + word + place_words<D>(position_of_json<D>(at)));
    } else {
      word = id_word(id_of(at));
    }
    if (first.empty()) first = word;
    points += word;
  }
  const std::int64_t line = largest_[polygon ? FeatureKind::polygon : FeatureKind::line] + 1;
  if (closed && !polygon) points += first;
  const char* const word = polygon                          ? "+polygon"
                           : through.size() == 2 && !closed ? "+segment"
                                                            : "+polyline";
  lines.push_back(word + id_word(line) + points + end);
  return lines;
}

// Lines and polygons on a point that goes, go.
template <int D>
std::vector<std::string> InputIndex<D>::deleting_lines(const Json& command) const {
  const Json& list = field(command, "features");
  if (!list.is_array() || list.empty() || list.size() > kMostFeatures) {
    throw refusal("'features' is no list of features");
  }
  std::set<Feature> features;
  for (const Json& item : list) {
    const Feature feature = feature_of(item);
    features.insert(feature);
    const auto id = feature.point();
    const auto uses = id ? uses_.find(*id) : uses_.end();
    if (uses == uses_.end()) continue;
    for (const Feature& use : uses->second) {
      if (hangs_on(part({use}), *id)) features.insert(use);
    }
  }
  Graph<D> there = part(features);
  if (features_of(there).size() != features.size()) throw refusal("what is to go is not there");
  return graph_edits<D>(there, {});
}

template <int D>
std::vector<std::string> InputIndex<D>::lines_of(const Json& command) {
  const std::string what = command["do"].get<std::string>();
  if (what == "line") return path_lines(command, false);
  if (what == "polygon") return path_lines(command, D == 3);
  if (what == "delete") return deleting_lines(command);
  const auto at = position_of_json<D>(field(command, "at"));
  if (what == "point") {
    return {"+point" + id_word(largest_[FeatureKind::point] + 1) + place_words<D>(at) +
            marker_words(marker_of(command))};
  }
  if (what == "hole") {
    return {"+hole" + id_word(largest_[FeatureKind::hole] + 1) + place_words<D>(at)};
  }
  std::string region = "+region" + id_word(largest_[FeatureKind::region] + 1) + place_words<D>(at) +
                       " " + script_number(number_of(field(command, "attribute"), "the attribute"));
  if (command.contains("largest")) {
    region += " ";
    region += script_number(number_of(command["largest"], "the limit"));
  }
  return {region};
}

template std::vector<Feature> features_of(const Graph<2>&);
template std::vector<Feature> features_of(const Graph<3>&);
template class InputIndex<2>;
template class InputIndex<3>;

}  // namespace tool::view
