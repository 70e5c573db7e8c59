// What limits say of places and boxes.
#include "sizes/limits.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/box.hpp"
#include "input.hpp"
#include "io/text.hpp"
#include "make_set.hpp"
#include "mesher/error.hpp"
#include "sizes/region_limits.hpp"

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
      widest_(box.side),
      regions_(options.region_limits) {
  parts_.reserve(options.box_limits.size() + 1);
  add_part(domain_, {options.max_area, options.sizes});
  for (const BoxLimits<2>& part : options.box_limits) add_part(part.box, part.limits);
  if (regions_ != nullptr) {
    for (const double area : regions_->areas()) add_plateau(spacing(area));
  }
  const auto limits = [](const Part& p) { return p.area != kNone || p.sizes != nullptr; };
  const bool asked = any_ || std::any_of(parts_.begin(), parts_.end(), limits);
  if (asked && options.rule != Rule::radius_edge) {
    refuse("limits of size need the rule radius-edge");
  }
  make_set(plateaus_);
}

void Limits::add_part(const Box<2>& box, const SizeLimits<2>& limits) {
  if (!(box.lo[0] <= box.hi[0] && box.lo[1] <= box.hi[1])) refuse("a box of limits is empty");
  if (!(limits.max_area >= 0)) refuse("max_area must be above 0");
  const double area = limits.max_area != 0 ? limits.max_area : kNone;
  parts_.push_back({box, area, add_plateau(spacing(area)), limits.sizes});
  if (limits.sizes == nullptr) return;
  any_ = true;
  if (bands_.empty()) add_bands();
  for (const double h : limits.sizes->plateaus()) {
    parts_.back().has_plateaus = true;
    add_plateau(spacing(area_of_size(h)));
  }
}

// Returns its pitch.
double Limits::add_plateau(double spacing) {
  if (spacing >= widest_) return kNone;
  any_ = true;
  plateaus_.push_back(even_pitch(spacing));
  return plateaus_.back();
}

// From the smallest that is not too small.
void Limits::add_bands() {
  constexpr std::array<double, 4> kQuarters{1, 1.189207115002721, 1.4142135623730951,
                                            1.681792830507429};
  int exponent = std::ilogb(coordinates_) - (53 - 4 - kFewestBits);
  for (;; ++exponent) {
    for (const double quarter : kQuarters) {
      const double spacing = std::ldexp(quarter, exponent);
      if (spacing >= widest_) return;
      const int bits = bits_of_pitch(spacing, coordinates_);
      if (bits >= kFewestBits) bands_.push_back({spacing, rounded_down(spacing, bits)});
    }
  }
}

// --- Places ----------------------------------------------------------------------------------

Limits::Look Limits::look(const Point<2>& p) const {
  if (!contains(domain_, p)) return {kNone, kNone};
  if (regions_ == nullptr) return asked_at(p);
  const RegionLimits::Limit there = regions_->at(p);
  if (!there.counts) return {kNone, kNone};
  const Look asked = asked_at(p);
  return there.area < asked.area ? Look{there.area, 0, true} : asked;
}

// Where limits count.
Limits::Look Limits::asked_at(const Point<2>& p) const {
  std::size_t i = parts_.size() - 1;
  while (i > 0 && !contains(parts_[i].box, p)) --i;
  return look(parts_[i], p);
}

Limits::Look Limits::look(const Part& part, const Point<2>& p) const {
  if (part.sizes == nullptr) return {part.area, part.pitch};
  const double h = part.sizes->at(p);
  if (!(h > 0)) refuse("the size at " + place_text(p) + " is not above 0");
  const double area = area_of_size(h);
  if (part.area <= area) return {part.area, part.pitch};
  return {area, 0, part.has_plateaus};
}

double Limits::pitch_for(const Look& look) const {
  if (look.pitch != 0) return look.pitch;
  const double s = spacing(look.area);
  if (s >= widest_) return kNone;
  return look.even ? even_pitch(s) : band_pitch(s);
}

// Requires: a finite spacing.
void Limits::require_not_small(double spacing) const {
  if (spacing > 0 && bits_of_pitch(spacing, coordinates_) >= kFewestBits) return;
  fail_too_small(spacing, coordinates_);
}

double Limits::even_pitch(double spacing) const {
  require_not_small(spacing);
  return rounded_down(spacing, bits_of_pitch(spacing, coordinates_));
}

double Limits::band_pitch(double spacing) const {
  if (spacing < bands_.front().spacing) fail_too_small(spacing, coordinates_);
  const auto above = std::upper_bound(bands_.begin(), bands_.end(), spacing,
                                      [](double x, const Band& b) { return x < b.spacing; });
  return (above - 1)->pitch;
}

// --- Boxes -----------------------------------------------------------------------------------

Limits::Spread Limits::spread(const Part& part, const Box<2>& box) const {
  const double widest = spacing(part.area);
  if (part.sizes == nullptr) return {widest, widest, true};
  const SizeRange sizes = part.sizes->range(box);
  const auto of = [&](double h) { return spacing(std::min(part.area, area_of_size(h))); };
  const Spread found{of(sizes.least), of(std::max(sizes.least, sizes.most)),
                     sizes.even && part.has_plateaus};
  if (!(found.least >= widest_)) require_not_small(found.least);
  return found.least == widest ? Spread{widest, widest, true} : found;
}

// Of places in the domain.
Limits::Spread Limits::spacings_in(const Box<2>& box) const {
  const Box<2> inside = common(box, domain_);
  if (is_empty(inside)) return {kNone, kNone, true};
  if (regions_ == nullptr) return asked_in(inside);
  const RegionLimits::Range there = regions_->range(inside);
  if (!there.some) return {kNone, kNone, true};
  const Spread asked = asked_in(inside);
  const double least = spacing(there.least), most = spacing(there.most);
  return {std::min(asked.least, least), there.all ? std::min(asked.most, most) : kNone,
          asked.even || most <= asked.least};
}

// What lies behind a part that has all of the box is hidden.
Limits::Spread Limits::asked_in(const Box<2>& inside) const {
  std::size_t i = parts_.size() - 1;
  while (i > 0 && !contains(parts_[i].box, inside)) --i;
  Spread all = spread(parts_[i], inside);
  while (++i < parts_.size()) {
    const Box<2> there = common(inside, parts_[i].box);
    if (is_empty(there)) continue;
    const Spread more = spread(parts_[i], there);
    all = {std::min(all.least, more.least), std::max(all.most, more.most), all.even && more.even};
  }
  return all;
}

Limits::Pitches Limits::pitches_in(const Box<2>& box) const {
  if (!any()) return {};
  const Spread spacings = spacings_in(box);
  if (spacings.least >= widest_) return {};
  if (uniform()) return {parts_.front().pitch, parts_.front().pitch, true};
  const double least = spacings.even ? even_pitch(spacings.least) : band_pitch(spacings.least);
  return {least, spacings.most, spacings.even};
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

}  // namespace mesher::detail
