// Arrays of messages.
#include "mesh_arrays.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <vector>

namespace tool::view {
namespace {

using mesher::Feature;
using mesher::LiveMesh;
using mesher::SeedId;
using mesher::SeedKind;
using mesher::Slot;

std::vector<Slot> all_slots(std::size_t count) {
  std::vector<Slot> slots(count);
  std::iota(slots.begin(), slots.end(), 0);
  return slots;
}

// What `items` has at the slots, item after item.
template <class Number>
std::vector<Number> numbers_at(const std::vector<Slot>& slots, const auto& items) {
  std::vector<Number> numbers;
  if (!slots.empty()) numbers.reserve(slots.size() * items[slots[0]].size());
  for (const Slot s : slots) numbers.insert(numbers.end(), items[s].begin(), items[s].end());
  return numbers;
}

template <int D>
void add_simplices(const std::vector<Slot>& slots, const LiveMesh<D>& live, Message& message) {
  message.add("simplices", numbers_at<Slot>(slots, live.simplices()));
  if (D == 3) message.add("neighbours", numbers_at<Slot>(slots, live.neighbours()));
}

template <int D>
void add_edges(const std::vector<Slot>& slots, const LiveMesh<D>& live, Message& message) {
  std::vector<Slot> ends;
  std::vector<double> lines;
  for (const Slot s : slots) {
    const auto& edge = live.edges()[s];
    ends.insert(ends.end(), {edge.low, edge.high});
    const auto number = static_cast<double>(edge.feature.number);
    lines.push_back(!live.is_edge(s) ? NAN : edge.feature.line() ? number : -1 - number);
  }
  message.add("edges", ends);
  message.add("edge_lines", lines);
}

template <int D>
void add_faces(const std::vector<Slot>& slots, const LiveMesh<D>& live, Message& message) {
  std::vector<Slot> corners;
  std::vector<double> polygons;
  for (const Slot s : slots) {
    const auto& face = live.faces()[s];
    corners.insert(corners.end(), face.corners.begin(), face.corners.end());
    polygons.push_back(live.is_face(s) ? static_cast<double>(face.polygon) : NAN);
  }
  message.add("faces", corners);
  message.add("face_polygons", polygons);
}

// Simplices that stay, and are kept or not, or in a region, as they were not before.
template <int D>
std::vector<Slot> relabelled(const LiveMesh<D>& live, const mesher::DomainUpdate<D>& change) {
  std::vector<Slot> slots = change.kept.added;
  slots.insert(slots.end(), change.kept.removed.begin(), change.kept.removed.end());
  for (const auto& r : change.domain.relabelled) slots.push_back(live.find_simplex(r.corners));
  std::erase_if(slots, [&](Slot s) { return !live.is_simplex(s); });
  std::sort(slots.begin(), slots.end());
  slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  return slots;
}

template <int D>
std::vector<std::uint8_t> labels_of(const mesher::Mesher<D>& mesher,
                                    const std::vector<Slot>& slots) {
  const LiveMesh<D> live = mesher.live();
  std::vector<std::uint8_t> labels;
  labels.reserve(slots.size());
  for (const Slot s : slots) labels.push_back(live.is_simplex(s) ? label_of(mesher, s) : 255);
  return labels;
}

}  // namespace

template <int D>
std::uint8_t label_of(const mesher::Mesher<D>& mesher, Slot simplex) {
  if (!mesher.keeps(simplex)) return 0;
  const auto seed = mesher.label(simplex).seed;
  if (!seed || seed->kind == SeedKind::hole) return 1;
  return static_cast<std::uint8_t>(2 + (seed->number % 250 + 250) % 250);
}

template <int D>
std::size_t count_kept(const mesher::Mesher<D>& mesher) {
  const LiveMesh<D> live = mesher.live();
  std::size_t kept = 0;
  for (Slot s = 0; s < live.simplex_slots(); ++s) {
    if (live.is_simplex(s) && mesher.keeps(s)) ++kept;
  }
  return kept;
}

template <int D>
void add_points(const mesher::Graph<D>& now, Message& message) {
  std::vector<double> ids, places;
  for (const auto& p : now.points) {
    ids.push_back(static_cast<double>(p.id));
    places.insert(places.end(), p.at.begin(), p.at.end());
  }
  message.add("point_ids", ids);
  message.add("point_places", places);
}

template <int D>
void add_mesh(const mesher::Mesher<D>& mesher, Message& message) {
  const LiveMesh<D> live = mesher.live();
  const std::vector<Slot> simplices = all_slots(live.simplex_slots());
  message.add("places", numbers_at<double>(all_slots(live.vertex_slots()), live.points()));
  add_simplices(simplices, live, message);
  message.add("labels", labels_of(mesher, simplices));
  add_edges(all_slots(live.edges().size()), live, message);
  if constexpr (D == 3) add_faces(all_slots(live.faces().size()), live, message);
  add_points(mesher.input(), message);
}

template <int D>
void add_change(const mesher::Mesher<D>& mesher, const mesher::DomainUpdate<D>& change,
                Message& message) {
  const LiveMesh<D> live = mesher.live();
  const mesher::SlotChange& slots = change.slots;
  message.add("vertices_added", slots.vertices_added);
  message.add("places", numbers_at<double>(slots.vertices_added, live.points()));
  message.add("simplices_removed", slots.simplices_removed);
  message.add("simplices_added", slots.simplices_added);
  add_simplices(slots.simplices_added, live, message);
  message.add("labels", labels_of(mesher, slots.simplices_added));
  const std::vector<Slot> others = relabelled(live, change);
  message.add("relabelled", others);
  message.add("new_labels", labels_of(mesher, others));
  message.add("edges_removed", slots.edges_removed);
  message.add("edges_added", slots.edges_added);
  add_edges(slots.edges_added, live, message);
  if constexpr (D == 2) return;
  message.add("faces_removed", slots.faces_removed);
  message.add("faces_added", slots.faces_added);
  add_faces(slots.faces_added, live, message);
}

template <int D>
Json json_of_seeds(const mesher::Mesher<D>& mesher, const std::set<SeedId>& ids) {
  Json all = Json::array();
  std::map<SeedId, std::string> faults;
  for (const auto& fault : mesher.faults()) faults[fault.seed] = describe(fault);
  for (const SeedId& id : ids) {
    const auto seed = mesher.seed(id);
    if (!seed) continue;
    Json json{{"kind", kind_name(Feature(id).kind)}, {"id", id.number}, {"at", seed->at}};
    if (id.kind == SeedKind::region) json["attribute"] = seed->attribute;
    if (seed->max_measure) json["largest"] = *seed->max_measure;
    if (faults.contains(id)) json["fault"] = faults[id];
    all.push_back(std::move(json));
  }
  return all;
}

template std::uint8_t label_of(const mesher::Mesher<2>&, Slot);
template std::size_t count_kept(const mesher::Mesher<2>&);
template void add_mesh(const mesher::Mesher<2>&, Message&);
template void add_change(const mesher::Mesher<2>&, const mesher::DomainUpdate<2>&, Message&);
template void add_points(const mesher::Graph<2>&, Message&);
template Json json_of_seeds(const mesher::Mesher<2>&, const std::set<SeedId>&);
template std::uint8_t label_of(const mesher::Mesher<3>&, Slot);
template std::size_t count_kept(const mesher::Mesher<3>&);
template void add_mesh(const mesher::Mesher<3>&, Message&);
template void add_change(const mesher::Mesher<3>&, const mesher::DomainUpdate<3>&, Message&);
template void add_points(const mesher::Graph<3>&, Message&);
template Json json_of_seeds(const mesher::Mesher<3>&, const std::set<SeedId>&);

}  // namespace tool::view
