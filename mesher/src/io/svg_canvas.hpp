// The common part of pictures of meshes: their scale, the widths of lines and dots, and numbers.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include "geometry/box.hpp"
#include "mesher/mesh.hpp"
#include "mesher/write.hpp"

namespace mesher::svg {

constexpr double kLongerSide = 1000;   // units of the picture
constexpr int kLongest = 3;            // lines of length 2^3 and more have the full width,
constexpr int kShortest = -6;          // those below 2^-6 the least
constexpr double kLineShare = 0x1p-3;  // a line's width over its length
constexpr double kDotShare = 0.625;    // a dot's width over the shortest edge at it

/// The binary exponent of a length in the picture.
inline int length_class(double length) {
  return length > 0 ? std::clamp(std::ilogb(length), kShortest, kLongest) : kShortest;
}

/// The input points of a mesh with an eighth of their longest side around them; all of the mesh if
/// it has fewer than two. Cost: O(vertices).
template <int D>
Box<D> window_of(const Mesh<D>& mesh) {
  const auto inputs = std::count(mesh.kinds.begin(), mesh.kinds.end(), VertexKind::input);
  std::vector<Point<D>> shown;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (inputs < 2 || mesh.kinds[i] == VertexKind::input) shown.push_back(mesh.vertices[i]);
  }
  Box<D> box;
  box.hi.fill(1);
  if (shown.empty()) return box;
  box = detail::bounding_box<D>(shown);
  const double margin = detail::longest_side(box) > 0 ? detail::longest_side(box) / 8 : 1;
  for (int i = 0; i < D; ++i) {
    box.lo[i] -= margin;
    box.hi[i] += margin;
  }
  return box;
}

/// Maps the window onto the picture and writes rounded coordinates.
class Canvas {
 public:
  Canvas(const Box<2>& window, TextFile& file)
      : window_(window), scale_(kLongerSide / detail::longest_side(window)), file_(file) {}

  [[nodiscard]] bool shows(const Point<2>& a, const Point<2>& b) const { return shows(a, b, b); }
  [[nodiscard]] bool shows(const Point<2>& a, const Point<2>& b, const Point<2>& c) const {
    const Box<2> box = detail::bounding_box<2>(std::array{a, b, c});
    return !detail::is_empty(detail::common(box, window_));
  }

  /// In units of the picture.
  [[nodiscard]] double distance(const Point<2>& a, const Point<2>& b) const {
    const double x = (a[0] - b[0]) * scale_, y = (a[1] - b[1]) * scale_;
    return std::sqrt(x * x + y * y);
  }

  /// The first lines of the file.
  void begin() {
    file_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 ";
    number(scale_ * (window_.hi[0] - window_.lo[0]));
    file_ << ' ';
    number(scale_ * (window_.hi[1] - window_.lo[1]));
    file_ << "\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  }
  void point(const Point<2>& p) {
    number((p[0] - window_.lo[0]) * scale_);
    file_ << ' ';
    number((window_.hi[1] - p[1]) * scale_);
  }
  /// Three decimals, without what the value does not need. Far outside the view they are capped.
  void number(double value) {
    constexpr double kFar = 1e9;
    char digits[32];  // '-', 10 digits, '.', 3 digits
    const double rounded = std::round(std::clamp(value, -kFar, kFar) * 1000) / 1000 + 0.0;
    const auto end =
        std::to_chars(digits, digits + sizeof digits, rounded, std::chars_format::fixed).ptr;
    file_ << std::string_view(digits, end - digits);
  }

 private:
  Box<2> window_;
  double scale_;
  TextFile& file_;
};

}  // namespace mesher::svg
