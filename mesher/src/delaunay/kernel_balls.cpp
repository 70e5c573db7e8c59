// The kernel whose simplices have their balls with them.
#include "delaunay/kernel.hpp"
#include "delaunay/kernel_check_impl.hpp"
#include "delaunay/kernel_dig_impl.hpp"
#include "delaunay/kernel_fill_impl.hpp"
#include "delaunay/kernel_impl.hpp"
#include "delaunay/kernel_measure_impl.hpp"
#include "delaunay/kernel_remove_impl.hpp"

namespace mesher::detail {

template class DelaunayKernel<2, BallLayout<2>>;
#ifndef MESHER_PLANE_ONLY
template class DelaunayKernel<3, BallLayout<3>>;
#endif

}  // namespace mesher::detail
