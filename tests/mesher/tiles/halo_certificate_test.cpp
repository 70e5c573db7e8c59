// The certificate of tiles with halos: it holds where halos are wide enough, and nothing that a
// tile and its neighbour do not agree on goes unseen.
#include "tiles/halo_certificate.hpp"

#include <catch2/catch.hpp>

#include "geometry/box.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/meshing.hpp"
#include "random.hpp"
#include "rules/mesh_box.hpp"

namespace {

using mesher::Point;
using mesher::PointKind;
using namespace mesher::detail;

// Uniform points in tiles, each with the points that are not farther away than `halo`.
template <int D>
struct Tiles {
  Tiles(std::size_t n, std::size_t count, double halo, std::uint64_t seed)
      : points(mesher::generate_points<D>(PointKind::uniform, n, seed)),
        tiles(bounding_box<D>(points), points, count) {
    options.domain = mesher::snapped_domain<D>(points);
    const MeshBox<D> box = mesh_box(options);
    const HaloInput<D> input{options, box, tiles, [](std::uint64_t number) {
                               return mesher::PointId{static_cast<std::int64_t>(number)};
                             }};
    for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
      std::vector<HaloPoint<D>> near;
      for (std::size_t i = 0; i < n; ++i) {
        if (tiles.distance(tile, points[i]) <= halo) near.push_back({points[i], i});
      }
      runs.push_back(run_for_tile(input, tile, near, [] {}));
    }
  }
  [[nodiscard]] bool confirmed(std::size_t tile, std::size_t other) const {
    const std::vector<std::span<const HaloLook<D>>> looks{those_of(tile, runs[other].looks)};
    return HaloWitness<D>(tiles, tile, runs[tile].vertices, looks).confirms(looks[0]);
  }
  [[nodiscard]] bool agree(std::size_t from, std::size_t to) const {
    return agree_on_births(runs[from].view, from, runs[to].view, to);
  }
  [[nodiscard]] bool all_agree() const {
    for (std::size_t a = 0; a < runs.size(); ++a) {
      for (std::size_t b = 0; b < runs.size(); ++b) {
        if (a != b && !(confirmed(a, b) && agree(a, b))) return false;
      }
    }
    return true;
  }

  std::vector<Point<D>> points;
  mesher::Options<D> options;
  HaloTiles<D> tiles;
  std::vector<HaloRun<D>> runs;
};

// The vertices of `tile` that `other` has seen in one of its looks, at the latest.
template <int D>
std::vector<std::uint32_t> seen(const Tiles<D>& all, std::size_t tile, std::size_t other) {
  const HaloVertices<D>& vertices = all.runs[tile].vertices;
  std::vector<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < vertices.places.size(); ++i) {
    const auto looks = those_of(tile, all.runs[other].looks);
    const bool is_seen = std::any_of(looks.begin(), looks.end(), [&](const HaloLook<D>& look) {
      return vertices.born[i].turn < look.turn && look.ball.contains(vertices.places[i]);
    });
    if (is_seen) seen.push_back(i);
  }
  return seen;
}

template <int D>
void check_losses(std::size_t n, double halo) {
  Tiles<D> all(n, 3, halo, 7);
  REQUIRE(all.all_agree());
  std::size_t vertices = 0, births = 0;
  for (std::size_t tile = 0; tile < all.runs.size(); ++tile) {
    for (std::size_t other = 0; other < all.runs.size(); ++other) {
      if (tile == other) continue;
      auto& own = all.runs[tile].vertices;
      const std::vector<std::uint32_t> which = seen(all, tile, other);
      for (std::size_t k = 0; k < which.size(); k += 1 + which.size() / 20) {
        const std::uint32_t i = which[k];
        ++vertices;
        ++own.born[i].bucket;  // it is completed later
        REQUIRE_FALSE(all.confirmed(tile, other));
        --own.born[i].bucket;
        const Point<D> place = own.places[i];
        own.places[i][0] += 1;  // it is not there
        REQUIRE_FALSE(all.confirmed(tile, other));
        own.places[i] = place;
      }
      auto& gives = all.runs[tile].view.gives;
      for (std::size_t k = 0; k < gives.size(); k += 1 + gives.size() / 20) {
        if (gives[k].tile != other) continue;
        ++births;
        const HaloBirth<D> birth = gives[k];
        gives.erase(gives.begin() + static_cast<std::ptrdiff_t>(k));
        REQUIRE_FALSE(all.agree(tile, other));
        gives.insert(gives.begin() + static_cast<std::ptrdiff_t>(k), birth);
      }
    }
  }
  REQUIRE(vertices > 40);
  REQUIRE(births > 10);
  REQUIRE(all.all_agree());
}

}  // namespace

TEST_CASE("tiles with wide halos agree, and each vertex or birth that is lost is missed") {
  check_losses<2>(1500, 0.4);
  check_losses<3>(300, 2);
}

TEST_CASE("tiles with narrow halos do not agree") {
  std::size_t wrong = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    if (!Tiles<2>(1000, 2, 0.02, seed).all_agree()) ++wrong;
    REQUIRE_FALSE(Tiles<2>(1000, 2, 0, seed).all_agree());
  }
  REQUIRE(wrong > 4);
}
