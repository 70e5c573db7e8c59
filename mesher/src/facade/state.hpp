// The state of a mesher, by its dimension.
#pragma once

#include "facade/plane_state.hpp"
#ifndef MESHER_PLANE_ONLY
#include "facade/space_state.hpp"
#endif

namespace mesher::detail {

template <int D>
struct StateIn;
template <>
struct StateIn<2> {
  using Type = PlaneState;
};
#ifndef MESHER_PLANE_ONLY
template <>
struct StateIn<3> {
  using Type = SpaceState;
};
#endif
template <int D>
using State = typename StateIn<D>::Type;

}  // namespace mesher::detail
