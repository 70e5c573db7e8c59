// Pitches and candidates.
#include "sizes/limits.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/box.hpp"
#include "geometry/plane.hpp"
#include "input.hpp"
#include "io/text.hpp"
#include "mesher/error.hpp"

namespace mesher::detail {

namespace {

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorCode::bad_option, what); }

[[noreturn]] void fail_too_small(double spacing, double coordinates) {
  refuse("a spacing of " + text::to_text(spacing) +
         " is too small for double precision at coordinates up to " + text::to_text(coordinates));
}

double rounded_down(double x, int bits) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(std::floor(std::ldexp(mantissa, bits)), exponent - bits);
}

// How many bits a pitch of about `spacing` has, 12 at most. The numerator of a lattice point
// (Lattice::place) is up to 2^3 times that of the pitch times the coordinate in pitches: 53 bits.
int bits_of_pitch(double spacing, double coordinates) {
  return std::min(12, 53 - 4 - std::ilogb(coordinates / spacing));
}
constexpr int kFewestBits = 6;

// Areas are computed to within 2^-45.
constexpr double kFits = 1 - 0x1p-40;

double largest_coordinate(const Box<2>& domain) {
  double most = 0;
  for (int i = 0; i < 2; ++i) {
    most = std::max({most, std::abs(domain.lo[i]), std::abs(domain.hi[i])});
  }
  return most;
}

double area_of_size(double h) { return kAreaOfSize * h * h; }

}  // namespace

Limits::Limits(const Options<2>& options, const MeshBox<2>& box)
    : domain_(options.domain),
      coordinates_(largest_coordinate(options.domain)),
      sizes_(options.sizes) {
  if (options.max_area == 0 && sizes_ == nullptr) return;
  if (!(options.max_area >= 0)) refuse("max_area must be above 0");
  if (options.rule != Rule::radius_edge) refuse("limits of size need the rule radius_edge");
  if (options.max_area != 0) area_ = options.max_area;
  const double widest = std::min(spacing(area_), box.side);
  if (sizes_ != nullptr) add_bands(widest);
  if (spacing(area_) < box.side) {
    if (bits_of_pitch(widest, coordinates_) < kFewestBits) fail_too_small(widest, coordinates_);
    add_pitch(widest);
    pitches_.push_back({kNone, kNone});
  } else if (sizes_ != nullptr) {
    pitches_.push_back({box.side, kNone});
  }
}

// Spacings of one pitch have one lattice.
void Limits::add_pitch(double spacing) {
  const double pitch = rounded_down(spacing, bits_of_pitch(spacing, coordinates_));
  if (pitches_.empty() || pitches_.back().pitch != pitch) pitches_.push_back({spacing, pitch});
}

// Those below `end`, from the smallest that is not too small; of a field with plateaus, theirs.
void Limits::add_bands(double end) {
  std::vector<double> plateaus = sizes_->plateaus();
  std::sort(plateaus.begin(), plateaus.end());
  for (const double h : plateaus) {
    const double plateau = spacing(area_of_size(h));
    if (bits_of_pitch(plateau, coordinates_) < kFewestBits) fail_too_small(plateau, coordinates_);
    if (plateau < end) add_pitch(plateau);
  }
  if (!plateaus.empty()) return;
  constexpr std::array<double, 4> kQuarters{1, 1.189207115002721, 1.4142135623730951,
                                            1.681792830507429};
  int exponent = std::ilogb(coordinates_) - (53 - 4 - kFewestBits);
  for (;; ++exponent) {
    for (const double quarter : kQuarters) {
      const double spacing = std::ldexp(quarter, exponent);
      if (spacing >= end) return;
      if (bits_of_pitch(spacing, coordinates_) >= kFewestBits) add_pitch(spacing);
    }
  }
}

double Limits::area(const Point<2>& p) const {
  if (!contains(domain_, p)) return kNone;
  if (sizes_ == nullptr) return area_;
  const double h = sizes_->at(p);
  if (!(h > 0)) refuse("the size at " + place_text(p) + " is not above 0");
  return std::min(area_, area_of_size(h));
}

double Limits::pitch_for(double spacing) const {
  if (spacing < pitches_.front().spacing) fail_too_small(spacing, coordinates_);
  const auto above = std::upper_bound(pitches_.begin(), pitches_.end(), spacing,
                                      [](double x, const Pitch& p) { return x < p.spacing; });
  return (above - 1)->pitch;
}

