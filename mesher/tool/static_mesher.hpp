// A mesher without the engine: it makes the mesh anew at every update, by mesh_statically.
//
// It has the part of DomainMesher's interface that commands use, with the same errors, so that
// `edit --static` runs the same command on other work.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "mesher/domain_mesher.hpp"
#include "mesher/sizes.hpp"
#include "static_seeds.hpp"

namespace tool {

class StaticMesher : public StaticSeeds<2> {
 public:
  StaticMesher(const mesher::Options<2>& options, mesher::Extent extent, mesher::RegionAreas areas)
      : StaticSeeds(options.domain),
        options_(options),
        edited_options_(options),
        extent_(extent),
        areas_(areas) {}

  /// As those of DomainMesher.
  void limit(const mesher::SizeLimits<2>& limits) { set_limits(edited_options_, limits); }
  void limit(const mesher::Box<2>& box, const mesher::SizeLimits<2>& limits) {
    set_limits(edited_options_, box, limits);
  }
  void discard_edits() {
    StaticSeeds::discard_edits();
    edited_options_ = options_;
  }

  /// As that of DomainMesher, but that edits that fail stay announced, and that `relabelled` is not
  /// found. Cost: a mesh from scratch; counts of calls are 0.
  mesher::DomainUpdate update(const mesher::RunControl& control = {});

  [[nodiscard]] const mesher::Mesh<2>& mesh() const { return mesh_; }
  [[nodiscard]] const mesher::DomainMesh& domain_mesh() const { return domain_; }
  [[nodiscard]] const mesher::Options<2>& options() const { return options_; }
  [[nodiscard]] const mesher::MeshStats& stats() const { return stats_; }

 private:
  [[nodiscard]] mesher::Pslg graph() const;

  mesher::Options<2> options_, edited_options_;  // they differ in the limits of size
  mesher::Extent extent_;
  mesher::RegionAreas areas_;
  mesher::Mesh<2> mesh_;
  mesher::DomainMesh domain_;
  mesher::MeshStats stats_;
};

}  // namespace tool
