// The lattice of a limit.
#include "sizes/limits.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/plane.hpp"
#include "io/text.hpp"
#include "mesher/error.hpp"

namespace mesher::detail {

namespace {

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorCode::bad_option, what); }

// x rounded down to so many bits.
double rounded_down(double x, int bits) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(std::floor(std::ldexp(mantissa, bits)), exponent - bits);
}

// The pitch of the lattice for a spacing: of kBits bits, or of so many that a point's numerator,
// up to 2^3 times the pitch's times the coordinate in pitches (Lattice::place), has 53.
double pitch_for(double spacing, double coordinates) {
  constexpr int kBits = 12, kFewest = 6, kDouble = 53;
  const int bits = std::min(kBits, kDouble - 4 - std::ilogb(coordinates / spacing));
  if (bits < kFewest) {
    refuse("a spacing of " + text::to_text(spacing) +
           " is too small for double precision at coordinates of " + text::to_text(coordinates));
  }
  return rounded_down(spacing, bits);
}

double largest_coordinate(const Box<2>& domain) {
  double most = 0;
  for (int i = 0; i < 2; ++i) {
    most = std::max({most, std::abs(domain.lo[i]), std::abs(domain.hi[i])});
  }
  return most;
}

}  // namespace

Limits::Limits(const Options<2>& options, const MeshBox<2>& box) : domain_(options.domain) {
  if (options.max_area == 0) return;
  if (!(options.max_area > 0)) refuse("max_area must be above 0");
  if (options.rule != Rule::radius_edge) refuse("limits of size need the rule radius_edge");
  const double spacing = std::sqrt(options.max_area / Lattice::kArea);
  if (!(spacing < box.side)) return;  // every triangle fits
  area_ = options.max_area;
  pitch_ = pitch_for(spacing, largest_coordinate(domain_));
}

// The lattice is kept out of the balls of leaves [rules A7.1]: the gap must not be larger than what
// a lattice's triangle leaves.
bool Limits::is_long(const Point<2>& a, const Point<2>& b) const {
  constexpr double kLongest = 1.4;
  const Point<2> middle{a[0] + (b[0] - a[0]) / 2, a[1] + (b[1] - a[1]) / 2};
  const double least = std::min({area(a), area(b), area(middle)});
  return squared_distance(a, b) > kLongest * kLongest * (least / Lattice::kArea);
}

bool Limits::is_amid(const Lattice& lattice, const LatticePoint& q) const {
  const auto around = Lattice::around(q);
  return std::all_of(around.begin(), around.end(),
                     [&](const LatticePoint& n) { return is_candidate(lattice, n); });
}

std::vector<Limits::Candidate> Limits::candidates(const MeshBox<2>& box, const Cell<2>& c) const {
  std::vector<Candidate> found;
  const Lattice lattice(pitch_);
  lattice.visit_in(box.box_of(c), [&](const LatticePoint& q) {
    const Point<2> p = lattice.place(q);
    const bool here = box.contains(p) && MeshBox<2>::cell(box.fixed(p), c.level) == c;
    if (here && is_candidate(lattice, q)) found.push_back({p, pitch_, is_amid(lattice, q)});
    return false;
  });
  return found;
}

}  // namespace mesher::detail
