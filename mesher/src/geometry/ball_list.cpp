// The distances of several centres at a time.
#include "geometry/ball_list.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "geometry/wide_lanes.hpp"

namespace mesher::detail {

namespace {

constexpr std::size_t kAtOnce = 8;

/// `columns`: each `room` long.
MESHER_WIDE_LANES bool any_meets(const double* columns, std::size_t room, std::size_t count,
                                 double x, double y, double z, double radius) noexcept {
  const double *xs = columns, *ys = xs + room, *zs = ys + room, *radii = zs + room;
  for (std::size_t k = 0; k < count; k += kAtOnce) {
    std::int64_t meets = 0;
    for (std::size_t i = k; i < k + kAtOnce; ++i) {
      const double dx = x - xs[i], dy = y - ys[i], dz = z - zs[i];
      const double within = radii[i] + radius;
      meets |= static_cast<std::int64_t>(dx * dx + dy * dy + dz * dz <= within * within);
    }
    if (meets != 0) return true;
  }
  return false;
}

}  // namespace

BallList::BallList(std::size_t most)
    : room_((most + kAtOnce - 1) / kAtOnce * kAtOnce),
      columns_(4 * room_, std::numeric_limits<double>::infinity()) {
  std::fill(columns_.end() - static_cast<std::ptrdiff_t>(room_), columns_.end(), 0.0);
}

void BallList::add(const Point<3>& centre, double radius) noexcept {
  for (std::size_t i = 0; i < 3; ++i) columns_[i * room_ + count_] = centre[i];
  columns_[3 * room_ + count_++] = radius;
}

bool BallList::meets(const Point<3>& centre, double radius) const noexcept {
  return any_meets(columns_.data(), room_, count_, centre[0], centre[1], centre[2], radius);
}

}  // namespace mesher::detail
