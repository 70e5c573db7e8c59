// The state of a mesher of points in tiles: which point is whose, how crowded each is, the limits
// of size, the tiles.
//
// Where several processes have tiles of one mesh, each has such a state with its own tiles, and all
// do the same: what is asked of the mesh is then about the part of this process. Each has all
// points, or, where there are no limits, those of its own tiles (divided_points.hpp).
#pragma once

#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "facade/divided_points.hpp"
#include "facade/in_tiles.hpp"
#include "index/feature_tree.hpp"

namespace mesher::detail {

/// Whether a mesher that begins with these edits may be in tiles.
template <int D>
[[nodiscard]] bool may_be_tiled(const Options<D>& options, const Edits<D>& edits);
/// The same with lines in the plane (tiled_plane_state.hpp).
[[nodiscard]] bool may_have_lines_tiled(const Options<2>& options, const Edits<2>& edits);

/// Which points a process has.
enum class PointsOf : std::uint8_t { all_processes, this_process };

template <int D>
class TiledState final : public AnyState<D>, public PartOfMesh<D> {
 public:
  using typename AnyState<D>::Accept;
  using typename AnyState<D>::Named;

  /// Throws: Error(bad_option).
  explicit TiledState(const Options<D>& options);
  /// With so many tiles in all processes; 0: options.threads in each. `peers` must outlive it.
  /// Throws: likewise.
  /// With the points of this process alone the edits of a run are this process's share: each edit
  /// of all is one's, no matter whose. Requires then: no limits, and no bound of angles.
  TiledState(const Options<D>& options, Peers& peers, std::size_t tiles = 0,
             PointsOf points = PointsOf::all_processes);

  /// It throws NotInTiles, too; so does propagate() where there are limits of size or of angles,
  /// and NotInTilesYet.
  Change<D> first_run(Edits<D> edits, const RunControl& control, const Accept& accept) override;
  /// Points, and limits of size.
  [[nodiscard]] bool takes(const Edits<D>& edits) const noexcept override;
  [[nodiscard]] bool is_sooner_anew(const Edits<D>& edits) const noexcept override {
    return changes_all_limits(edits);
  }
  Change<D> propagate(const Edits<D>& edits, const RunControl& control,
                      const Accept& accept) override;

  [[nodiscard]] bool ran() const noexcept override { return tiles_ != nullptr; }
  /// The simplices of this process, and their vertices.
  [[nodiscard]] Mesh<D> mesh() const override;
  [[nodiscard]] Mesh<D> own_mesh() const override { return mesh(); }
  [[nodiscard]] Change<D> whole() const override;
  [[nodiscard]] bool has_features() const noexcept override { return false; }
  [[nodiscard]] MeshStats stats() const override;
  [[nodiscard]] const sac::Engine& engine() const noexcept override {
    return (*tiles_)[0].engine();
  }

  [[nodiscard]] std::size_t size() const noexcept override { return ids_.size(); }
  [[nodiscard]] typename Pending<D>::Place place(PointId id) const override;
  [[nodiscard]] std::optional<Named> obstacle(const Point<D>& p) const override;
  [[nodiscard]] std::vector<GraphPoint<D>> points() const override;

  void check_invariants() const override;

  [[nodiscard]] const TiledMesher<D>& tiles() const noexcept override { return *tiles_; }

 private:
  using Ids = std::unordered_map<PointId, VertexHandle>;
  using TileEdits = typename TiledMesher<D>::Edits;
  using TileChanges = typename TiledMesher<D>::Changes;
  using Located = typename TileMesher<D>::Located;

  // A point of the input.
  struct Name {
    PointId id{};
    std::optional<int> level;  // as its tile has been told; nothing: it has not
  };
  // What an update does here, so that it can be taken back, and what all tiles are told of it.
  struct Moves {
    std::vector<typename Ids::node_type> gone;
    std::vector<std::pair<PointId, VertexHandle>> come;
    std::vector<std::pair<VertexHandle, std::optional<int>>> levels;  // as they were
    std::vector<VertexHandle> ghosts_gone, ghosts_come;
    std::vector<VertexHandle> changed;  // whose level may be another; ghosts, and what is gone, too
    PointEdits<D> own, others;          // where points are divided: of this process's, and others'
    std::optional<LimitsOf<D>> limits;  // nothing: they stay
    CommonOrders<D> common;
    // Called where nothing may fail: make_room().
    [[nodiscard]] auto note() noexcept {
      return [this](const Vertex<D>& f) { changed.push_back(f.self); };
    }
  };

  [[nodiscard]] bool is_divided() const noexcept { return which_ == PointsOf::this_process; }
  [[nodiscard]] std::unique_ptr<TiledMesher<D>> make_all() const;
  void start(TiledMesher<D>& tiles, const typename TiledMesher<D>::Ask& ask);
  [[nodiscard]] std::unique_ptr<TiledMesher<D>> build(const typename TiledMesher<D>::Ask& ask);
  void find_levels(std::size_t threads);
  VertexHandle add_record(PointId id, const Point<D>& p);
  VertexHandle add_point(PointId id, const Point<D>& p);
  [[nodiscard]] bool is_own(VertexHandle h) const noexcept;
  [[nodiscard]] NamedPlace<D> named(const Vertex<D>& v) const { return {names_[v.self].id, v.p}; }
  void begin_limits(const Edits<D>& edits, Moves& moves);
  void note_places(const PointEdits<D>& edits, Moves& moves) const;
  static void make_room(Moves& moves);
  void make_gone(const PointEdits<D>& edits, Moves& moves);
  void make_come(const PointEdits<D>& edits, Moves& moves);
  [[nodiscard]] TileEdits told(Moves& moves);
  void take_back(Moves moves);
  // Of all processes, where each has its own points:
  void insert_divided(const PointEdits<D>& share, const TiledMesher<D>& tiles);
  void divide(const PointEdits<D>& share, Moves& moves);
  void ask_others(const TiledMesher<D>& tiles, Moves& moves);
  // Of this one:
  void make_ghosts_gone(Moves& moves);
  [[nodiscard]] bool add_ghost(const NamedPlace<D>& point, Moves& moves);

  Options<D> options_;
  Alone alone_;
  Peers& peers_;
  std::size_t tiles_wanted_ = 0;  // 0: as many as threads
  PointsOf which_ = PointsOf::all_processes;
  MeshBox<D> box_;
  VertexPool<D> points_;
  FeatureTree<D> features_;
  LimitsOf<D> limits_;
  Ids ids_;
  std::vector<Name> names_;       // by handle; of ghosts, too
  std::vector<Point<D>> sample_;  // where points are divided: that gives the cuts
  std::unique_ptr<TiledMesher<D>> tiles_;
  MeshStats stats_;
};

}  // namespace mesher::detail
