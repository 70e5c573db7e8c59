// How redraw() goes in space with polygons: a facet is its sheets.
#pragma once

#include <cstdint>
#include <vector>

#include "repair/redrawing.hpp"

namespace mesher::detail {

class SpaceRedrawing final : public Redrawing<3> {
 public:
  SpaceRedrawing(const GraphFile<3>& file, const Drawing<3>& drawing, const Drawn<3>& drawn);

 private:
  // By rank of ids.
  [[nodiscard]] const mesher::Polygon& facet(std::size_t f) const {
    return file_.graph.polygons[facets_[f]];
  }
  [[nodiscard]] FileLocation location(std::size_t f) const {
    return file_.location_of_polygon(facets_[f]);
  }

  void look_at_new_points() override;
  void draw_polygons() override;
  [[nodiscard]] std::vector<VertexHandle> points_of(std::size_t f) const;
  void add_polygon(PolygonId id, std::size_t f, const mesher::Polygon& polygon);
  [[nodiscard]] mesher::Polygon polygon_of(const Sheet& sheet);
  [[nodiscard]] mesher::Polygon first_of(std::size_t f);
  [[nodiscard]] Point<3> first_place(std::size_t f) const;
  RepairNote<3>& note_polygon(RepairKind kind, std::size_t f, const Point<3>& at);
  void note_points_on(std::size_t f);
  void look_at_shape(std::size_t f);
  void note_losses();

  std::vector<std::size_t> facets_;                // in the order of ids
  std::vector<std::vector<const Sheet*>> sheets_;  // of each facet, in the order of places
};

}  // namespace mesher::detail
