// The mesh that a tile has around its own vertices, as a finder of angles asks for it.
//
// A point of the input is named by its handle in the world of the whole input, any other vertex by
// the tile's own handle behind all of these.
#pragma once

#include <array>
#include <vector>

#include "program/world.hpp"
#include "tiles/tile_mesher.hpp"

namespace mesher::detail {

class TileMesh {
 public:
  using Triangle = std::array<VertexHandle, 3>;

  /// `whole`: with the whole input. `for_all`: names will be asked for again and again, so they are
  /// kept. Requires: tiles agree.
  TileMesh(World<sac::Scope>& whole, const TileMesher<2>& tile, bool for_all)
      : whole_(whole), tile_(tile), first_(whole.vertices.pool().end_of_handles()) {
    if (!for_all) return;
    names_.assign(own_vertices().pool().end_of_handles(), 0);
    own_vertices().pool().for_each([&](const Vertex<2>& v) {
      if (v.alive) names_[v.self] = name_of(v);
    });
  }

  [[nodiscard]] World<sac::Scope>& world() const noexcept { return whole_; }
  [[nodiscard]] const Vertex<2>& vertex(VertexHandle name) const {
    return name < first_ ? whole_.vertices.pool()[name] : own_vertices().pool()[name - first_];
  }
  [[nodiscard]] Role role(VertexHandle name) const {
    if (name < first_) return whole_.vertices.role(vertex(name));
    return tile_.named(own_vertices().role(vertex(name)));
  }
  /// Requires: the tile has a vertex there.
  [[nodiscard]] VertexHandle name_at(const Point<2>& p) const {
    return name(own_vertices().tree().find(p)->self);
  }
  /// Of a vertex, by the tile's handle.
  [[nodiscard]] VertexHandle name(VertexHandle own) const {
    return names_.empty() ? name_of(own_vertices().pool()[own]) : names_[own];
  }
  [[nodiscard]] Triangle named(const Triangle& own) const {
    return {name(own[0]), name(own[1]), name(own[2])};
  }
  /// Requires: the vertex is the tile's own.
  template <class Visit>
  void for_each_triangle_at(VertexHandle name, Visit&& visit) const {
    const Vertex<2>& v = name < first_ ? *own_vertices().tree().find(vertex(name).p) : vertex(name);
    own_vertices().for_each_simplex_at(v, [&](const Triangle& own) { visit(named(own)); });
  }

 private:
  [[nodiscard]] const VertexIndex<sac::Scope, 2>& own_vertices() const {
    return tile_.world().vertices;
  }
  // A tile knows of its own vertices whether they are points of the input, not of others'.
  [[nodiscard]] VertexHandle name_of(const Vertex<2>& v) const {
    const bool may_be_input =
        !v.boundary && !v.on_segment && (v.input || !tile_.border().owns(v.p));
    if (may_be_input) {
      const Vertex<2>* there = whole_.vertices.tree().find(v.p);
      if (there != nullptr && there->input) return there->self;
    }
    return first_ + v.self;
  }

  World<sac::Scope>& whole_;
  const TileMesher<2>& tile_;
  VertexHandle first_;
  std::vector<VertexHandle> names_;  // by the tile's handle; empty: they are not kept
};

}  // namespace mesher::detail
