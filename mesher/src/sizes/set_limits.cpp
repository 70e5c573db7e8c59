// Limits of options.
#include <utility>

#include "mesher/sizes.hpp"
#include "sizes/all_limits.hpp"

namespace mesher {

void set_limits(Options<2>& options, const SizeLimits<2>& limits) {
  detail::AllLimits{limits, {}, options.region_limits}.apply_to(options);
}
void set_limits(Options<2>& options, const Box<2>& box, const SizeLimits<2>& limits) {
  auto all = detail::AllLimits::of(options);
  all.set_within(box, limits);
  std::move(all).apply_to(options);
}

}  // namespace mesher
