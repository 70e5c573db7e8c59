// A mesher without the engine: it makes the mesh anew at every update, by mesh_statically.
//
// It has the part of DomainMesher's interface that commands use, with the same errors, so that
// `edit --static` runs the same command on other work.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "mesher/domain_mesher.hpp"

namespace tool {

class StaticMesher {
 public:
  StaticMesher(const mesher::Options<2>& options, mesher::Extent extent)
      : options_(options), extent_(extent) {}

  /// As those of DomainMesher, but that points that are too close are left to update().
  /// Throws: Error (repeated_id, unknown_id, duplicate_point, outside_domain, zero_length), and
  /// then changes nothing.
  void insert(mesher::FeatureId id, const mesher::Point<2>& point, std::int64_t marker = 0);
  void remove(mesher::FeatureId id);
  void move(mesher::FeatureId id, const mesher::Point<2>& point);
  void insert_segment(mesher::FeatureId id, mesher::FeatureId from, mesher::FeatureId to,
                      std::int64_t marker = 0) {
    insert_polyline(id, {from, to}, marker);
  }
  void insert_polyline(mesher::FeatureId id, const std::vector<mesher::FeatureId>& points,
                       std::int64_t marker = 0);
  void remove_segment(mesher::FeatureId id);
  void insert_seed(const mesher::Seed& seed);
  void remove_seed(const mesher::SeedName& name);
  void discard_edits() { edited_ = current_; }

  /// As that of DomainMesher, but that edits that fail stay announced, and that `relabelled` is not
  /// found. Cost: a mesh from scratch; counts of calls are 0.
  mesher::DomainUpdate update(const mesher::RunControl& control = {});

  [[nodiscard]] const mesher::Mesh<2>& mesh() const { return mesh_; }
  [[nodiscard]] const mesher::DomainMesh& domain_mesh() const { return domain_; }
  [[nodiscard]] const mesher::MeshStats& stats() const { return stats_; }

 private:
  struct Vertex {
    mesher::Point<2> at{};
    std::int64_t marker = 0;
  };
  struct Line {
    std::vector<mesher::FeatureId> points;
    std::int64_t marker = 0;
  };
  // ids has (points.at(id).at, id) for every id, and nothing else.
  struct Features {
    std::map<mesher::FeatureId, Vertex> points;
    std::multimap<mesher::Point<2>, mesher::FeatureId> ids;
    std::map<mesher::FeatureId, Line> lines;
    std::map<mesher::SeedName, mesher::Seed> seeds;
  };
  void require_inside(mesher::FeatureId id, const mesher::Point<2>& point) const;
  void require_free(mesher::FeatureId id, const mesher::Point<2>& point) const;
  void require_known(mesher::FeatureId id) const;
  void require_unused() const;
  void put(mesher::FeatureId id, const Vertex& vertex);
  [[nodiscard]] mesher::Pslg graph() const;

  mesher::Options<2> options_;
  mesher::Extent extent_;
  Features current_, edited_;
  mesher::Mesh<2> mesh_;
  mesher::DomainMesh domain_;
  mesher::MeshStats stats_;
};

}  // namespace tool
