// What refinements of complexes have in common: a refined mesh that is made to conform.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "svr/conformity.hpp"
#include "svr/refined_mesh.hpp"

namespace mesher::detail {

class ConformingMesh : public RefinedMesh<3> {
  using Base = RefinedMesh<3>;

 public:
  struct Settings : Base::Settings {
    FeatureStore* store = nullptr;   // the features of the points, by handles
    bool only_enclosed = false;      // else all of the box
    std::vector<Point<3>> holes{};
  };

  [[nodiscard]] const Conformity& conformity() const noexcept { return conformity_; }

 protected:
  /// Requires: there is a store, which lives as long as this.
  ConformingMesh(const MeshBox<3>& box, const Settings& settings, std::size_t points);

  std::uint32_t add_place(const Placed& place, VertexKind kind, VertexHandle point = 0);
  /// Requires: dug.
  void undo_place();
  /// Digs a vertex that is to make the mesh conform; or nothing, if it yields. Throws: Error
  /// (too_close: there is a vertex, as add_place()).
  [[nodiscard]] std::optional<std::uint32_t> dig(const Conformity::Wanted& wanted);
  /// Whether a poor simplex is split: it is in what is wanted, and not poor by a small angle.
  /// Requires: conformity_.next() has returned nothing, and nothing was inserted since.
  [[nodiscard]] bool is_split(std::uint32_t s);

  FeatureStore& store_;
  Conformity conformity_;

 private:
  [[nodiscard]] bool stays(std::uint32_t s) const;

  bool only_enclosed_, has_regions_ = false;
  std::vector<Point<3>> holes_;
  std::vector<std::uint32_t> star_;  // scratch
};

}  // namespace mesher::detail
