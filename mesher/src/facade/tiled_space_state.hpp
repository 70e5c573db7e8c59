// The state of a mesher of points, lines and polygons in space, in tiles.
//
// It is a SpaceState whose program ends when polygons have their vertices of before refinement:
// that is a function of the input alone. What it finds becomes edits of tiles, which have all edges
// and polygons. The tiles say which vertices there are, those of other processes, too; these are
// set here, and triangulated, so that all that is asked of a mesh is asked here, as of one
// thread's. So all processes have the whole mesh, and a part of the trace.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "facade/space_state.hpp"
#include "facade/tiled_state.hpp"
#include "tiles/feature_numbers.hpp"

namespace mesher::detail {

class TiledSpaceState final : public SpaceState, public PartOfMesh<3> {
 public:
  /// Throws: Error(bad_option).
  explicit TiledSpaceState(const Options<3>& options);
  /// With so many tiles in all processes; 0: options.threads in each. `peers` must outlive it.
  /// Throws: likewise.
  TiledSpaceState(const Options<3>& options, Peers& peers, std::size_t tiles = 0);

  /// Both throw NotInTiles, too.
  Change<3> first_run(Edits<3> edits, const RunControl& control, const Accept& accept) override;
  /// Throws NotInTilesYet, too.
  Change<3> propagate(const Edits<3>& edits, const RunControl& control,
                      const Accept& accept) override;
  [[nodiscard]] bool is_sooner_anew(const Edits<3>& edits) const noexcept override {
    return changes_all_limits(edits);
  }

  [[nodiscard]] MeshStats stats() const override;
  [[nodiscard]] const sac::Engine& engine() const noexcept override {
    return (*tiles_)[0].engine();
  }
  void check_invariants() const override;

  [[nodiscard]] const TiledMesher<3>& tiles() const noexcept override { return *tiles_; }
  [[nodiscard]] Mesh<3> own_mesh() const override;
  [[nodiscard]] Change<3> whole() const override;
  /// Of all.
  void judge_new(Change<3>& change) const override;
  [[nodiscard]] bool tells_all() const noexcept override { return true; }

 private:
  using Tiles = TiledMesher<3>;
  using Located = TileMesher<3>::Located;
  // What tiles are told of a vertex of before refinement.
  struct Told {
    std::optional<Located> located;  // nothing: it is none
    bool is_input = false;
    friend bool operator==(const Told&, const Told&) = default;
  };
  struct News {
    Tiles::Edits by_tile;
    CommonOrders<3> common;
    std::vector<std::pair<VertexHandle, Told>> told;  // as it was before
    std::vector<EdgeHandle> edges_gone;
  };
  // A vertex that a tile has, or has no more.
  struct Standing {
    Point<3> p{};
    bool is_there = false;
    Role role{};
  };

  [[nodiscard]] std::unique_ptr<Tiles> build(const Tiles::Ask& ask);
  [[nodiscard]] Told now(const Vertex<3>& v) const;
  void find_news(const Edits<3>& edits, News& news);
  void take_back(const News& news) noexcept;
  void number(const FeatureOrders& come);
  void list_gone(const FeatureOrders& orders, std::vector<EdgeHandle>& gone) const;
  [[nodiscard]] Standing standing(const Point<3>& p) const;
  [[nodiscard]] std::vector<Standing> of_all(std::vector<Standing> own) const;
  void set_vertices(const std::vector<Standing>& all);
  void set_touched() noexcept;

  Options<3> options_;
  Alone alone_;
  Peers& peers_;
  std::size_t tiles_wanted_ = 0;                             // 0: as many as threads
  FeatureNumbers edge_numbers_;                              // empty, if there is one process
  FeatureNumbers polygon_numbers_;                           // likewise
  std::vector<Told> told_;                                   // by handle
  std::vector<std::pair<VertexHandle, Role>> roles_before_;  // of those that an update has set
  std::unique_ptr<Tiles> tiles_;
};

/// Whether a mesher that begins with these edits may be such a one.
[[nodiscard]] bool may_have_complexes_tiled(const Options<3>& options, const Edits<3>& edits);

}  // namespace mesher::detail
