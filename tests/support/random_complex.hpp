// Random complexes: each part lies in a unit cube of a grid, so that parts never meet; within a
// part features meet at whatever angle comes.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "plc_families.hpp"

namespace support {

class RandomComplex {
 public:
  static constexpr int kKinds = 10;

  explicit RandomComplex(std::uint64_t seed) : random_(seed) {}

  /// A number below n.
  [[nodiscard]] std::uint64_t below(std::uint64_t n) { return random_() % n; }
  /// A part in the cube with this corner.
  [[nodiscard]] Complex part(const mesher::Point<3>& corner) {
    return part(corner, static_cast<int>(below(kKinds)));
  }
  [[nodiscard]] Complex part(const mesher::Point<3>& corner, int kind);

 private:
  double number(double from, double to) {
    return from + (to - from) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  mesher::Point<3> place() {
    mesher::Point<3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = corner_[i] + number(0.1, 0.9);
    return p;
  }
  void add_box(Complex& c);
  void add_polygon_with_hole(Complex& c);

  std::mt19937_64 random_;
  mesher::Point<3> corner_{};
};

inline Complex RandomComplex::part(const mesher::Point<3>& corner, int kind) {
  corner_ = corner;
  Complex c;
  const auto a = place(), b = place(), d = place(), e = place();
  switch (kind) {
    case 0:
      c.points = {a};
      break;
    case 1:
      c.points = {a, b, d, e};
      break;
    case 2:
      c.segment(a, b);
      break;
    case 3:  // a corner, as sharp as comes
      c.segment(a, b);
      c.segment(a, d);
      break;
    case 4:
      c.face({a, b, d});
      break;
    case 5:  // a wedge, with sharp corners
      c.face({a, b, d});
      c.face({a, b, e});
      break;
    case 6:
      c.face({a, b, d});
      c.face({a, b, e});
      c.face({a, d, e});
      c.face({b, d, e});
      break;
    case 7:
      c.face({a, b, d});
      c.segment(a, e);
      break;
    case 8:
      add_box(c);
      break;
    default:
      add_polygon_with_hole(c);
      break;
  }
  return c;
}

inline void RandomComplex::add_box(Complex& c) {
  mesher::Box<3> box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.lo[i] = corner_[i] + number(0.1, 0.4);
    box.hi[i] = box.lo[i] + number(0.1, 0.5);
  }
  c.box(box);
}

// A square across a random direction, and one of a third to two thirds of its size inside.
inline void RandomComplex::add_polygon_with_hole(Complex& c) {
  const double angle = number(0, 3), tilt = number(0, 3), r = number(0.1, 0.4);
  const double s = number(0.3, 0.6);
  const auto at = [&](double x, double y) {
    const double z = y * std::sin(tilt), w = y * std::cos(tilt);
    return mesher::Point<3>{corner_[0] + 0.5 + x * std::cos(angle) - w * std::sin(angle),
                            corner_[1] + 0.5 + x * std::sin(angle) + w * std::cos(angle),
                            corner_[2] + 0.5 + z};
  };
  const double h = r * s;
  c.face({at(r, 0), at(0, r), at(-r, 0), at(0, -r)}, {{at(h, 0), at(0, h), at(-h, 0), at(0, -h)}});
}

}  // namespace support
