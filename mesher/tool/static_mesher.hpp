// A mesher without the engine: it makes the mesh anew at every update, by mesh_statically.
//
// It has the part of Mesher<2>'s interface that commands use, with the same errors, so that
// `edit --static` runs the same command on other work.
#pragma once

#include <map>
#include <vector>

#include "mesher/mesher.hpp"

namespace tool {

class StaticMesher {
 public:
  explicit StaticMesher(const mesher::Options<2>& options) : options_(options) {}

  /// As those of Mesher<2>, but that points that are too close are left to update().
  /// Throws: Error (repeated_id, unknown_id, duplicate_point, outside_domain), and then changes
  /// nothing.
  void insert(mesher::FeatureId id, const mesher::Point<2>& point);
  void insert(const std::vector<mesher::FeatureId>& ids,
              const std::vector<mesher::Point<2>>& points);
  void remove(mesher::FeatureId id);
  void move(mesher::FeatureId id, const mesher::Point<2>& point);
  void discard_edits() { edited_ = current_; }

  /// As that of Mesher<2>, but that edits that fail stay announced.
  /// Cost: a mesh from scratch; counts of calls are 0.
  mesher::Change<2> update(const mesher::RunControl& control = {});

  [[nodiscard]] const mesher::Mesh<2>& mesh() const { return mesh_; }
  [[nodiscard]] const mesher::MeshStats& stats() const { return stats_; }
  [[nodiscard]] std::size_t size() const { return current_.points.size(); }

 private:
  // ids has (points.at(id), id) for every id, and nothing else.
  struct Features {
    std::map<mesher::FeatureId, mesher::Point<2>> points;
    std::multimap<mesher::Point<2>, mesher::FeatureId> ids;
  };
  void require_inside(mesher::FeatureId id, const mesher::Point<2>& point) const;
  void require_free(mesher::FeatureId id, const mesher::Point<2>& point) const;
  void require_known(mesher::FeatureId id) const;
  void put(mesher::FeatureId id, const mesher::Point<2>& point);

  mesher::Options<2> options_;
  Features current_, edited_;
  mesher::Mesh<2> mesh_;
  mesher::MeshStats stats_;
};

}  // namespace tool