// Of those in the domain; kNone if none are.
SizeRange Limits::spacings_in(const Box<2>& box) const {
  const Box<2> inside{{std::max(box.lo[0], domain_.lo[0]), std::max(box.lo[1], domain_.lo[1])},
                      {std::min(box.hi[0], domain_.hi[0]), std::min(box.hi[1], domain_.hi[1])}};
  if (inside.lo[0] > inside.hi[0] || inside.lo[1] > inside.hi[1]) return {kNone, kNone};
  if (sizes_ == nullptr) return {spacing(area_), spacing(area_)};
  const SizeRange sizes = sizes_->range(inside);
  const auto of = [&](double h) { return spacing(std::min(area_, area_of_size(h))); };
  const SizeRange found{of(sizes.least), of(std::max(sizes.least, sizes.most))};
  if (!(found.least >= pitches_.front().spacing)) fail_too_small(found.least, coordinates_);
  return found;
}

SizeRange Limits::pitches_in(const Box<2>& box) const {
  if (!any()) return {kNone, kNone};
  const SizeRange spacings = spacings_in(box);
  return {pitch_for(spacings.least), pitch_for(spacings.most)};
}

// The lattice is kept out of the balls of leaves [rules A7.1]: the gap must not be larger than what
// a lattice's triangle leaves. The spacing is the least in the ball, not only on the piece: so the
// lattice's points that a leaf blocks have its ends near by.
bool Limits::is_long(const Point<2>& a, const Point<2>& b) const {
  constexpr double kLongest = 1.4;
  if (!any()) return false;
  const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
  const Point<2> middle{a[0] + (b[0] - a[0]) / 2, a[1] + (b[1] - a[1]) / 2};
  return length > kLongest * spacings_in(around(middle, length / 2)).least;
}

template <class Visit>
bool Limits::visit_pitches(const SizeRange& range, Visit&& visit) const {
  for (const Pitch& p : pitches_) {
    if (p.pitch >= range.least && p.pitch <= range.most && p.pitch < kNone && visit(p.pitch)) {
      return true;
    }
  }
  return false;
}

bool Limits::is_candidate(const Lattice& lattice, const LatticePoint& q) const {
  const Point<2> p = lattice.place(q);
  const double own = lattice.pitch();
  if (pitch(p) != own) return false;
  if (sizes_ == nullptr) return true;
  const double clear = own / 2;
  const Box<2> near = around(p, clear);
  const SizeRange smaller{pitches_in(near).least, std::nextafter(own, 0)};
  return !visit_pitches(smaller, [&](double pitch) {
    const Lattice other(pitch);
    return other.visit_in(near, [&](const LatticePoint& n) {
      return squared_distance(other.place(n), p) < clear * clear && is_candidate(other, n);
    });
  });
}

bool Limits::fits(const Lattice& lattice, const std::array<LatticePoint, 3>& t) const {
  const Point<2> middle = centroid({lattice.place(t[0]), lattice.place(t[1]), lattice.place(t[2])});
  return Lattice::kArea * lattice.pitch() * lattice.pitch() <= area(middle) * kFits;
}

// Whether a candidate of another lattice is in the circumcircle of a triangle at q: as near to one
// of its corners as the circumradius.
bool Limits::is_between(const Lattice& lattice, const LatticePoint& q) const {
  const double own = lattice.pitch(), radius = Lattice::kCircumradius * own;
  const Point<2> p = lattice.place(q);
  const auto near_corner = [&](const Point<2>& x) {
    const auto six = Lattice::around(q);
    return squared_distance(p, x) < radius * radius ||
           std::any_of(six.begin(), six.end(), [&](const LatticePoint& n) {
             return squared_distance(lattice.place(n), x) < radius * radius;
           });
  };
  const Box<2> near = around(p, 2 * radius);
  return visit_pitches(pitches_in(near), [&](double pitch) {
    const Lattice other(pitch);
    return pitch != own && other.visit_in(near, [&](const LatticePoint& n) {
      return near_corner(other.place(n)) && is_candidate(other, n);
    });
  });
}

bool Limits::is_amid(const Lattice& lattice, const LatticePoint& q) const {
  const auto six = Lattice::around(q);
  for (const LatticePoint& n : six) {
    if (!is_candidate(lattice, n)) return false;
  }
  if (sizes_ == nullptr) return true;
  for (std::size_t i = 0; i < six.size(); ++i) {
    if (!fits(lattice, {q, six[i], six[(i + 1) % six.size()]})) return false;
  }
  return !is_between(lattice, q);
}

std::vector<Limits::Candidate> Limits::candidates(const MeshBox<2>& box, const Cell<2>& c) const {
  std::vector<Candidate> found;
  const Box<2> area = box.box_of(c);
  visit_pitches(pitches_in(area), [&](double pitch) {
    const Lattice lattice(pitch);
    lattice.visit_in(area, [&](const LatticePoint& q) {
      const Point<2> p = lattice.place(q);
      const bool here = box.contains(p) && MeshBox<2>::cell(box.fixed(p), c.level) == c;
      if (here && is_candidate(lattice, q)) found.push_back({p, pitch, is_amid(lattice, q)});
      return false;
    });
    return false;
  });
  return found;
}

}  // namespace mesher::detail
