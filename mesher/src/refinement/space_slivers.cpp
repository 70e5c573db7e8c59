// Dihedral angles, and places of a lattice.
#include "refinement/space_slivers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "delaunay/facets.hpp"
#include "geometry/circumcentre.hpp"
#include "geometry/space_vectors.hpp"

namespace mesher::detail {

namespace {

// Of a floor, squared: what is shorter than an eighth of it comes of features that ask for each
// other.
constexpr double kBelow = 0x1p-6;
// How often slivers that have found no place are tried again.
constexpr int kRounds = 3;

}  // namespace

Slivers::Slivers(const MeshBox<3>& box, double rho, double min_dihedral, bool is_thorough)
    : rule_(box, min_dihedral), rho_(rho), is_thorough_(is_thorough) {}

void Slivers::start(const Kernel& kernel, const std::vector<VertexKind>& kinds) {
  started_ = true;
  floor2_.assign(kernel.places() + 1, std::numeric_limits<double>::infinity());
  const auto& simplices = kernel.simplices();
  kernel.for_each_finite([&](std::uint32_t s) {
    const auto& corners = simplices.corners(s);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const double d2 = squared_distance(kernel.place(corners[i]), kernel.place(corners[k]));
        for (const std::uint32_t v : {corners[i], corners[k]}) {
          floor2_[v] = std::min(floor2_[v], d2);
        }
      }
    }
  });
  for (std::uint32_t s = 0; s < simplices.places(); ++s) {
    if (simplices.alive(s)) look_at(kernel, kinds, s);
  }
}

std::array<std::uint32_t, 4> Slivers::sorted_corners(const Kernel& kernel, std::uint32_t s) {
  auto corners = kernel.simplices().corners(s);
  std::sort(corners.begin(), corners.end(),
            [&](auto v, auto w) { return kernel.place(v) < kernel.place(w); });
  return corners;
}

auto Slivers::entry_of(const Kernel& kernel, std::uint32_t s) -> Entry {
  const auto corners = sorted_corners(kernel, s);
  const auto at = [&](std::size_t i) -> const auto& { return kernel.place(corners[i]); };
  Entry entry{std::numeric_limits<double>::infinity(), at(0), s};
  for (std::size_t i = 1; i < 4; ++i) {
    entry.sum = plus(entry.sum, at(i));
    for (std::size_t k = 0; k < i; ++k) {
      entry.shortest2 = std::min(entry.shortest2, squared_distance(at(i), at(k)));
    }
  }
  return entry;
}

void Slivers::add(const Kernel& kernel, std::uint32_t s) {
  wait_[s] = Wait::queued;
  queue_.push(entry_of(kernel, s));
}

void Slivers::look_at(const Kernel& kernel, const std::vector<VertexKind>& kinds, std::uint32_t s) {
  wait_.resize(kernel.simplices().places(), Wait::none);
  if (kernel.is_ghost(s)) return;
  const auto& corners = kernel.simplices().corners(s);
  if (std::all_of(corners.begin(), corners.end(),
                  [&](std::uint32_t v) { return kinds[v] == VertexKind::boundary; })) {
    return;
  }
  if (score_of(kernel, s) > rule_.worst()) add(kernel, s);
}

double Slivers::score_of(const Kernel& kernel, std::uint32_t s) {
  const auto& c = kernel.simplices().corners(s);
  return SliverRule::score(
      {&kernel.place(c[0]), &kernel.place(c[1]), &kernel.place(c[2]), &kernel.place(c[3])});
}

void Slivers::before_fill(const Kernel& kernel, std::uint32_t v) {
  for (const std::uint32_t s : kernel.doomed()) {
    if (s < wait_.size()) wait_[s] = Wait::none;
  }
  floor2_.resize(kernel.places() + 1);
  if (dug_floor2_ != 0) {
    floor2_[v] = std::exchange(dug_floor2_, 0);
  } else {
    double least = std::numeric_limits<double>::infinity();
    kernel.for_each_in_link([&](std::uint32_t w) {
      if (w != kInfinite) least = std::min(least, floor2_[w]);
    });
    floor2_[v] = std::max(least, nearest2(kernel, v));
  }
}

std::uint32_t Slivers::take(const Kernel& kernel) {
  if (queue_.empty() && split_ != split_before_ && rounds_ < kRounds) {
    ++rounds_;
    split_before_ = split_;
    for (std::uint32_t s = 0; s < wait_.size(); ++s) {
      if (wait_[s] == Wait::left) add(kernel, s);
    }
  }
  while (!queue_.empty()) {
    const Entry entry = queue_.top();
    const std::uint32_t s = entry.simplex;
    queue_.pop();
    if (wait_[s] != Wait::queued || entry != entry_of(kernel, s)) continue;
    wait_[s] = Wait::none;
    return s;
  }
  return kNone;
}

