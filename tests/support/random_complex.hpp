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
  static constexpr int kKinds = 11;

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
  void add_lid(Complex& c);
  mesher::Point<3> turned(double x, double y, double z);

  std::mt19937_64 random_;
  mesher::Point<3> corner_{};
  double angle_ = 0, tilt_ = 0;
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
    case 9:
      add_polygon_with_hole(c);
      break;
    default:
      add_lid(c);
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

// A hexagon with a point above its middle: no edge of it is crowded.
inline void RandomComplex::add_lid(Complex& c) {
  angle_ = number(0, 3), tilt_ = number(0, 3);
  const double r = number(0.2, 0.4);
  Complex::Places corners;
  for (int i = 0; i < 6; ++i) {
    corners.push_back(
        turned(r * std::cos(i * 1.0471975511965976), r * std::sin(i * 1.0471975511965976), 0));
  }
  c.face(corners);
  c.point(turned(number(-0.1, 0.1) * r, number(-0.1, 0.1) * r, number(0.05, 0.4) * r));
}

// A square across a random direction, and one of a third to two thirds of its size inside.
inline void RandomComplex::add_polygon_with_hole(Complex& c) {
  angle_ = number(0, 3), tilt_ = number(0, 3);
  const double r = number(0.1, 0.4), s = number(0.3, 0.6);
  const auto at = [&](double x, double y) { return turned(x, y, 0); };
  const double h = r * s;
  c.face({at(r, 0), at(0, r), at(-r, 0), at(0, -r)}, {{at(h, 0), at(0, h), at(-h, 0), at(0, -h)}});
}

// About the x axis, then the z axis, and moved to the middle of the cube.
inline mesher::Point<3> RandomComplex::turned(double x, double y, double z) {
  const double w = y * std::cos(tilt_) - z * std::sin(tilt_);
  return {corner_[0] + 0.5 + x * std::cos(angle_) - w * std::sin(angle_),
          corner_[1] + 0.5 + x * std::sin(angle_) + w * std::cos(angle_),
          corner_[2] + 0.5 + y * std::sin(tilt_) + z * std::cos(tilt_)};
}

}  // namespace support
