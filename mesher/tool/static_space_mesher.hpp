// A mesher in space without the engine: it makes the mesh anew at every update. (See
// static_mesher.hpp, for the plane.)
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "mesher/mesher.hpp"
#include "static_lines.hpp"

namespace tool {

class StaticSpaceMesher : public StaticLines<3> {
 public:
  explicit StaticSpaceMesher(const mesher::Options<3>& options)
      : StaticLines(options.domain), options_(options) {}

  /// As those of Mesher, but that what is wrong with a polygon alone is left to update().
  /// Throws: Error (repeated_id, unknown_id), and then changes nothing.
  void insert_polygon(const mesher::Polygon& polygon);
  void remove_polygon(mesher::FeatureId id);
  void discard_edits() {
    StaticLines::discard_edits();
    edited_polygons_ = current_polygons_;
  }

  /// As that of Mesher, but that edits that fail stay announced. Cost: a mesh from scratch; counts
  /// of calls are 0.
  mesher::Change<3> update(const mesher::RunControl& control = {});

  [[nodiscard]] const mesher::Mesh<3>& mesh() const { return mesh_; }
  [[nodiscard]] const mesher::Options<3>& options() const { return options_; }
  [[nodiscard]] const mesher::MeshStats& stats() const { return stats_; }

 private:
  using Polygons = std::map<mesher::FeatureId, mesher::Polygon>;
  void require_no_corners_go() const;
  [[nodiscard]] mesher::Mesh<3> meshed(mesher::MeshStats& stats,
                                       const mesher::RunControl& control) const;

  mesher::Options<3> options_;
  Polygons current_polygons_, edited_polygons_;
  mesher::Mesh<3> mesh_;
  mesher::MeshStats stats_;
};

}  // namespace tool