std::size_t Slivers::left() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(wait_.begin(), wait_.end(), [](Wait w) { return w != Wait::none; }));
}

bool Slivers::is_below_floor(const Kernel& kernel, std::uint32_t s, double shortest2) const {
  return shortest2 < kBelow * least_floor2(kernel, s);
}

double Slivers::least_floor2(const Kernel& kernel, std::uint32_t s) const {
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t v : kernel.simplices().corners(s)) least = std::min(least, floor2_[v]);
  return least;
}

/// The other slivers around the corner of s that is the least.
void Slivers::find_beside(Kernel& kernel, std::uint32_t s) {
  beside_.clear();
  const std::uint32_t owner = sorted_corners(kernel, s)[0];
  static_cast<void>(kernel.find_in_star(owner, star_, [](std::uint32_t) { return false; }));
  for (const std::uint32_t t : star_) {
    if (t != s && wait_[t] != Wait::none) beside_.push_back(t);
  }
}

/// In which it gets a vertex: its own, of a poor one around the off-centre.
auto Slivers::ball_to_split(const Kernel& kernel, std::uint32_t s) const -> Ball {
  const auto corners = sorted_corners(kernel, s);
  const auto at = [&](std::size_t i) -> const auto& { return kernel.place(corners[i]); };
  // Nearly in a plane doubles have no digits of its centre, other ones in each order of the
  // corners.
  const auto [a, b, c] = facet_across<3>(kernel.simplices().corners(s),
                                         corner_of(kernel.simplices().corners(s), corners[0]));
  const Point<3> q = circumcentre(at(0), kernel.place(b), kernel.place(a), kernel.place(c)).q;
  const Point<3> centre = plus(at(0), q);
  const double radius2 = squared(q);
  double shortest2 = std::numeric_limits<double>::infinity();
  Point<3> end{}, middle{};  // of the shortest edge, of several the first by its places
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = i + 1; k < 4; ++k) {
      const Point<3>&p = at(i), &r = at(k);
      const double length2 = squared_distance(p, r);
      if (length2 >= shortest2) continue;
      shortest2 = length2;
      end = p, middle = scaled(0.5, plus(p, r));
    }
  }
  const double away = std::sqrt(squared_distance(centre, middle));
  const double most = rho_ * std::sqrt(shortest2);
  if (radius2 <= most * most || away <= most) return {centre, radius2};
  const Point<3> nearer = plus(middle, scaled(most / away, minus(centre, middle)));
  return {nearer, squared_distance(nearer, end)};
}

/// Of the points of a body-centred lattice in its ball, spaced by a power of two of the box's side,
/// at most half of the radius: those that take the most slivers first, of these those farthest from
/// the corners.
void Slivers::find_places(Kernel& kernel, std::uint32_t s) {
  places_.clear();
  find_beside(kernel, s);
  const auto& corners = kernel.simplices().corners(s);
  const auto [centre, radius2] = ball_to_split(kernel, s);
  rule_.for_each_place(centre, radius2, [&](const Point<3>& at, double) {
    Place place{0, std::numeric_limits<double>::infinity(), at};
    for (const std::uint32_t v : corners) {
      place.nearest2 = std::min(place.nearest2, squared_distance(at, kernel.place(v)));
    }
    for (const std::uint32_t other : beside_) place.takes += kernel.conflicts(other, at) ? 1 : 0;
    places_.push_back(place);
  });
  std::sort(places_.begin(), places_.end(), [](const Place& p, const Place& q) {
    if (p.takes != q.takes) return p.takes > q.takes;
    return p.nearest2 != q.nearest2 ? p.nearest2 > q.nearest2 : p.at < q.at;
  });
  if ((rounds_ == 0 || !is_thorough_) && places_.size() > rule_.most())
    places_.resize(rule_.most());
}

/// The worst of the tetrahedra around v; what is not below `enough` may be less than that.
double Slivers::score_of_dug(const Kernel& kernel, std::uint32_t v, double enough) {
  double worst = -1;
  kernel.for_each_facet_of_hole([&](const std::array<std::uint32_t, 3>& facet) {
    if (worst >= enough) return;
    worst = std::max(worst, SliverRule::score({&kernel.place(v), &kernel.place(facet[0]),
                                               &kernel.place(facet[1]), &kernel.place(facet[2])}));
  });
  return worst;
}

double Slivers::nearest2(const Kernel& kernel, std::uint32_t v) {
  double least = std::numeric_limits<double>::infinity();
  kernel.for_each_in_link([&](std::uint32_t w) {
    if (w != kInfinite) least = std::min(least, squared_distance(kernel.place(w), kernel.place(v)));
  });
  return least;
}

}  // namespace mesher::detail
