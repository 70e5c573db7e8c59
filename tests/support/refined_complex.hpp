// Meshes of complexes by each refinement, and what is wrong with them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "any_id.hpp"
#include "facade/graph_runs.hpp"
#include "mesher/check.hpp"
#include "mesher/meshing.hpp"
#include "mesher/write.hpp"
#include "random_complex.hpp"

namespace support {

enum class By { svr, refine, gap_balls };

template <By B>
mesher::Mesh<3> mesh_of(const mesher::Graph<3>& plc, const mesher::Options<3>& options,
                        mesher::Extent extent = mesher::Extent::box,
                        const mesher::RunControl& control = {}) {
  if constexpr (B == By::svr) {
    return mesher::svr(plc, options, extent, {}, nullptr, control);
  } else if constexpr (B == By::gap_balls) {
    return mesher::mesh_statically(plc, options);
  } else {
    return mesher::refine(plc, options, extent, {}, nullptr, control);
  }
}

inline mesher::Options<3> options_for(const mesher::Graph<3>& plc) {
  return {.domain = mesher::snapped_domain<3>(places_of(plc)), .max_vertices = 30000};
}

// What is wrong with a mesh of plc, less what of it is not wanted.
inline std::string fault(const mesher::Mesh<3>& mesh, const mesher::Graph<3>& plc,
                         mesher::Extent extent, std::optional<double> rho = 2) {
  mesher::GraphFile<3> file;
  file.graph = plc;
  const auto kept = domain_mesh(mesh, plc, extent).mesh;
  mesher::CheckOptions<3> options;
  options.rho = rho;
  options.graph = &file;
  options.features = &kept.features;
  options.boundary = mesher::BoundaryRule::lines;
  for (const mesher::Finding& f : check_mesh(kept, options)) {
    if (!f.holds) return f.property + ": " + f.detail;
  }
  return "";
}

inline AnyId id(std::size_t i) { return AnyId{static_cast<std::int64_t>(i + 1)}; }

inline mesher::Graph<3> plc_of(const Complex& complex) {
  mesher::Graph<3> plc;
  for (const mesher::Point<3>& p : complex.points)
    plc.points.push_back({id(plc.points.size()), p, 0});
  for (const auto& [a, b] : complex.segments) {
    plc.segments.push_back({id(plc.segments.size()), id(a), id(b), 0});
  }
  for (const auto& face : complex.faces) {
    mesher::Polygon polygon{.id = id(plc.polygons.size()), .loops = {}};
    for (const auto& loop : face.loops) {
      polygon.loops.emplace_back();
      for (const std::size_t i : loop) polygon.loops.back().push_back(id(i));
    }
    for (const std::size_t i : face.on) polygon.points.push_back(id(i));
    plc.polygons.push_back(polygon);
  }
  return plc;
}

}  // namespace support
