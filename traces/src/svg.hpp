// Writing SVG: rectangles with tooltips, and text of one width a letter.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace traces {

class Svg {
 public:
  /// Width of a letter and height of a line, in pixels.
  static constexpr double kLetter = 6.7;
  static constexpr double kLine = 16;

  explicit Svg(int width) : width_(width) {}
  [[nodiscard]] double width() const noexcept { return width_; }

  struct Box {
    double x, y, width, height;
  };
  /// `attributes`: of the element, such as fill="red". An empty tooltip is none.
  void rect(const Box& box, std::string_view attributes, std::string_view tooltip = {});
  /// Slices of `box`, downward, with one tooltip.
  struct Slice {
    std::string_view fill;  // a colour
    double share;           // of the height; together 1
  };
  void stack(const Box& box, const std::vector<Slice>& slices, std::string_view tooltip);
  /// From (x, y) on, the baseline. `attributes` as above.
  void text(double x, double y, std::string_view text, std::string_view attributes = {});
  /// Downward from (x, y).
  void text_down(double x, double y, std::string_view text);

  /// The whole picture; `title` is what it is called.
  [[nodiscard]] std::string finish(double height, std::string_view title) const;

 private:
  double width_;
  std::string body_;
};

/// As much of `text` as fits into `width` pixels, in whole letters: if it is cut, it ends in "..".
/// Nothing if no letter fits.
[[nodiscard]] std::string fitted(std::string_view text, double width);

/// 1234567 as "1 234 567".
[[nodiscard]] std::string grouped(unsigned long long number);

}  // namespace traces
