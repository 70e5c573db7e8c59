// The table of buckets.
#include "rules/buckets.hpp"

#include <cmath>
#include <limits>

namespace mesher::detail {

namespace {

constexpr std::uint64_t kUnits = std::uint64_t{1} << kLevels;  // along a side of the box

// A length kept as a float in units of the box's side, as observations store it.
double representable(double length, double side) {
  const double x = length / side;
  auto f = static_cast<float>(x);
  if (double{f} < x) f = std::nextafter(f, std::numeric_limits<float>::infinity());
  return double{f} * side;
}

// The side of a square, in units, so that points of different squares of one colour, a whole square
// apart, are farther apart than `length`: one unit more, as places are rounded down to units.
std::uint64_t square_side(double length, double unit) {
  const double units = length / unit;
  return units < static_cast<double>(kUnits) ? static_cast<std::uint64_t>(units) + 2 : kUnits;
}

}  // namespace

template <int D>
Buckets<D>::Buckets(double rho, const Promise& promise, const MeshBox<D>& box)
    : unit_(box.cell_side(kLevels)) {
  // No length is below side * 2^-51 (two points differ in their finest cell or a neighbouring
  // one) nor above the box's diagonal.
  for (double start = box.side * 0x1p-52; start < 2 * box.side; start *= rho) {
    start2_.push_back(start * start);
    const double clip = std::min(promise.gamma * rho * start * (1 + 0x1p-20), 2 * box.side);
    clip_.push_back(representable(clip, box.side));
    square_.push_back(square_side((kReads<D> + promise.inserts) * clip_.back(), unit_));
  }
}

template <int D>
int Buckets<D>::bucket(double length2) const {
  const auto above = std::upper_bound(start2_.begin() + 1, start2_.end(), length2);
  return static_cast<int>(above - start2_.begin()) - 1;
}

template <int D>
double Buckets<D>::independent(int b) const {
  return static_cast<double>(square_[index(b)] - 1) * unit_;
}

template <int D>
unsigned Buckets<D>::colour(const Fixed<D>& f, int b) const {
  unsigned colour = 0;
  for (unsigned i = 0; i < D; ++i) {
    colour |= static_cast<unsigned>(f[i] / square_[index(b)] & 1) << i;
  }
  return colour;
}

template class Buckets<2>;
#ifndef MESHER_PLANE_ONLY
template class Buckets<3>;
template class Buckets<4>;
#endif

}  // namespace mesher::detail
