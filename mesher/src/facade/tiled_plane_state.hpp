// The state of a mesher of points and lines in the plane, in tiles.
//
// It is a PlaneState whose program ends when segments are split: that is a function of the input
// alone. What it finds becomes edits of tiles: which pieces are leaves before anything is refined,
// which vertices they end at, and how crowded each is. The tiles refine, and have the mesh.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "facade/plane_state.hpp"
#include "facade/tile_angles.hpp"
#include "facade/tiled_state.hpp"
#include "tiles/feature_numbers.hpp"

namespace mesher::detail {

class TiledPlaneState final : public PlaneState, public PartOfMesh<2> {
 public:
  /// Throws: Error(bad_option).
  explicit TiledPlaneState(const Options<2>& options);
  /// With so many tiles in all processes; 0: options.threads in each. `peers` must outlive it.
  /// Throws: likewise.
  TiledPlaneState(const Options<2>& options, Peers& peers, std::size_t tiles = 0);

  /// Both throw NotInTiles, too; propagate() also NotInTilesYet.
  Change<2> first_run(Edits<2> edits, const RunControl& control, const Accept& accept) override;
  Change<2> propagate(const Edits<2>& edits, const RunControl& control,
                      const Accept& accept) override;
  /// Points, lines, and limits of size.
  [[nodiscard]] bool takes(const Edits<2>& edits) const noexcept override {
    return !edits.polygons.has_edits();
  }
  [[nodiscard]] bool is_sooner_anew(const Edits<2>& edits) const noexcept override {
    return changes_all_limits(edits);
  }

  /// The part of this process.
  [[nodiscard]] Mesh<2> mesh() const override;
  [[nodiscard]] Mesh<2> own_mesh() const override { return mesh(); }
  [[nodiscard]] Change<2> whole() const override;
  /// Of all.
  void judge_new(Change<2>& change) const override;
  [[nodiscard]] MeshStats stats() const override;
  [[nodiscard]] const sac::Engine& engine() const noexcept override {
    return (*tiles_)[0].engine();
  }
  void check_invariants() const override;

  [[nodiscard]] const TiledMesher<2>& tiles() const noexcept override { return *tiles_; }

 private:
  using Tiles = TiledMesher<2>;
  using Located = TileMesher<2>::Located;
  // What tiles are told.
  struct News {
    Tiles::Edits by_tile;
    CommonOrders<2> common;
    // As they were told before, so that it can be taken back.
    std::vector<std::pair<VertexHandle, std::optional<Located>>> points;
    std::vector<std::pair<SegmentHandle, std::optional<Zones>>> zones;
    std::vector<SegmentHandle> gone;
  };

  [[nodiscard]] std::unique_ptr<Tiles> build(const Tiles::Ask& ask);
  [[nodiscard]] std::optional<Located> located(const Vertex<2>& v) const;
  void find_news(const Edits<2>& edits, News& news);
  void find_points(News& news);
  void find_lines(News& news);
  void note_zones(const Segment& s, News& news, std::vector<SegmentHandle>& come);
  void free_features() noexcept override;
  void number(std::vector<SegmentHandle> segments);
  void take_back(const News& news) noexcept;
  void require_leaves() const;
  [[nodiscard]] WholeWorld wholly() const;
  [[nodiscard]] Change<2> change_of(Tiles::Changes& changes) const;
  void report_edges(const Tiles::Changes& changes, Change<2>& change) const;

  Options<2> options_;
  Alone alone_;
  Peers& peers_;
  std::size_t tiles_wanted_ = 0;                     // 0: as many as threads
  FeatureNumbers numbers_;                           // of segments; empty, if there is one process
  std::vector<std::optional<Located>> told_points_;  // by handle
  std::vector<std::optional<Zones>> told_zones_;     // by handle
  bool are_zones_known_ = true;  // all that are told: who is near is noted when it changes
  std::unique_ptr<Tiles> tiles_;
};

}  // namespace mesher::detail
