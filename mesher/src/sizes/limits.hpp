// The limits of size of simplices, and the matching lattices [rules A7]: functions of space.
//
// A simplex whose centroid is in the domain has at most the measure (area, volume) of the limit
// there. A limit asks for a *spacing*, that of the lattice whose simplices have this measure.
//
// The *pitch* at a place is that of the lattice that fills it: the spacing there, rounded down to a
// few bits, where the limit is constant (max_measure, or a plateau of the sizes); elsewhere that of
// its *band*, [2^(k/4), 2^((k+1)/4)), so that lattices of some extent result.
//
// Where regions are given, limits count in some, and these may have measures of their own.
//
// All results for a position, or for a box, depend only on the limits there: limits that change
// elsewhere do not matter.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "geometry/grid.hpp"
#include "mesher/sizes.hpp"
#include "sizes/lattice.hpp"

namespace mesher::detail {

template <int D>
class Limits {
 public:
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  /// Throws: Error(bad_option).
  Limits(const Options<D>& options, const MeshBox<D>& box);

  /// Whether there is a limit somewhere.
  [[nodiscard]] bool any() const noexcept { return any_; }
  /// Whether there is one constant in all of the domain.
  [[nodiscard]] bool uniform() const noexcept {
    return parts_.size() == 1 && parts_.front().sizes == nullptr && regions_ == nullptr;
  }
  /// The largest measure of a simplex with its centroid at p; kNone: any.
  /// Throws: Error(bad_option) for a size that is not above 0.
  [[nodiscard]] double measure(const Point<D>& p) const { return look(p).measure; }
  /// The pitch of the lattice at p; kNone: no lattice. Throws: also if it is too small.
  [[nodiscard]] double pitch(const Point<D>& p) const { return any() ? pitch_for(look(p)) : kNone; }
  /// The same, where this measure is allowed: that at p, or another one, which is a constant of a
  /// region, or varies.
  [[nodiscard]] double pitch_for_measure(const Point<D>& p, double measure, bool varies) const;
  /// No simplex that is not larger than this is too large anywhere. kNone: there are no limits.
  [[nodiscard]] double least_measure() const;
  /// The same where the limit is a constant or a plateau; elsewhere 0.
  [[nodiscard]] double constant_pitch(const Point<D>& p) const {
    const Look there = look(p);
    return there.even ? pitch_for(there) : 0;
  }
  [[nodiscard]] Point<D> nearest_in_domain(const Point<D>& p) const noexcept {
    Point<D> nearest;
    for (std::size_t i = 0; i < D; ++i) {
      nearest[i] = std::clamp(p[i], domain_.lo[i], domain_.hi[i]);
    }
    return nearest;
  }
  /// Whether a piece of a feature is so long that the lattice would leave a gap beside it: longer
  /// than `most` spacings somewhere in the box around its ball.
  [[nodiscard]] bool is_long(const Box<D>& box, double length, double most) const {
    return any() && length > most * spacings_in(box).least;
  }

  /// What lies in a box: no pitch is below `least`, none above `most`; kNone: no lattice.
  struct Pitches {
    double least = kNone, most = kNone;
    bool even = true;  // the limits are constants and plateaus
  };
  [[nodiscard]] Pitches pitches_in(const Box<D>& box) const;
  /// Calls visit(pitch) for what there may be, ascending, until it returns true; returns whether it
  /// did.
  template <class Visit>
  bool visit_pitches(const Pitches& range, Visit&& visit) const;

 private:
  // From a spacing on.
  struct Band {
    double spacing, pitch;
  };
  // The last part that has a place says what holds there.
  struct Part {
    Box<D> box;
    double measure;                             // kNone: no limit
    double pitch;                               // that this asks for
    std::shared_ptr<const SizeField<D>> sizes;  // null: measure everywhere
    bool has_plateaus = false;
  };
  struct Look {
    double measure;
    double pitch;  // of a constant; 0: of sizes that vary
    bool even = true;
  };
  // Of spacings.
  struct Spread {
    double least = kNone, most = 0;
    bool even = true;
  };

  static double spacing(double measure) noexcept { return Lattice<D>::spacing(measure); }
  void add_part(const Box<D>& box, const SizeLimits<D>& limits);
  double add_plateau(double spacing);
  void add_bands();
  [[nodiscard]] double even_pitch(double spacing) const;
  [[nodiscard]] double band_pitch(double spacing) const;
  [[nodiscard]] double pitch_for(const Look& look) const;
  [[nodiscard]] Look look(const Point<D>& p) const;
  [[nodiscard]] Look asked_at(const Point<D>& p) const;
  [[nodiscard]] Look look(const Part& part, const Point<D>& p) const;
  [[nodiscard]] Spread spread(const Part& part, const Box<D>& box) const;
  [[nodiscard]] Spread asked_in(const Box<D>& inside) const;
  [[nodiscard]] Spread spacings_in(const Box<D>& box) const;
  void require_not_small(double spacing) const;

  Box<D> domain_;
  double coordinates_;  // none in the domain is larger
  double widest_;       // spacings from this on have no lattice
  bool any_ = false;
  std::vector<Part> parts_;                         // the first has all of the domain
  std::shared_ptr<const RegionLimits<D>> regions_;  // null: all of this counts everywhere
  std::vector<double> plateaus_;                    // pitches, ascending
  std::vector<Band> bands_;                         // ascending; empty if all is constant
};

template <int D>
template <class Visit>
bool Limits<D>::visit_pitches(const Pitches& range, Visit&& visit) const {
  std::size_t i = 0, j = range.even ? bands_.size() : 0;
  while (i < plateaus_.size() || j < bands_.size()) {
    const bool of_band =
        i == plateaus_.size() || (j < bands_.size() && bands_[j].pitch < plateaus_[i]);
    const double pitch = of_band ? bands_[j++].pitch : plateaus_[i++];
    if (!of_band && j < bands_.size() && bands_[j].pitch == pitch) ++j;
    if (pitch > range.most) return false;
    if (pitch >= range.least && visit(pitch)) return true;
  }
  return false;
}

}  // namespace mesher::detail
