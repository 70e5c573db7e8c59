// A mesh in tiles: the mesh of points, with the bytes of one mesher for all.
//
// The points of the first run say where the cuts are. Tiles run at once, exchange messages, and run
// again until there are none. A first run settles bucket after bucket: births without what
// surrounds them would have others that nobody needs.
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "index/feature_tree.hpp"
#include "mesh/canonical.hpp"
#include "tiles/territory.hpp"
#include "tiles/tile.hpp"

namespace mesher::detail {

/// How tiles came to agree.
struct Exchanges {
  std::uint64_t rounds = 0;
  std::uint64_t messages = 0;
  std::uint64_t horizons = 0;  // of a first run
};

template <int D>
class TiledMesh {
 public:
  TiledMesh(const Options<D>& options, std::size_t tiles, std::size_t threads);
  ~TiledMesh();

  /// Requires: no run yet; places are apart.
  void first_run(const std::vector<Point<D>>& points);
  /// Points that go, and points that come, which are apart then. Requires: a run.
  void update(const std::vector<Point<D>>& gone, const std::vector<Point<D>>& come);

  [[nodiscard]] Mesh<D> mesh() const;
  [[nodiscard]] const Exchanges& counts() const noexcept { return counts_; }
  [[nodiscard]] std::size_t tiles() const noexcept { return tiles_.size(); }
  [[nodiscard]] const Tile<D>& tile(std::size_t t) const { return *tiles_[t]; }
  void check_invariants() const;

 private:
  template <class Act>
  void for_each_tile(Act&& act);
  VertexHandle add_point(const Point<D>& p);
  void settle();
  [[nodiscard]] bool exchange();

  Options<D> options_;
  MeshBox<D> box_;
  std::size_t wanted_, threads_;
  std::unique_ptr<Territories<D>> all_;
  std::vector<std::unique_ptr<Tile<D>>> tiles_;
  VertexPool<D> points_;  // the input
  FeatureTree<D> features_;
  std::unordered_map<Point<D>, VertexHandle, TurnHash<D>> handles_;
  std::vector<std::optional<int>> levels_;    // by handle, as tiles have been told
  std::vector<std::vector<Message<D>>> out_;  // by tile
  Exchanges counts_;
};

}  // namespace mesher::detail
