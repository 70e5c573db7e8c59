// What the mesher's calls share in space: besides what points need, the features of the input.
#pragma once

#include "plc/placed.hpp"
#include "plc/scan_features.hpp"
#include "program/point_world.hpp"

namespace mesher::detail {

template <class S>
struct World<S, 3> : PointWorld<S, 3> {
  using Base = PointWorld<S, 3>;
  using Base::box;
  using Base::features;
  using Base::vertices;
  using typename Base::Agenda;

  InputFeatures<S> plc;
  Agenda& splits;

  template <class Host>
  World(const Options<3>& options, const MeshBox<3>& mesh_box, Host& host)
      : Base(options, mesh_box, host),
        plc(vertices.pool()),
        splits(host.make_agenda("edges")) {
    host.set_environment(this);
  }

  void post_split(S& s, const EdgePiece& piece);
  /// A vertex that cuts the cell of v, in bucket b.
  void insert_beside(S& s, const Vertex<3>& v, CellOf<3>& cell, const Placed& y, int b);
  [[noreturn]] void fail_useless(const Vertex<3>& v, const Vertex<3>& x) const;
};

}  // namespace mesher::detail
