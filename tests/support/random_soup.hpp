// Random points, segments and polygons in space that cross, touch and overlap.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesher/extra/generate.hpp"
#include "mesher/graph.hpp"
#include "polygons.hpp"

namespace support {

enum class SoupKind {
  general,  ///< places anywhere
  lattice,  ///< multiples of a quarter: much is in common
  near,     ///< places beside others, on lines between them, off by 0 or 1e-12 to 1e-6
  layers,   ///< three planes, with some places off these
  flat,     ///< as general, without polygons that are bent
};

/// `parts`: points, segments, triangles, parallelograms and quadrilaterals, in a unit cube that is
/// turned and scaled.
class RandomSoup {
 public:
  RandomSoup(std::uint64_t seed, SoupKind kind, std::size_t parts, double scale)
      : random_(seed), kind_(kind), size_(std::min(1.0, 2 / std::cbrt(double(parts)))) {
    motion_ = seed % 2 == 0 ? random_motion(random_) : Motion{};
    scale_ = scale;
    for (std::size_t i = 0; i < parts; ++i) add_part();
  }
  [[nodiscard]] const mesher::Graph<3>& plc() const { return plc_; }

 private:
  using P = mesher::Point<3>;
  using Id = mesher::PointId;

  double off() {
    if (random_.below(2) == 0) return 0;
    return (2 * random_.unit() - 1) * std::pow(10, -12 + 6 * random_.unit());
  }
  P shaken(P p) {
    const bool is_shaken = random_.below(2) == 0;
    for (double& x : p) x += is_shaken ? off() : 0;
    return p;
  }
  const P& some() { return places_[random_.below(places_.size())]; }
  P place() {
    P p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = middle_[i] + size_ * (random_.unit() - 0.5);
    if (kind_ == SoupKind::lattice) {
      for (double& x : p) x = std::round(x * 4) / 4;
    }
    if (kind_ == SoupKind::layers) p[2] = 0.25 * double(random_.below(3)) + off();
    if (kind_ != SoupKind::near || places_.empty()) return p;
    if (random_.below(2) == 0) p = shaken(some());
    if (random_.below(4) == 0) {
      const P &a = some(), &b = some();
      const double t = random_.unit();
      for (std::size_t i = 0; i < 3; ++i) p[i] = a[i] + t * (b[i] - a[i]);
      p = shaken(p);
    }
    return p;
  }
  Id add(const P& p) {
    places_.push_back(p);
    P at = motion_(p);
    for (double& x : at) x *= scale_;
    const Id id{static_cast<std::int64_t>(places_.size())};
    plc_.points.push_back({id, at, static_cast<std::int64_t>(random_.below(3))});
    return id;
  }
  Id point() {
    if (!places_.empty() && random_.below(5) == 0) {
      return Id{static_cast<std::int64_t>(1 + random_.below(places_.size()))};
    }
    return add(place());
  }
  std::vector<Id> points(std::size_t n) {
    std::vector<Id> all;
    while (all.size() < n) {
      const Id id = point();
      if (std::find(all.begin(), all.end(), id) == all.end()) all.push_back(id);
    }
    return all;
  }
  void add_polygon(std::vector<Id> loop) {
    const mesher::PolygonId id{static_cast<std::int64_t>(plc_.polygons.size()) + 1};
    plc_.polygons.push_back(
        {id, {std::move(loop)}, {}, {}, static_cast<std::int64_t>(random_.below(4))});
  }
  void add_part() {
    for (double& x : middle_) x = random_.unit();
    switch (random_.below(5)) {
      case 0:
        add(place());
        return;
      case 1: {
        const auto ends = points(2);
        const mesher::LineId id{static_cast<std::int64_t>(plc_.segments.size()) + 1};
        plc_.segments.push_back(
            {id, ends[0], ends[1], static_cast<std::int64_t>(random_.below(4))});
        return;
      }
      case 2:
        return add_polygon(points(kind_ == SoupKind::flat ? 3 : 4));
      case 3: {
        const P a = place(), b = place(), c = place();
        P d;
        for (std::size_t i = 0; i < 3; ++i) d[i] = a[i] + c[i] - b[i];
        const Id ids[] = {add(a), add(b), add(c), add(d)};
        return add_polygon({std::begin(ids), std::end(ids)});
      }
      default:
        return add_polygon(points(3));
    }
  }

  mesher::SplitMix64 random_;
  SoupKind kind_;
  double size_;
  double scale_ = 1;
  Motion motion_;
  P middle_{};
  std::vector<P> places_;
  mesher::Graph<3> plc_;
};

}  // namespace support
