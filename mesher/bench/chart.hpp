// Panels of one quantity, or of medians and 99th percentiles, over another, as SVG.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

namespace bench {

/// y over x: a line through the medians, with dots, and a tick at each 99th percentile that there
/// is.
struct Series {
  std::string name;
  std::string colour;
  struct At {
    double x, median;
    double p99 = std::numeric_limits<double>::quiet_NaN();
  };
  std::vector<At> points;
};

struct Panel {
  std::string title;
  std::string x_name;
  bool log_x = false;  // by powers of ten
  std::vector<Series> series;
  bool log_y = false;
};

class Chart {
 public:
  /// A grid of panels, so many a row; y starts at 0, unless it is logarithmic.
  [[nodiscard]] static std::string draw(const std::vector<Panel>& panels, int columns) {
    const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
                      number(columns * kWidth) + "\" height=\"" + number(rows * kHeight) +
                      "\" font-family=\"sans-serif\" font-size=\"11\">\n"
                      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
    for (std::size_t i = 0; i < panels.size(); ++i) {
      const int column = static_cast<int>(i) % columns, row = static_cast<int>(i) / columns;
      svg += Chart(panels[i], column * kWidth, row * kHeight).drawn();
    }
    return svg + "</svg>\n";
  }

 private:
  static constexpr double kWidth = 330, kHeight = 230;
  static constexpr double kLeft = 58, kRight = 14, kTop = 26, kBottom = 40;

  Chart(const Panel& panel, double x, double y) : panel_(panel), x_(x), y_(y) {
    lowest_ = HUGE_VAL, highest_ = -HUGE_VAL;
    for (const Series& s : panel.series) {
      for (const auto& at : s.points) {
        lowest_ = std::min(lowest_, scaled(at.x)), highest_ = std::max(highest_, scaled(at.x));
        least_ = std::min(least_, at.median), most_ = std::max(most_, std::fmax(at.median, at.p99));
      }
    }
    if (!(highest_ > lowest_))
      lowest_ = (lowest_ < HUGE_VAL ? lowest_ : 0) - 1, highest_ = lowest_ + 2;
    step_ = std::pow(10, std::floor(std::log10(most_ > 0 ? most_ : 1)));
    for (const double part : {0.5, 0.4, 0.5}) step_ *= most_ / step_ < 4 ? part : 1;
  }

  [[nodiscard]] double scaled(double x) const { return panel_.log_x ? std::log10(x) : x; }
  [[nodiscard]] double at_x(double x) const {
    const double part = (scaled(x) - lowest_) / (highest_ - lowest_);
    return x_ + kLeft + part * (kWidth - kLeft - kRight);
  }
  [[nodiscard]] double at_y(double y) const {
    const double height = kHeight - kTop - kBottom;
    return y_ + kTop + height * (1 - part_of_y(y));
  }
  [[nodiscard]] double part_of_y(double y) const {
    if (panel_.log_y) return most_ > least_ ? std::log(y / least_) / std::log(most_ / least_) : 0.5;
    return y / (most_ > 0 ? most_ : 1);
  }
  /// Round numbers of a logarithmic axis, at equal steps.
  static std::vector<double> ticks(double from, double to) {
    const bool is_short = to < 100 * from;
    std::vector<double> ticks;
    for (double power = std::floor(std::log10(from)); power <= std::log10(to) + 1e-9; ++power) {
      for (const double factor : {1, 2, 5}) {
        const double at = factor * std::pow(10, power);
        const bool is_in = at >= from * (1 - 1e-9) && at <= to * (1 + 1e-9);
        if (is_in && (factor == 1 || is_short)) ticks.push_back(at);
      }
    }
    return ticks;
  }
  [[nodiscard]] std::vector<double> y_ticks() const {
    if (panel_.log_y) return ticks(least_, most_);
    std::vector<double> ticks;
    for (double y = 0; y <= most_; y += step_) ticks.push_back(y);
    return ticks;
  }
  static std::string number(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", x);
    return text;
  }
  static std::string label(double x, double y, const std::string& s, const char* anchor) {
    return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\">" +
           s + "</text>\n";
  }
  static std::string line(double x0, double y0, double x1, double y1, const std::string& colour) {
    return "<line x1=\"" + number(x0) + "\" y1=\"" + number(y0) + "\" x2=\"" + number(x1) +
           "\" y2=\"" + number(y1) + "\" stroke=\"" + colour + "\"/>\n";
  }

  [[nodiscard]] std::string drawn() const {
    std::string svg = label(x_ + kWidth / 2, y_ + 16, panel_.title, "middle");
    for (const double y : y_ticks()) {
      svg += line(x_ + kLeft, at_y(y), x_ + kWidth - kRight, at_y(y), "#ddd");
      svg += label(x_ + kLeft - 5, at_y(y) + 4, number(y), "end");
    }
    const double first = std::ceil(lowest_), by = highest_ - lowest_ > 10 ? 8 : 1;
    if (panel_.log_x) {
      for (const double x : ticks(std::pow(10, lowest_), std::pow(10, highest_))) {
        svg += label(at_x(x), y_ + kHeight - kBottom + 16, number(x), "middle");
      }
    }
    const double every = panel_.log_x ? 0 : std::max(by, std::ceil((highest_ - lowest_) / 6));
    for (double x = first; every > 0 && x <= highest_; x += every) {
      svg += label(at_x(x), y_ + kHeight - kBottom + 16, number(x), "middle");
    }
    svg += label(x_ + kWidth / 2, y_ + kHeight - 8, panel_.x_name, "middle");
    double legend = y_ + kTop + 10;
    for (const Series& s : panel_.series) {
      svg += drawn(s);
    }
    for (const Series& s : panel_.series) {
      svg += "<text x=\"" + number(x_ + kLeft + 8) + "\" y=\"" + number(legend) + "\" fill=\"" +
             s.colour + "\" stroke=\"white\" stroke-width=\"3\" paint-order=\"stroke\">" + s.name +
             "</text>\n";
      legend += 13;
    }
    return svg;
  }
  [[nodiscard]] std::string drawn(const Series& s) const {
    std::string path, marks;
    for (const auto& at : s.points) {
      const double x = at_x(at.x);
      path += number(x) + "," + number(at_y(at.median)) + " ";
      marks += "<circle cx=\"" + number(x) + "\" cy=\"" + number(at_y(at.median)) +
               "\" r=\"2.5\" fill=\"" + s.colour + "\"/>\n";
      if (!std::isnan(at.p99)) marks += line(x - 4, at_y(at.p99), x + 4, at_y(at.p99), s.colour);
    }
    return "<polyline points=\"" + path + "\" fill=\"none\" stroke=\"" + s.colour + "\"/>\n" +
           marks;
  }

  const Panel& panel_;
  double x_, y_;
  double lowest_, highest_, least_ = HUGE_VAL, most_ = 0, step_ = 1;
};

}  // namespace bench
