// Directions, and the longest of a range of them.
#include "plane/leg_fan.hpp"

#include <algorithm>
#include <cmath>

namespace mesher::detail {

namespace {

constexpr double kPi = 3.141592653589793;
constexpr double k20 = kPi / 9, k60 = kPi / 3;
constexpr double kTan20 = 0.36397023426620236;
constexpr double kTan60 = 1.7320508075688772;
constexpr double kDoubt = 1e-9;  // far above the errors of directions and of is_narrower

Point<2> along(const Segment& s, VertexHandle apex) {
  const Point<2>& o = s.a == apex ? s.place_a : s.place_b;
  const Point<2>& e = s.a == apex ? s.place_b : s.place_a;
  return {e[0] - o[0], e[1] - o[1]};
}

void take(LongestBeside& all, const Point<2>& u, const Point<2>& w, double length) {
  if (is_narrower(u, w, kTan20)) {
    all.within_20 = std::max(all.within_20, length);
  } else if (is_narrower(u, w, kTan60)) {
    all.within_60 = std::max(all.within_60, length);
  }
}

}  // namespace

LongestBeside longest_beside(const SegmentStore& segments, const Segment& s, VertexHandle end) {
  const Point<2> u = along(s, end);
  LongestBeside all;
  segments.visit_at(end, [&](const Segment& t) {
    if (t.self != s.self) take(all, u, along(t, end), t.length);
  });
  return all;
}

// --- One point -------------------------------------------------------------------------------

LegFan::LegFan(const SegmentStore& segments, VertexHandle apex) : apex_(apex) {
  segments.visit_at(apex, [&](const Segment& s) {
    const Point<2> u = along(s, apex);
    legs_.push_back({std::atan2(u[1], u[0]), u, s.self});
  });
  std::sort(legs_.begin(), legs_.end(), [](const Leg& x, const Leg& y) {
    return std::pair(x.direction, x.self) < std::pair(y.direction, y.self);
  });
  longest_.resize(2 * legs_.size());
  for (std::size_t i = 0; i < legs_.size(); ++i) {
    longest_[legs_.size() + i] = segments.pool()[legs_[i].self].length;
  }
  for (std::size_t i = legs_.size(); i-- > 1;) {
    longest_[i] = std::max(longest_[2 * i], longest_[2 * i + 1]);
  }
}

std::size_t LegFan::first_from(double direction) const {
  const auto before = [](const Leg& leg, double d) { return leg.direction < d; };
  return static_cast<std::size_t>(std::lower_bound(legs_.begin(), legs_.end(), direction, before) -
                                  legs_.begin());
}

std::size_t LegFan::index_of(const Segment& s) const {
  const Point<2> u = along(s, apex_);
  std::size_t i = first_from(std::atan2(u[1], u[0]));
  while (legs_[i].self != s.self) ++i;
  return i;
}

double LegFan::longest(std::size_t from, std::size_t to) const {
  double most = 0;
  for (from += legs_.size(), to += legs_.size(); from < to; from /= 2, to /= 2) {
    if (from % 2 == 1) most = std::max(most, longest_[from++]);
    if (to % 2 == 1) most = std::max(most, longest_[--to]);
  }
  return most;
}

// Calls visit(from, to) for the legs with directions in [from, to), a turn more or less.
template <class Visit>
void LegFan::visit_ranges(double from, double to, Visit&& visit) const {
  for (const double turn : {-2 * kPi, 0.0, 2 * kPi}) {
    visit(first_from(from + turn), first_from(to + turn));
  }
}

LongestBeside LegFan::beside(const Segment& s) const {
  const std::size_t self = index_of(s);
  const double direction = legs_[self].direction;
  const Point<2>& u = legs_[self].along;
  LongestBeside all;
  const auto certain = [&](double from, double to, double& most) {
    visit_ranges(direction + from, direction + to, [&](std::size_t i, std::size_t j) {
      const bool has_self = i <= self && self < j;
      most = std::max({most, longest(i, has_self ? self : j), has_self ? longest(self + 1, j) : 0});
    });
  };
  const auto doubtful = [&](double angle) {
    visit_ranges(direction + angle - kDoubt, direction + angle + kDoubt,
                 [&](std::size_t i, std::size_t j) {
                   for (; i < j; ++i) take(all, u, legs_[i].along, longest_[legs_.size() + i]);
                 });
  };
  certain(-k20 + kDoubt, k20 - kDoubt, all.within_20);
  certain(-k60 + kDoubt, -k20 - kDoubt, all.within_60);
  certain(k20 + kDoubt, k60 - kDoubt, all.within_60);
  for (const double angle : {-k60, -k20, k20, k60}) doubtful(angle);
  return all;
}

// --- Points ----------------------------------------------------------------------------------

LongestBeside LegFans::longest_beside(const SegmentStore& segments, const Segment& s,
                                      VertexHandle end) {
  if (const auto it = fans_.find(end); it != fans_.end()) return it->second.beside(s);
  const Point<2> u = along(s, end);
  LongestBeside all;
  int count = 0;
  const bool many = segments.visit_at(end, [&](const Segment& t) {
    if (++count > kFew) return true;
    if (t.self != s.self) take(all, u, along(t, end), t.length);
    return false;
  });
  if (!many) return all;
  return fans_.emplace(end, LegFan(segments, end)).first->second.beside(s);
}

std::size_t LegFans::bytes() const noexcept {
  std::size_t all = 0;
  for (const auto& fan : fans_) all += sizeof(fan) + 2 * sizeof(void*) + fan.second.bytes();
  return all;
}

}  // namespace mesher::detail
