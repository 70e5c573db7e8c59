// The kernel of triangulations and meshes, whose simplices have corners and neighbours.
#include "delaunay/kernel.hpp"

#include "delaunay/kernel_check_impl.hpp"
#include "delaunay/kernel_dig_impl.hpp"
#include "delaunay/kernel_fill_impl.hpp"
#include "delaunay/kernel_impl.hpp"
#include "delaunay/kernel_remove_impl.hpp"

namespace mesher::detail {

template class DelaunayKernel<2>;
#ifndef MESHER_PLANE_ONLY
template class DelaunayKernel<3>;
#endif

}  // namespace mesher::detail
