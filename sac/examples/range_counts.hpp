// How many points lie in each of many rectangles. Points and rectangles come and go.
//
// The plane is cut into strips, and a point is an entry at (strip, y). A rectangle counts the
// strips that it covers, and looks at the points of the two at its sides. A point that comes or
// goes makes those rectangles run again whose y-interval contains it, in its strip.
#pragma once

#include <cstdint>
#include <ostream>
#include <tuple>

#include "sac/sac.hpp"

namespace examples::range_counts {

inline constexpr int kWidth = 16;  // of a strip

/// Points with left <= x < right, low <= y < high.
struct Rectangle {
  int left = 0, right = 0, low = 0, high = 0;
  friend bool operator==(const Rectangle&, const Rectangle&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Rectangle& r) {
    return out << r.left << '-' << r.right << ' ' << r.low << '-' << r.high;
  }
};
using Place = std::tuple<int, int, int>;  // strip, y, number of the point

template <class S>
struct Plane {
  template <class Host>
  explicit Plane(Host& host)
      : points(host, "points"), rectangles(host, "rectangles"), counts(host, "counts") {
    host.set_environment(this);
  }
  static Place place_of(int x, int y, int number) { return {x / kWidth, y, number}; }

  sac::Map<Place, int, S> points;  // to x
  sac::Map<int, Rectangle, S> rectangles;
  sac::Map<int, std::int64_t, S> counts;  // of rectangles
};

struct CountPoints {
  static constexpr std::string_view kName = "count_points";
  template <class S>
  void operator()(S& s, int number, const Rectangle& r) const {
    auto& plane = s.template environment<Plane<S>>();
    std::int64_t count = 0;
    for (int strip = r.left / kWidth; strip * kWidth < r.right; ++strip) {
      const sac::Interval<Place> within{.from = Place(strip, r.low, 0),
                                        .below = Place(strip, r.high, 0)};
      if (strip * kWidth >= r.left && (strip + 1) * kWidth <= r.right) {
        count += static_cast<std::int64_t>(plane.points.count(s, within));
        continue;
      }
      const auto points = plane.points.range(s, within);
      s.weigh(points.size());
      for (const auto& [place, x] : points) {
        count += x >= r.left && x < r.right;
      }
    }
    plane.counts.put(s, number, count);
  }
};

struct CountAll {
  static constexpr std::string_view kName = "count_all";
  template <class S>
  void operator()(S& s) const {
    s.template environment<Plane<S>>().rectangles.template for_each<CountPoints{}>(s);
  }
};
inline constexpr CountAll count_all{};

}  // namespace examples::range_counts
