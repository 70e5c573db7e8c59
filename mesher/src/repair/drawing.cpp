// Rods are made once.
#include "repair/drawing.hpp"

namespace mesher::detail {

std::uint32_t Drawing<2>::rod(Spot s, Spot t) {
  const auto [it, is_new] = by_ends_.try_emplace(ends_key(s, t), rods_.size());
  if (is_new) rods_.push_back(place(s) < place(t) ? Rod{s, t, {}} : Rod{t, s, {}});
  return it->second;
}

void Drawing<2>::split(std::uint32_t rod_number, std::vector<Spot> through) {
  std::vector<Spot> chain =
      this->chain(rods_[rod_number].a, rods_[rod_number].b, std::move(through));
  for (std::size_t i = 1; i < chain.size(); ++i) rod(chain[i - 1], chain[i]);
  rods_[rod_number].through = std::move(chain);
}

// Rods get shorter as they are split, so this ends. Without recursion: that may be deep.
std::vector<Spot> Drawing<2>::way(Spot from, Spot to) const {
  std::vector<Spot> way{from};
  std::vector<Ends> ahead{{from, to}};
  while (!ahead.empty()) {
    const auto [s, t] = ahead.back();
    ahead.pop_back();
    const Rod& r = rods_[by_ends_.at(ends_key(s, t))];
    if (r.whole()) {
      way.push_back(t);
      continue;
    }
    const std::size_t n = r.through.size();
    for (std::size_t i = 0; i + 1 < n; ++i) {  // the first piece on top
      if (r.a == s) {
        ahead.emplace_back(r.through[n - 2 - i], r.through[n - 1 - i]);
      } else {
        ahead.emplace_back(r.through[i + 1], r.through[i]);
      }
    }
  }
  return way;
}

}  // namespace mesher::detail
