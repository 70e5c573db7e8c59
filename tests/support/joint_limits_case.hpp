// Limits of size on several processes: at every step the mesh, the change and the errors are those
// of one, whatever happens on the way.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "joint_case.hpp"
#include "random_limits.hpp"

namespace support {

inline constexpr double kLimitedSide = 16;  // of all domains here

template <int D>
std::vector<mesher::Point<D>> limited_points(mesher::PointKind kind, std::size_t n,
                                             std::uint64_t seed) {
  auto points = mesher::generate_points<D>(kind, n, seed);
  const mesher::Box<D> box = mesher::snapped_domain<D>(points);
  for (auto& p : points) {
    for (std::size_t i = 0; i < D; ++i) {
      p[i] = (p[i] - box.lo[i]) / (box.hi[i] - box.lo[i]) * kLimitedSide;
    }
  }
  return points;
}

template <int D>
mesher::Options<D> limited_options(int threads, const mesher::SizeLimits<D>& limits) {
  mesher::Options<D> options;
  options.domain.lo.fill(0);
  options.domain.hi.fill(kLimitedSide);
  options.threads = threads;
  options.max_measure = limits.max_measure;
  options.sizes = limits.sizes;
  return options;
}

/// `Make`: makes a mesher of several processes with these options.
template <class Make>
void check_limits_in_plane(const Make& make, std::size_t self, std::size_t size,
                           mesher::PointKind kind, std::size_t n, int steps, std::uint64_t seed) {
  const auto points = limited_points<2>(kind, n, seed);
  RandomLimits limits(seed);  // the same in all
  auto joint = make(limited_options<2>(1 + static_cast<int>(seed % 2), {.max_measure = 0.4375}));
  JointCase<2, std::remove_reference_t<decltype(*joint)>> both(*joint, self, size, points, seed);
  for (int step = 0; step < steps; ++step) {
    for (std::uint64_t i = limits.below(4); i > 0; --i) both.edit_any();
    if (limits.below(6) == 0) both.limit(std::nullopt, limits.limits());
    for (std::uint64_t i = limits.below(3); i > 0; --i) both.limit(limits.box(), limits.limits());
    both.update("step " + std::to_string(step));
  }
}

template <class Make>
void check_limits_in_space(const Make& make, std::size_t self, std::size_t size,
                           mesher::PointKind kind, std::size_t n, int steps, std::uint64_t seed) {
  const auto points = limited_points<3>(kind, n, seed);
  mesher::SplitMix64 random(seed);  // the same in all
  const auto sloped = std::make_shared<mesher::SlopedSizes<3>>(
      [](const mesher::Point<3>& p) { return 1.5 + 0.3 * std::hypot(p[0] - 7, p[1] - 9); }, 0.3,
      1.5);
  const mesher::SizeLimits<3> limits[] = {
      {.max_measure = 8}, {.max_measure = 3}, {}, {.sizes = sloped}};
  auto joint = make(limited_options<3>(1, limits[seed % 2 == 0 ? 0 : 3]));
  JointCase<3, std::remove_reference_t<decltype(*joint)>> both(*joint, self, size, points, seed);
  for (int step = 0; step < steps; ++step) {
    for (std::uint64_t i = random.below(4); i > 0; --i) both.edit_any();
    mesher::Box<3> box;
    for (std::size_t i = 0; i < 3; ++i) {
      box.lo[i] = std::floor(kLimitedSide * random.unit());
      box.hi[i] = box.lo[i] + 1 + 4 * random.unit();
    }
    if (random.below(2) == 0) both.limit(box, limits[random.below(4)]);
    both.update("step " + std::to_string(step));
  }
}

/// Limits that cannot be kept, too many vertices, and limits that processes do not have in common.
template <class Make>
void check_limits_refused(const Make& make, std::size_t self, std::size_t size) {
  using Sizes = mesher::SlopedSizes<2>;
  const auto points = limited_points<2>(mesher::PointKind::uniform, 30, 3);
  const auto tiny = std::make_shared<Sizes>(
      [](const mesher::Point<2>& p) { return p[0] > 9 && p[1] > 9 ? 1e-15 : 2.0; }, 0, 1e-15);
  const auto none = std::make_shared<Sizes>(
      [](const mesher::Point<2>& p) { return p[0] > 9 && p[1] > 9 ? -1 : 1.0; }, 0.1, 0.1);
  const auto good =
      std::make_shared<Sizes>([](const mesher::Point<2>& p) { return 1 + 0.1 * p[0]; }, 0.1, 1);
  auto options = limited_options<2>(1, {.max_measure = 0.4375});
  options.max_vertices = 4000;
  auto joint = make(options);
  JointCase<2, std::remove_reference_t<decltype(*joint)>> both(*joint, self, size, points, 9);
  const mesher::Box<2> inner{{2, 2}, {14, 14}};
  using Box = std::optional<mesher::Box<2>>;
  for (const auto& sizes : {tiny, none}) {
    for (const Box& box : {Box(), Box(inner)}) {
      both.edit(1, mesher::Point<2>{4.5, box ? 7.5 : 6.5});
      both.limit(box, {.sizes = sizes});
      demand(!both.update("a field that cannot be kept"), "a field that cannot be kept");
    }
  }
  for (const double area : {1e-6, 0.0}) {
    both.limit(inner, {.max_measure = area});
    const bool is_done = both.update("an area that cannot be kept");
    demand(is_done == (area == 0), "an area that cannot be kept");
  }
  for (const double area : {-1.0, std::nan("")}) {  // one process says so at once
    const std::string refused = said_by([&] { both.one().limit({.max_measure = area}); });
    if (self == size - 1) joint->limit({.max_measure = area});
    demand(said_by([&] { joint->update(); }) == refused && !refused.empty(), "no area");
    both.check("no area");
  }
  both.limit(std::nullopt, {.sizes = good});
  demand(both.update("a good field"), "a good field");
  if (size == 1) return;
  const auto refused = [&](const char* why) {
    const auto update = [&] { static_cast<void>(joint->update()); };
    demand(code_of(update) == mesher::ErrorCode::bad_option, why);
    both.check(why);
  };
  if (self == 0) joint->limit({.sizes = good});
  refused("a function of one process alone");
  joint->limit({.sizes = self == 0 ? good : none});
  refused("functions that say different things");
  self == 0 ? joint->limit({.sizes = good}) : joint->limit(inner, {.sizes = good});
  refused("functions for different boxes");
  both.edit(2, mesher::Point<2>{1.25, 3.5});
  demand(both.update("after what was refused"), "after what was refused");
}

/// An update with limits that one process stops.
template <class Make>
void check_limits_stopped(const Make& make, std::size_t self, std::size_t size) {
  const auto points = limited_points<2>(mesher::PointKind::uniform, 300, 2);
  auto joint = make(limited_options<2>(1, {.max_measure = 0.1}));
  JointCase<2, std::remove_reference_t<decltype(*joint)>> both(*joint, self, size, points, 5);
  for (const bool everywhere : {false, true}) {
    bool stopped = true;
    for (int after = 0; stopped && after < 60; after = 2 * after + 1) {
      if (self == 0) {
        for (std::int64_t i = 2; i < 200; i += 3) joint->remove(mesher::PointId{i});
      }
      if (self == size - 1) joint->limit({{2, 3}, {11, 12}}, {.max_measure = 0.04});
      if (self == 0 && everywhere) joint->limit({.max_measure = 0.06});
      int asked = 0;
      mesher::RunControl control;
      if (self == size - 1) {
        control.progress = [&](const mesher::Progress&) { return asked++ < after; };
      }
      const auto code = code_of([&] { static_cast<void>(joint->update(control)); });
      stopped = code.has_value();
      if (!stopped) break;
      demand(code == mesher::ErrorCode::cancelled, "cancelled");
      joint->discard_edits();
      both.check("cancelled after " + std::to_string(after));
    }
    if (!stopped) return;  // it is not that of `both` any more
  }
}

}  // namespace support
