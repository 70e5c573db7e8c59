// Points and rods are made once.
#include "repair/drawing.hpp"

#include <algorithm>

namespace mesher::detail {

std::uint32_t Drawing::rod(Spot s, Spot t) {
  const auto [it, is_new] = by_ends_.try_emplace(key(s, t), rods_.size());
  if (is_new) rods_.push_back(place(s) < place(t) ? Rod{s, t, {}} : Rod{t, s, {}});
  return it->second;
}

void Drawing::split(std::uint32_t rod_number, std::vector<Spot> through) {
  const Rod r = rods_[rod_number];
  const Point<2>&a = place(r.a), &b = place(r.b);
  const auto along = [&](Spot s) {
    return (place(s)[0] - a[0]) * (b[0] - a[0]) + (place(s)[1] - a[1]) * (b[1] - a[1]);
  };
  std::sort(through.begin(), through.end(), [&](Spot s, Spot t) {
    const double x = along(s), y = along(t);
    return x != y ? x < y : place(s) < place(t);
  });
  std::vector<Spot> chain{r.a};
  for (const Spot s : through) {  // the next round has what is left out
    if (s != chain.back() && length2(chain.back(), s) < length2(r.a, r.b)) chain.push_back(s);
  }
  chain.push_back(r.b);
  for (std::size_t i = 1; i < chain.size(); ++i) rod(chain[i - 1], chain[i]);
  rods_[rod_number].through = std::move(chain);
}

}  // namespace mesher::detail
