// What there is at small angles, tile by tile.
#include "facade/tile_angles.hpp"

#include <utility>

#include "facade/angle_finder.hpp"
#include "facade/held.hpp"
#include "facade/tile_mesh.hpp"
#include "sets/make_set.hpp"
#include "tiles/on_threads.hpp"

namespace mesher::detail {

namespace {

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
  std::vector<std::array<Point<2>, 3>> triangles;
  std::vector<Point<2>> corners;
};
std::vector<NewPlaces> by_tile(const TiledMesher<2>& tiles,
                               const std::vector<std::array<Point<2>, 3>>& triangles) {
  std::vector<NewPlaces> all(tiles.size());
  for (const auto& t : triangles) {
    all[*tiles.own_tile(t[0])].triangles.push_back(t);
    for (const Point<2>& p : t) all[*tiles.own_tile(p)].corners.push_back(p);
  }
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

AngleNews joined(std::vector<AngleParts> parts) {
  AngleParts all;
  for (AngleParts& part : parts) all.add(std::move(part));
  return std::move(all).news();
}

}  // namespace

AngleNews all_angles(World<sac::Scope, 2>& whole, const TiledMesher<2>& tiles, double rho) {
  if (whole.segments.store().live() == 0) return {};
  const Held segments(whole.segments.store());
  const Held features(whole.features);
  std::vector<AngleParts> parts(tiles.size());
  on_threads(tiles.size(), [&](std::size_t t) {
    const TileMesh mesh(whole, tiles[t], true);
    parts[t] = parts_of(mesh, all_in(tiles[t], mesh), rho);
  });
  return joined(std::move(parts));
}

AngleNews new_angles(World<sac::Scope, 2>& whole, const TiledMesher<2>& tiles, double rho,
                     const std::vector<std::array<Point<2>, 3>>& triangles) {
  if (whole.segments.store().live() == 0) return {};
  const Held segments(whole.segments.store());
  const Held features(whole.features);
  const std::vector<NewPlaces> places = by_tile(tiles, triangles);
  std::vector<AngleParts> parts(tiles.size());
  constexpr std::size_t kLittle = 256;  // triangles, for which no thread need be begun
  const std::size_t threads = triangles.size() < kLittle ? 1 : tiles.size();
  on_threads(threads, [&](std::size_t first) {
    for (std::size_t t = first; t < tiles.size(); t += threads) {
      if (places[t].corners.empty()) continue;
      const TileMesh mesh(whole, tiles[t], false);
      parts[t] = parts_of(mesh, named(places[t], mesh), rho);
    }
  });
  return joined(std::move(parts));
}

}  // namespace mesher::detail
