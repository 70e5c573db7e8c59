// A mesher in space without the engine: it makes the mesh anew at every update. (See
// static_mesher.hpp, for the plane.)
#pragma once

#include <utility>
#include <vector>

#include "mesh_difference.hpp"
#include "mesher/mesher.hpp"
#include "static_points.hpp"

namespace tool {

class StaticSpaceMesher : public StaticPoints<3> {
 public:
  explicit StaticSpaceMesher(const mesher::Options<3>& options)
      : StaticPoints(options.domain), options_(options) {}

  /// As that of Mesher, but that edits that fail stay announced. Cost: a mesh from scratch; counts
  /// of calls are 0.
  mesher::Change<3> update(const mesher::RunControl& control = {}) {
    std::vector<mesher::Point<3>> places;
    std::vector<mesher::FeatureId> ids;
    for (const auto& [id, vertex] : points()) {
      places.push_back(vertex.at);
      ids.push_back(id);
    }
    mesher::MeshStats stats;
    auto after = mesher::mesh_statically<3>(places, options_, ids, &stats, control);
    auto change = change_between<3>(mesh_, after);
    keep_edits();
    mesh_ = std::move(after);
    stats_ = stats;
    return change;
  }

  [[nodiscard]] const mesher::Mesh<3>& mesh() const { return mesh_; }
  [[nodiscard]] const mesher::Options<3>& options() const { return options_; }
  [[nodiscard]] const mesher::MeshStats& stats() const { return stats_; }

 private:
  mesher::Options<3> options_;
  mesher::Mesh<3> mesh_;
  mesher::MeshStats stats_;
};

}  // namespace tool
