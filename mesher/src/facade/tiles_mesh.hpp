// The mesh that tiles have, as a finder of angles asks for it.
//
// A vertex that the world of the whole input has too is called as there; others are numbered behind
// these as they are met.
#pragma once

#include <tsl/robin_map.h>

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "program/world.hpp"
#include "tiles/tiled_mesher.hpp"

namespace mesher::detail {

class TilesMesh {
 public:
  using Triangle = std::array<VertexHandle, 3>;

  /// `whole`: with the whole input, and vertices at which segments were split before refinement.
  /// Requires: tiles agree.
  TilesMesh(World<sac::Scope>& whole, const TiledMesher<2>& tiles)
      : whole_(whole), tiles_(tiles), first_(whole.vertices.pool().end_of_handles()) {}

  [[nodiscard]] World<sac::Scope>& world() const noexcept { return whole_; }
  [[nodiscard]] const Vertex<2>& vertex(VertexHandle v) const {
    return v < first_ ? whole_.vertices.pool()[v] : others_[v - first_].vertex;
  }
  [[nodiscard]] Role role(const Vertex<2>& v) const {
    return v.self < first_ ? whole_.vertices.role(v) : others_[v.self - first_].role;
  }
  /// The vertex there.
  [[nodiscard]] VertexHandle handle_at(const Point<2>& p) const { return handle_of(place_of(p)); }
  /// All triangles.
  [[nodiscard]] std::vector<Triangle> triangles() const {
    std::vector<Triangle> all;
    for (std::uint32_t t = 0; t < tiles_.size(); ++t) {
      tiles_[t].for_each_own([&](const Triangle& own) { all.push_back(named(t, own)); });
    }
    return all;
  }
  template <class Visit>
  void for_each_triangle_at(const Vertex<2>& v, Visit&& visit) const {
    const auto it = homes_.find(v.self);
    const InTile home = it != homes_.end() ? it->second : place_of(v.p);
    vertices(home.tile).for_each_simplex_at(
        vertex(home), [&](const Triangle& own) { visit(named(home.tile, own)); });
  }

 private:
  struct InTile {
    std::uint32_t tile;
    VertexHandle handle;
  };
  struct Other {
    Vertex<2> vertex;
    Role role;
  };
  [[nodiscard]] const VertexIndex<sac::Scope, 2>& vertices(std::uint32_t tile) const {
    return tiles_[tile].world().vertices;
  }
  [[nodiscard]] const Vertex<2>& vertex(const InTile& v) const {
    return vertices(v.tile).pool()[v.handle];
  }
  // In the tile that owns it.
  [[nodiscard]] InTile place_of(const Point<2>& p) const {
    const auto tile = static_cast<std::uint32_t>(*tiles_.own_tile(p));
    return {tile, vertices(tile).tree().find(p)->self};
  }
  [[nodiscard]] Triangle named(std::uint32_t tile, const Triangle& own) const {
    return {handle_of({tile, own[0]}), handle_of({tile, own[1]}), handle_of({tile, own[2]})};
  }
  [[nodiscard]] VertexHandle handle_of(const InTile& v) const {
    const std::uint64_t key = std::uint64_t{v.tile} << 32 | v.handle;
    const auto it = handles_.find(key);
    if (it != handles_.end()) return it->second;
    const Vertex<2>& here = vertex(v);
    const bool is_own = tiles_[v.tile].border().owns(here.p);
    const VertexHandle handle = is_own ? add(v, here) : handle_of(place_of(here.p));
    handles_.emplace(key, handle);
    return handle;
  }
  VertexHandle add(const InTile& home, const Vertex<2>& v) const {
    const VertexHandle known = in_whole(v);
    const VertexHandle handle =
        known != 0 ? known : first_ + static_cast<VertexHandle>(others_.size());
    homes_.emplace(handle, home);
    if (known != 0) return known;
    Other& other = others_.emplace_back();
    other.vertex.p = v.p;
    other.vertex.self = handle;
    other.vertex.on_segment = v.on_segment;
    other.role = tiles_[home.tile].named(vertices(home.tile).role(v));
    return handle;
  }
  [[nodiscard]] VertexHandle in_whole(const Vertex<2>& v) const {
    if (!v.boundary && !v.input && !v.on_segment) return 0;
    const Vertex<2>* there = whole_.vertices.tree().find(v.p);
    const bool is = there != nullptr && (there->boundary || whole_.features.has(*there));
    return is ? there->self : 0;
  }

  World<sac::Scope>& whole_;
  const TiledMesher<2>& tiles_;
  VertexHandle first_;
  // Handles of two tiles would be one behind the other in the table.
  struct Mix {
    std::size_t operator()(std::uint64_t key) const noexcept { return sac::mix(key); }
  };
  mutable tsl::robin_map<std::uint64_t, VertexHandle, Mix> handles_;  // by tile and handle there
  mutable tsl::robin_map<VertexHandle, InTile> homes_;
  mutable std::deque<Other> others_;  // stay where they are
};

}  // namespace mesher::detail
