// A mesher in space without the engine: it makes the mesh anew at every update. (See
// static_mesher.hpp, for the plane.)
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "mesher/mesher.hpp"
#include "mesher/sizes.hpp"
#include "static_seeds.hpp"

namespace tool {

class StaticSpaceMesher : public StaticSeeds<3> {
 public:
  StaticSpaceMesher(const mesher::Options<3>& options, mesher::Extent extent,
                    mesher::RegionAreas areas)
      : StaticSeeds(options.domain),
        options_(options),
        edited_options_(options),
        extent_(extent),
        areas_(areas) {}

  /// As those of DomainMesherOf<3>.
  void limit(const mesher::SizeLimits<3>& limits) { set_limits(edited_options_, limits); }
  void limit(const mesher::Box<3>& box, const mesher::SizeLimits<3>& limits) {
    set_limits(edited_options_, box, limits);
  }

  /// As those of DomainMesherOf<3>, but that what is wrong with a polygon alone is left to
  /// update(). Throws: Error (repeated_id, unknown_id), and then changes nothing.
  void insert_polygon(const mesher::Polygon& polygon, std::int64_t marker = 0);
  void remove_polygon(mesher::FeatureId id);
  void discard_edits() {
    StaticSeeds::discard_edits();
    edited_polygons_ = current_polygons_;
    edited_options_ = options_;
  }

  /// As that of DomainMesherOf<3>, but that edits that fail stay announced, and that edges, faces
  /// and `relabelled` are not found. Cost: a mesh from scratch; counts of calls are 0.
  mesher::DomainUpdateOf<3> update(const mesher::RunControl& control = {});

  [[nodiscard]] const mesher::Mesh<3>& mesh() const { return mesh_; }
  [[nodiscard]] const mesher::DomainMeshOf<3>& domain_mesh() const { return domain_; }
  /// With the edits that are announced.
  [[nodiscard]] mesher::Plc input() const;
  [[nodiscard]] const mesher::Options<3>& options() const { return options_; }
  [[nodiscard]] const mesher::MeshStats& stats() const { return stats_; }

 private:
  using Polygons = std::map<mesher::FeatureId, mesher::Plc::Facet>;
  void require_no_corners_go() const;

  mesher::Options<3> options_, edited_options_;  // they differ in the limits of size
  mesher::Extent extent_;
  mesher::RegionAreas areas_;
  Polygons current_polygons_, edited_polygons_;
  mesher::Mesh<3> mesh_;
  mesher::DomainMeshOf<3> domain_;
  mesher::MeshStats stats_;
};

}  // namespace tool
