// Meshes of points and segments by each refinement, and a judge of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "any_id.hpp"
#include "facade/graph_runs.hpp"
#include "feature_ids.hpp"
#include "mesher/check.hpp"
#include "mesher/meshing.hpp"
#include "random_pslg.hpp"
#include "rules/mesh_box.hpp"

namespace support {

enum class By { svr, refine };

template <By B>
mesher::Mesh<2> mesh_of(const mesher::Graph<2>& graph, const mesher::Options<2>& options,
                        mesher::Extent extent = mesher::Extent::box,
                        const mesher::RunControl& control = {}) {
  if constexpr (B == By::svr) {
    return mesher::svr(graph, options, extent, {}, nullptr, control);
  } else {
    return mesher::refine(graph, options, extent, {}, nullptr, control);
  }
}

inline mesher::Options<2> options_for(const mesher::Graph<2>& graph) {
  return {.domain = mesher::snapped_domain<2>(places_of(graph)), .max_vertices = 100000};
}

// What is wrong with a mesh of the graph, less what of it is not wanted.
inline std::string fault(const mesher::Mesh<2>& mesh, const mesher::Graph<2>& graph,
                         mesher::Extent extent) {
  mesher::GraphFile<2> file;
  file.graph = graph;
  file.points.resize(graph.points.size());
  const auto kept = domain_mesh(mesh, graph, extent).mesh;
  mesher::CheckOptions<2> options;
  options.rho = 1.4142;
  options.graph = &file;
  options.features = &kept.features;
  options.boundary = mesher::BoundaryRule::lines;
  for (const mesher::Finding& f : check_mesh(kept, options)) {
    if (!f.holds) return f.property + ": " + f.detail;
  }
  return "";
}

inline AnyId id_at(std::size_t i) { return AnyId{static_cast<std::int64_t>(i + 1)}; }

inline mesher::Graph<2> graph_of(const std::vector<mesher::Point<2>>& points,
                                 const std::vector<std::pair<std::size_t, std::size_t>>& segments) {
  mesher::Graph<2> graph;
  for (const mesher::Point<2>& p : points) {
    graph.points.push_back({id_at(graph.points.size()), p, 0});
  }
  for (const auto& [a, b] : segments) {
    graph.segments.push_back({id_at(graph.segments.size()), id_at(a), id_at(b), 0});
  }
  return graph;
}

// A square of side 1, and one of side 1/4 in the middle.
inline mesher::Graph<2> frame() {
  return graph_of(
      {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {.375, .375}, {.625, .375}, {.625, .625}, {.375, .625}},
      {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}});
}

struct Nobody {
  template <class... Edit>
  void insert(const Edit&...) {}
  template <class... Edit>
  void remove(const Edit&...) {}
  template <class... Edit>
  void insert_segment(const Edit&...) {}
  template <class... Edit>
  void remove_segment(const Edit&...) {}
};

// Points at 10^-7 beside segments, and segments to them, ask for many vertices.
inline mesher::Options<2> random_options() {
  mesher::Options<2> options = PslgEditor::options();
  options.max_vertices = 40000;
  return options;
}

// In [0, 16]^2.
inline Pslg random_graph(PslgEditor::Family family, std::uint64_t seed, int edits) {
  PslgEditor editor(family, seed);
  const mesher::detail::MeshBox<2> box = mesher::detail::mesh_box(PslgEditor::options());
  Pslg graph;
  Nobody nobody;
  for (int i = 0; i < edits; ++i) editor.edit(graph, box, nobody);
  return graph;
}

inline mesher::Graph<2> graph_of(const Pslg& random) {
  mesher::Graph<2> graph;
  for (const auto& [id, p] : random.points) graph.points.push_back({mesher::PointId{id}, p, 0});
  for (const auto& [ends, id] : random.segments) {
    graph.segments.push_back(
        {mesher::LineId{id}, mesher::PointId{ends.first}, mesher::PointId{ends.second}, 0});
  }
  return graph;
}

// The error of a run: its code, its text, and the ids that it names.
struct Refusal {
  std::string code, text;
  Ids ids;
};
template <By B>
Refusal refusal(const mesher::Graph<2>& graph, const mesher::Options<2>& options,
                const mesher::RunControl& control = {}) {
  try {
    static_cast<void>(mesh_of<B>(graph, options, mesher::Extent::box, control));
  } catch (const mesher::Error& e) {
    return {std::string(mesher::code_name(e.code())), e.what(), support::ids_of(e)};
  }
  return {};
}

}  // namespace support
