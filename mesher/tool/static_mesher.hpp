// A mesher without the engine: it makes the mesh anew at every update, by mesher::box_mesh.
//
// It has the part of Mesher's interface that commands use, with the same errors, so that
// `edit --static` runs the same command on other work.
#pragma once

#include <cstdint>
#include <map>

#include "mesher/mesher.hpp"
#include "mesher/sizes.hpp"
#include "static_seeds.hpp"

namespace tool {

template <int D>
class StaticMesher : public StaticSeeds<D> {
 public:
  explicit StaticMesher(mesher::Options<D> options);

  /// As those of Mesher.
  using StaticSeeds<D>::insert;
  void insert(const mesher::Graph<D>& graph);
  void limit(const mesher::SizeLimits<D>& limits) { set_limits(edited_options_, limits); }
  void limit(const mesher::Box<D>& box, const mesher::SizeLimits<D>& limits) {
    set_limits(edited_options_, box, limits);
  }

  /// As those of Mesher, but that what is wrong with a polygon alone is left to update().
  /// Throws: Error (repeated_id, unknown_id), and then changes nothing.
  void insert_polygon(const mesher::Polygon& polygon) requires(D == 3);
  void remove_polygon(mesher::PolygonId id) requires(D == 3);
  void discard_edits() {
    StaticSeeds<D>::discard_edits();
    edited_polygons_ = current_polygons_;
    edited_options_ = options_;
  }

  /// As that of Mesher, but that edits that fail stay announced, and that `relabelled`, in space
  /// also edges and faces, are not found. Cost: a mesh from scratch; counts of calls are 0.
  mesher::DomainUpdate<D> update(const mesher::RunControl& control = {});

  [[nodiscard]] const mesher::Mesh<D>& box_mesh() const { return mesh_; }
  [[nodiscard]] const mesher::DomainMesh<D>& domain_mesh() const { return domain_; }
  /// With the edits that are announced.
  [[nodiscard]] mesher::Graph<D> input() const;
  [[nodiscard]] const mesher::Options<D>& options() const { return options_; }
  [[nodiscard]] const mesher::MeshStats& stats() const { return stats_; }

 private:
  using Polygons = std::map<mesher::PolygonId, mesher::Polygon>;
  void require_no_corners_go() const;
  void report(const mesher::Mesh<D>& after, const mesher::Graph<D>& input,
              mesher::DomainUpdate<D>& update) const;

  mesher::Options<D> options_, edited_options_;  // they differ in the limits of size
  Polygons current_polygons_, edited_polygons_;  // in space
  mesher::Mesh<D> mesh_;
  mesher::DomainMesh<D> domain_;
  mesher::MeshStats stats_;
};

}  // namespace tool
