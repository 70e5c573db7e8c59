// The input of a view: parts of it, which features hang on which points, and what commands are as
// lines of a script.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "fields.hpp"
#include "mesher/mesher.hpp"

namespace tool::view {

/// All features of a graph.
template <int D>
[[nodiscard]] std::vector<mesher::Feature> features_of(const mesher::Graph<D>& graph);

template <int D>
class InputIndex {
 public:
  /// Requires: `mesher` outlives the index.
  explicit InputIndex(const mesher::Mesher<D>& mesher) : mesher_(&mesher) {}

  /// Notes what came into the input.
  void take(const mesher::Graph<D>& graph);
  /// Of these features those that the input has.
  [[nodiscard]] mesher::Graph<D> part(const std::set<mesher::Feature>& features) const;

  /// The points of a point, line or polygon, ascending; none if it is not there.
  [[nodiscard]] std::vector<mesher::PointId> points_of(const mesher::Feature& feature) const;

  /// All holes and regions that came; some may be gone.
  [[nodiscard]] const std::set<mesher::SeedId>& seeds() const noexcept { return seeds_; }

  /// The lines of a command that edits features: point, line, polygon, hole, region or delete (see
  /// model.hpp). New features get the ids after the largest. Throws: Error(bad_edit).
  [[nodiscard]] std::vector<std::string> lines_of(const Json& command);

 private:
  [[nodiscard]] std::vector<std::string> path_lines(const Json& command, bool polygon);
  [[nodiscard]] std::vector<std::string> deleting_lines(const Json& command) const;

  const mesher::Mesher<D>* mesher_;
  std::set<mesher::SeedId> seeds_;
  std::map<mesher::FeatureKind, std::int64_t> largest_;        // ids given so far
  std::map<mesher::PointId, std::set<mesher::Feature>> uses_;  // lines, polygons; some are past
};

}  // namespace tool::view
