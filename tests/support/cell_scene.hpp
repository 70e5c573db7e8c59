// A vertex and others around it, for the tests of clipped Voronoi cells in the plane and in space.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "cells/cell_of.hpp"
#include "mesher/extra/generate.hpp"
#include "records/vertex.hpp"

template <int D>
struct CellScene {
  using Cell = mesher::detail::CellOf<D>;
  using Vertex = mesher::detail::Vertex<D>;
  struct Site {
    mesher::Point<D> p;
    std::uint32_t code;
  };

  mesher::detail::VertexPool<D> pool;
  Vertex* v = nullptr;
  std::vector<Vertex*> others;
  double radius = 1;

  /// The first is v. A place that is taken is left out.
  void add(const mesher::Point<D>& p) {
    if (v != nullptr && p == v->p) return;
    for (const auto* u : others) {
      if (u->p == p) return;
    }
    auto& fresh = pool.create(p);
    v == nullptr ? void(v = &fresh) : others.push_back(&fresh);
  }
  void shuffle(mesher::SplitMix64& random) {
    for (std::size_t k = others.size(); k > 1; --k) {
      std::swap(others[k - 1], others[random.below(k)]);
    }
  }
  static void cut_by(Cell& cell, const Vertex& w) {
    if (cell.cuts(w.p)) cell.cut(w.self);
  }
  /// Makes it v's cell among the others.
  void cut_by_all(Cell& cell) const {
    cell.reset(*v, radius);
    for (const auto* w : others) cut_by(cell, *w);
  }
  /// Who may be a neighbour: the clip's virtual vertices and the others.
  [[nodiscard]] std::vector<Site> sites() const {
    Cell clip;
    clip.reset(*v, radius);
    std::vector<Site> all;
    for (int i = 0; i < clip.size(); ++i) all.push_back({clip.place(i), clip.code(i)});
    for (const auto* u : others) {
      // A vertex at a virtual neighbour's place takes it.
      std::erase_if(all, [&](const Site& s) { return s.p == u->p; });
      all.push_back({u->p, u->self});
    }
    return all;
  }
};
