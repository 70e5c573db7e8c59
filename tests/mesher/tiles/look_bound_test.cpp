// First runs in tiles that look too often are given up.
#include <catch2/catch.hpp>

#include "index/feature_tree.hpp"
#include "mesher/extra/generate.hpp"
#include "rules/mesh_box.hpp"
#include "tiles/tiled_mesher.hpp"

namespace {

using mesher::Point;
using mesher::detail::TiledMesher;

template <int D>
struct Run {
  mesher::Options<D> options;
  std::vector<Point<D>> points;
  mesher::detail::Alone peers;
  TiledMesher<D> tiles;

  Run(std::size_t n, std::size_t wanted)
      : options(options_for()),
        points(mesher::generate_points<D>(mesher::PointKind::uniform, n, 1)),
        tiles(options, mesher::detail::mesh_box(options), points, wanted, 2, peers) {}

  static mesher::Options<D> options_for() {
    mesher::Options<D> options;
    options.domain.hi.fill(1);
    return options;
  }

  void first_run() {
    mesher::detail::VertexPool<D> pool;
    const auto box = mesher::detail::mesh_box(options);
    mesher::detail::FeatureTree<D> tree(box, pool);
    for (const Point<D>& p : points) tree.insert_only(pool.create(p));
    typename TiledMesher<D>::Edits edits(tiles.size());
    typename mesher::detail::FeatureTree<D>::Path path;
    pool.for_each([&](const auto& v) {
      const auto tile = tiles.own_tile(v.p);
      using Located = typename mesher::detail::TileMesher<D>::Located;
      edits[*tile].push_back({v.p, std::nullopt, Located(tree.crowded_level(v, path))});
    });
    tiles.first_run(edits, {});
  }
};

template <int D>
void check(std::size_t n) {
  Run<D> free(n, 3);
  free.first_run();
  const auto expected = free.tiles.mesh();

  Run<D> bounded(n, 3);  // as products are: a usual run is far below
  bounded.tiles.bound_looks({.more = 1000});
  bounded.first_run();
  CHECK(bounded.tiles.mesh() == expected);

  Run<D> narrow(n, 3);
  narrow.tiles.bound_looks({.a_call = 0, .more = 200});
  CHECK_THROWS_AS(narrow.first_run(), mesher::detail::TooManyLooks);

  Run<D> single(n, 1);  // one tile has nothing to look at
  single.tiles.bound_looks({.a_call = 0, .more = 0});
  single.first_run();
  CHECK(single.tiles.mesh() == expected);
}

}  // namespace

TEST_CASE("a first run in tiles ends where there are too many looks, and not before") {
  check<2>(400);
  check<3>(80);
}
