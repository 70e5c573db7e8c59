// Limits of options.
#include <utility>

#include "mesher/sizes.hpp"
#include "sizes/all_limits.hpp"

namespace mesher {

template <int D>
void set_limits(Options<D>& options, const SizeLimits<D>& limits) {
  detail::AllLimits<D>{limits, {}, options.region_limits}.apply_to(options);
}
template <int D>
void set_limits(Options<D>& options, const std::type_identity_t<Box<D>>& box,
                const SizeLimits<D>& limits) {
  auto all = detail::AllLimits<D>::of(options);
  all.set_within(box, limits);
  std::move(all).apply_to(options);
}

template void set_limits(Options<2>&, const SizeLimits<2>&);
template void set_limits(Options<2>&, const Box<2>&, const SizeLimits<2>&);
#ifndef MESHER_PLANE_ONLY
template void set_limits(Options<3>&, const SizeLimits<3>&);
template void set_limits(Options<3>&, const Box<3>&, const SizeLimits<3>&);
#endif

}  // namespace mesher
