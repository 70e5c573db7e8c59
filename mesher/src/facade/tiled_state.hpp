// The state of a mesher of points in tiles: which point is whose, how crowded each is, the tiles.
//
// Where several processes have tiles of one mesh, each has such a state with all points, but its
// own tiles alone, and all do the same: what is asked of the mesh is then about the part of this
// process.
#pragma once

#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "facade/any_state.hpp"
#include "index/feature_tree.hpp"
#include "tiles/tiled_mesher.hpp"

namespace mesher::detail {

/// Whether a mesher that begins with these edits may be in tiles.
template <int D>
[[nodiscard]] bool may_be_tiled(const Options<D>& options, const Edits<D>& edits);
/// The same with lines in the plane (tiled_plane_state.hpp).
[[nodiscard]] bool may_have_lines_tiled(const Options<2>& options, const Edits<2>& edits);

template <int D>
class TiledState final : public AnyState<D> {
 public:
  using typename AnyState<D>::Accept;
  using typename AnyState<D>::Named;

  /// Throws: Error(bad_option).
  explicit TiledState(const Options<D>& options);
  /// With options.threads tiles in each process. `peers` must outlive it. Throws: likewise.
  TiledState(const Options<D>& options, Peers& peers);

  Change<D> first_run(Edits<D> edits, const RunControl& control, const Accept& accept) override;
  /// Points alone.
  [[nodiscard]] bool takes(const Edits<D>& edits) const noexcept override;
  Change<D> propagate(const Edits<D>& edits, const RunControl& control,
                      const Accept& accept) override;

  [[nodiscard]] bool ran() const noexcept override { return tiles_ != nullptr; }
  /// The simplices of this process, and their vertices.
  [[nodiscard]] Mesh<D> mesh() const override;
  [[nodiscard]] MeshStats stats() const override;
  [[nodiscard]] const sac::Engine& engine() const noexcept override {
    return (*tiles_)[0].engine();
  }

  [[nodiscard]] std::size_t size() const noexcept override { return ids_.size(); }
  [[nodiscard]] typename Pending<D>::Place place(PointId id) const override;
  [[nodiscard]] std::optional<Named> obstacle(const Point<D>& p) const override;
  [[nodiscard]] std::vector<GraphPoint<D>> points() const override;

  void check_invariants() const override;

  [[nodiscard]] const TiledMesher<D>& tiles() const noexcept { return *tiles_; }

 private:
  using Ids = std::unordered_map<PointId, VertexHandle>;
  using TileEdits = typename TiledMesher<D>::Edits;
  using TileChanges = typename TiledMesher<D>::Changes;

  // A point of the input.
  struct Name {
    PointId id{};
    std::optional<int> level;  // as its tile has been told; nothing: it has not
  };
  // What an update does here, so that it can be taken back.
  struct Moves {
    std::vector<typename Ids::node_type> gone;
    std::vector<std::pair<PointId, VertexHandle>> come;
    std::vector<std::pair<VertexHandle, std::optional<int>>> levels;  // as they were
  };

  void drop_others(Change<D>& change) const;
  [[nodiscard]] std::unique_ptr<TiledMesher<D>> build(const typename TiledMesher<D>::Ask& ask);
  void find_levels(std::size_t threads);
  VertexHandle add_point(PointId id, const Point<D>& p);
  [[nodiscard]] TileEdits make(const PointEdits<D>& edits, Moves& moves);
  void take_back(Moves moves);

  Options<D> options_;
  Alone alone_;
  Peers& peers_;
  MeshBox<D> box_;
  VertexPool<D> points_;
  FeatureTree<D> features_;
  Ids ids_;
  std::vector<Name> names_;  // by handle
  std::unique_ptr<TiledMesher<D>> tiles_;
  MeshStats stats_;
};

}  // namespace mesher::detail
