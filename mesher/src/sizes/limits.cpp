// What limits say of places and boxes.
#include "sizes/limits.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/box.hpp"
#include "geometry/input_point.hpp"
#include "mesher/error.hpp"
#include "sets/make_set.hpp"
#include "sizes/region_limits.hpp"
#include "text/text.hpp"

namespace mesher::detail {

namespace {

[[noreturn]] void refuse_limit(const std::string& what) {
  throw Error(ErrorCode::bad_option, what);
}

[[noreturn]] void fail_too_small(double spacing, double coordinates) {
  refuse_limit("a spacing of " + text::to_text(spacing) +
               " is too small for double precision at coordinates up to " +
               text::to_text(coordinates));
}

// Not so if a side is not a number.
template <int D>
bool is_ordered(const Box<D>& box) {
  for (std::size_t i = 0; i < D; ++i) {
    if (!(box.lo[i] <= box.hi[i])) return false;
  }
  return true;
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

template <int D>
double largest_coordinate(const Box<D>& domain) {
  double most = 0;
  for (std::size_t i = 0; i < D; ++i) {
    most = std::max({most, std::abs(domain.lo[i]), std::abs(domain.hi[i])});
  }
  return most;
}

}  // namespace

template <int D>
Limits<D>::Limits(const Options<D>& options, const MeshBox<D>& box)
    : domain_(options.domain),
      coordinates_(largest_coordinate(options.domain)),
      widest_(box.side),
      regions_(options.region_limits) {
  parts_.reserve(options.box_limits.size() + 1);
  add_part(domain_, {options.max_measure, options.sizes});
  for (const BoxLimits<D>& part : options.box_limits) add_part(part.box, part.limits);
  if (options.growth != 0 && bands_.empty()) add_bands();
  if (regions_ != nullptr) {
    for (const double measure : regions_->measures()) add_plateau(spacing(measure));
  }
  const auto limits = [](const Part& p) { return p.measure != kNone || p.sizes != nullptr; };
  const bool asked = any_ || std::any_of(parts_.begin(), parts_.end(), limits);
  if (asked && options.rule != Rule::radius_edge) {
    refuse_limit("limits of size need the rule radius-edge");
  }
  make_set(plateaus_);
}

template <int D>
void Limits<D>::add_part(const Box<D>& box, const SizeLimits<D>& limits) {
  if (!is_ordered(box)) refuse_limit("a box of limits is empty");
  if (!(limits.max_measure >= 0)) refuse_limit("max_measure must be above 0");
  const double measure = limits.max_measure != 0 ? limits.max_measure : kNone;
  parts_.push_back({box, measure, add_plateau(spacing(measure)), limits.sizes});
  if (limits.sizes == nullptr) return;
  any_ = true;
  if (bands_.empty()) add_bands();
  for (const double h : limits.sizes->plateaus()) {
    parts_.back().has_plateaus = true;
    add_plateau(spacing(measure_of_size<D>(h)));
  }
}

// Returns its pitch.
template <int D>
double Limits<D>::add_plateau(double spacing) {
  if (spacing >= widest_) return kNone;
  any_ = true;
  plateaus_.push_back(even_pitch(spacing));
  return plateaus_.back();
}

// From the smallest that is not too small.
template <int D>
void Limits<D>::add_bands() {
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

template <int D>
auto Limits<D>::look(const Point<D>& p) const -> Look {
  if (!contains(domain_, p)) return {kNone, kNone};
  if (regions_ == nullptr) return asked_at(p);
  const typename RegionLimits<D>::Limit there = regions_->at(p);
  if (!there.counts) return {kNone, kNone};
  const Look asked = asked_at(p);
  return there.measure < asked.measure ? Look{there.measure, 0, true} : asked;
}

// Where limits count.
template <int D>
auto Limits<D>::asked_at(const Point<D>& p) const -> Look {
  std::size_t i = parts_.size() - 1;
  while (i > 0 && !contains(parts_[i].box, p)) --i;
  return look(parts_[i], p);
}

template <int D>
auto Limits<D>::look(const Part& part, const Point<D>& p) const -> Look {
  if (part.sizes == nullptr) return {part.measure, part.pitch};
  const double h = part.sizes->at(p);
  if (!(h > 0)) refuse_limit("the size at " + place_text(p) + " is not above 0");
  const double measure = measure_of_size<D>(h);
  if (part.measure <= measure) return {part.measure, part.pitch};
  return {measure, 0, part.has_plateaus};
}

template <int D>
double Limits<D>::pitch_for(const Look& look) const {
  if (look.pitch != 0) return look.pitch;
  const double s = spacing(look.measure);
  if (s >= widest_) return kNone;
  return look.even ? even_pitch(s) : band_pitch(s);
}

template <int D>
double Limits<D>::pitch_for_measure(const Point<D>& p, double measure, bool varies) const {
  const Look there = look(p);
  return measure == there.measure ? pitch_for(there) : pitch_for({measure, 0, !varies});
}

template <int D>
double Limits<D>::least_measure() const {
  double least = kNone;
  const auto take = [&](double measure) { least = std::min(least, measure); };
  for (const Part& part : parts_) {
    take(part.measure);
    if (part.sizes != nullptr) take(measure_of_size<D>(part.sizes->range(part.box).least));
  }
  if (regions_ != nullptr) {
    for (const double measure : regions_->measures()) take(measure);
  }
  return least;
}

// Requires: a finite spacing.
template <int D>
void Limits<D>::require_not_small(double spacing) const {
  if (spacing > 0 && bits_of_pitch(spacing, coordinates_) >= kFewestBits) return;
  fail_too_small(spacing, coordinates_);
}

template <int D>
double Limits<D>::even_pitch(double spacing) const {
  require_not_small(spacing);
  return rounded_down(spacing, bits_of_pitch(spacing, coordinates_));
}

template <int D>
double Limits<D>::band_pitch(double spacing) const {
  if (spacing < bands_.front().spacing) fail_too_small(spacing, coordinates_);
  const auto above = std::upper_bound(bands_.begin(), bands_.end(), spacing,
                                      [](double x, const Band& b) { return x < b.spacing; });
  return (above - 1)->pitch;
}

// --- Boxes -----------------------------------------------------------------------------------

template <int D>
auto Limits<D>::spread(const Part& part, const Box<D>& box) const -> Spread {
  const double widest = spacing(part.measure);
  if (part.sizes == nullptr) return {widest, widest, true};
  const SizeRange sizes = part.sizes->range(box);
  const auto of = [&](double h) { return spacing(std::min(part.measure, measure_of_size<D>(h))); };
  const Spread found{of(sizes.least), of(std::max(sizes.least, sizes.most)),
                     sizes.even && part.has_plateaus};
  if (!(found.least >= widest_)) require_not_small(found.least);
  return found.least == widest ? Spread{widest, widest, true} : found;
}

// Of places in the domain.
template <int D>
auto Limits<D>::spacings_in(const Box<D>& box) const -> Spread {
  const Box<D> inside = common(box, domain_);
  if (is_empty(inside)) return {kNone, kNone, true};
  if (regions_ == nullptr) return asked_in(inside);
  const typename RegionLimits<D>::Range there = regions_->range(inside);
  if (!there.some) return {kNone, kNone, true};
  const Spread asked = asked_in(inside);
  const double least = spacing(there.least), most = spacing(there.most);
  return {std::min(asked.least, least), there.all ? std::min(asked.most, most) : kNone,
          asked.even || most <= asked.least};
}

// What lies behind a part that has all of the box is hidden.
template <int D>
auto Limits<D>::asked_in(const Box<D>& inside) const -> Spread {
  std::size_t i = parts_.size() - 1;
  while (i > 0 && !contains(parts_[i].box, inside)) --i;
  Spread all = spread(parts_[i], inside);
  while (++i < parts_.size()) {
    const Box<D> there = common(inside, parts_[i].box);
    if (is_empty(there)) continue;
    const Spread more = spread(parts_[i], there);
    all = {std::min(all.least, more.least), std::max(all.most, more.most), all.even && more.even};
  }
  return all;
}

template <int D>
auto Limits<D>::pitches_in(const Box<D>& box) const -> Pitches {
  if (!any()) return {};
  const Spread spacings = spacings_in(box);
  if (spacings.least >= widest_) return {};
  if (uniform()) return {parts_.front().pitch, parts_.front().pitch, true};
  const double least = spacings.even ? even_pitch(spacings.least) : band_pitch(spacings.least);
  return {least, spacings.most, spacings.even};
}

template class Limits<2>;
#ifndef MESHER_PLANE_ONLY
template class Limits<3>;
#endif

}  // namespace mesher::detail
