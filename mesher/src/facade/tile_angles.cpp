// What there is at small angles, tile by tile.
#include "facade/tile_angles.hpp"

#include <algorithm>
#include <utility>

#include "facade/angle_finder.hpp"
#include "facade/held.hpp"
#include "facade/tile_mesh.hpp"
#include "sets/make_set.hpp"
#include "tiles/on_threads.hpp"

namespace mesher::detail {

namespace {

using Triangle = std::array<Point<2>, 3>;

// What is new in a tile: triangles that it outputs, and its own vertices among their corners.
struct NewInTile {
  std::vector<TileMesh::Triangle> triangles;
  std::vector<VertexHandle> corners;
};

// All of it.
NewInTile all_in(const TileMesher<2>& tile, const TileMesh& mesh) {
  NewInTile all;
  tile.for_each_own([&](const auto& t) { all.triangles.push_back(mesh.named(t)); });
  tile.world().vertices.pool().for_each([&](const Vertex<2>& v) {
    if (v.alive && !v.boundary && tile.border().owns(v.p)) all.corners.push_back(mesh.name(v.self));
  });
  return all;
}

// By tile, the triangles and corners that are for it to look at.
struct NewPlaces {
  std::vector<Triangle> triangles;
  std::vector<Point<2>> corners;
};
// `others`: triangles that tiles of other processes output.
std::vector<NewPlaces> by_tile(const TiledMesher<2>& tiles, const std::vector<Triangle>& triangles,
                               const std::vector<Triangle>& others) {
  std::vector<NewPlaces> all(tiles.size());
  const auto add_corners = [&](const Triangle& t) {
    for (const Point<2>& p : t) {
      if (const auto tile = tiles.own_tile(p)) all[*tile].corners.push_back(p);
    }
  };
  for (const Triangle& t : triangles) {
    all[*tiles.own_tile(t[0])].triangles.push_back(t);
    add_corners(t);
  }
  for (const Triangle& t : others) add_corners(t);
  for (NewPlaces& places : all) make_set(places.corners);
  return all;
}

NewInTile named(const NewPlaces& places, const TileMesh& mesh) {
  NewInTile all;
  for (const auto& t : places.triangles) {
    all.triangles.push_back({mesh.name_at(t[0]), mesh.name_at(t[1]), mesh.name_at(t[2])});
  }
  for (const Point<2>& p : places.corners) all.corners.push_back(mesh.name_at(p));
  return all;
}

AngleParts parts_of(const TileMesh& mesh, const NewInTile& come, double rho) {
  return AngleFinder<TileMesh>(mesh, rho).parts(come.triangles, come.corners);
}

// --- What processes tell each other

// A wedge by its apex and its segments' numbers.
struct ForcedThere {
  Point<2> apex;
  std::array<std::uint32_t, 2> segments;
  SmallAngle angle;
};

void pack(const AngleParts& parts, const WholeWorld& whole, Packer& to) {
  std::vector<ForcedThere> forced;
  const auto& pool = whole.world.vertices.pool();
  for (const auto& [wedge, angle] : parts.forced) {
    const auto& [apex, s, t] = wedge;
    forced.push_back({pool[apex].p, {whole.numbers.of(s), whole.numbers.of(t)}, angle});
  }
  to.put_all(forced);
  to.put(std::uint64_t{parts.shrunk.size()});
  for (const ShrunkVertex& v : parts.shrunk) {
    to.put(v.at), to.put(v.nearest), to.put(v.feature_size), to.put(v.degrees);
    to.put_all(v.lines);
  }
}
AngleParts unpack_parts(Unpacker bytes, const WholeWorld& whole) {
  AngleParts parts;
  for (const ForcedThere& f : bytes.take_all<ForcedThere>()) {
    const VertexHandle apex = whole.world.vertices.tree().find(f.apex)->self;
    const auto [s, t] =
        std::minmax({whole.numbers.handle(f.segments[0]), whole.numbers.handle(f.segments[1])});
    parts.forced.emplace(std::array{apex, s, t}, f.angle);
  }
  const auto shrunk = bytes.take<std::uint64_t>();
  for (std::uint64_t i = 0; i < shrunk; ++i) {
    ShrunkVertex& v = parts.shrunk.emplace_back();
    v.at = bytes.take<Point<2>>();
    v.nearest = bytes.take<double>(), v.feature_size = bytes.take<double>();
    v.degrees = bytes.take<double>();
    v.lines = bytes.take_all<LineId>();
  }
  return parts;
}

// Of all processes.
AngleNews joined(std::vector<AngleParts> parts, const WholeWorld& whole) {
  AngleParts all;
  Packer mine;
  together(whole.peers, [&] {
    for (AngleParts& part : parts) all.add(std::move(part));
    if (!whole.peers.is_alone()) pack(all, whole, mine);
  });
  if (whole.peers.is_alone()) return std::move(all).news();
  const std::vector<Bytes> told = whole.peers.gather(mine.bytes());
  AngleNews news;
  together(whole.peers, [&] {
    all = {};
    for (const Bytes& one : told) all.add(unpack_parts(Unpacker(one), whole));
    news = std::move(all).news();
  });
  return news;
}

// Triangles of others at whose corners something is new here.
std::vector<Triangle> triangles_of_others(const std::vector<Triangle>& own,
                                          const TiledMesher<2>& tiles, Peers& peers) {
  std::vector<Triangle> others;
  if (peers.is_alone()) return others;
  Packer mine;
  together(peers, [&] {
    std::vector<Triangle> shared;
    for (const Triangle& t : own) {
      const bool is_own =
          std::all_of(t.begin(), t.end(), [&](const auto& p) { return !!tiles.own_tile(p); });
      if (!is_own) shared.push_back(t);
    }
    mine.put_all(shared);
  });
  const std::vector<Bytes> told = peers.gather(mine.bytes());
  together(peers, [&] {
    for (std::size_t k = 0; k < told.size(); ++k) {
      if (k == peers.self()) continue;
      const auto some = Unpacker(told[k]).take_all<Triangle>();
      others.insert(others.end(), some.begin(), some.end());
    }
  });
  return others;
}

}  // namespace

AngleNews all_angles(const WholeWorld& whole, const TiledMesher<2>& tiles, double rho) {
  World<sac::Scope, 2>& world = whole.world;
  if (world.segments.store().live() == 0) return {};
  std::vector<AngleParts> parts;
  together(whole.peers, [&] {
    const Held segments(world.segments.store());
    const Held features(world.features);
    parts.resize(tiles.size());
    on_threads(tiles.size(), [&](std::size_t t) {
      const TileMesh mesh(world, tiles[t], true);
      parts[t] = parts_of(mesh, all_in(tiles[t], mesh), rho);
    });
  });
  return joined(std::move(parts), whole);
}

AngleNews new_angles(const WholeWorld& whole, const TiledMesher<2>& tiles, double rho,
                     const std::vector<Triangle>& triangles) {
  World<sac::Scope, 2>& world = whole.world;
  if (world.segments.store().live() == 0) return {};
  const std::vector<Triangle> others = triangles_of_others(triangles, tiles, whole.peers);
  std::vector<AngleParts> parts;
  together(whole.peers, [&] {
    const Held segments(world.segments.store());
    const Held features(world.features);
    const std::vector<NewPlaces> places = by_tile(tiles, triangles, others);
    parts.resize(tiles.size());
    constexpr std::size_t kLittle = 256;  // triangles, for which no thread need be begun
    const std::size_t threads = triangles.size() < kLittle ? 1 : tiles.size();
    on_threads(std::min(threads, tiles.size()), [&](std::size_t first) {
      for (std::size_t t = first; t < tiles.size(); t += threads) {
        if (places[t].corners.empty()) continue;
        const TileMesh mesh(world, tiles[t], false);
        parts[t] = parts_of(mesh, named(places[t], mesh), rho);
      }
    });
  });
  return joined(std::move(parts), whole);
}

}  // namespace mesher::detail
