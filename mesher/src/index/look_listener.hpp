// Who wants to know of the observations of vertices: a tile, of those that look beyond it.
#pragma once

#include "index/observers.hpp"

namespace mesher::detail {

template <int D>
class LookListener {
 public:
  /// The running call has looked at the cell of `center` up to `radius`, or, if that is negative,
  /// for the nearest vertex. May throw.
  virtual void looked(const Vertex<D>& center, const Observation<D>& o, double radius) = 0;
  /// What it saw is forgotten.
  virtual void forgot(const Vertex<D>& center, const Observation<D>& o) noexcept = 0;

 protected:
  ~LookListener() = default;
};

}  // namespace mesher::detail
