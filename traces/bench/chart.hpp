// Panels of medians and 99th percentiles over one quantity, as SVG.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace bench {

/// y over x: a line through the medians, with dots, and a tick at each 99th percentile.
struct Series {
  std::string name;
  std::string colour;
  struct At {
    double x, median, p99;
  };
  std::vector<At> points;
};

struct Panel {
  std::string title;
  std::string x_name;
  bool log_x = false;  // by powers of ten
  std::vector<Series> series;
};

class Chart {
 public:
  /// A grid of panels, so many a row; y starts at 0.
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
        most_ = std::max({most_, at.median, at.p99});
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
    return y_ + kTop + height * (1 - y / (most_ > 0 ? most_ : 1));
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
    for (double y = 0; y <= most_; y += step_) {
      svg += line(x_ + kLeft, at_y(y), x_ + kWidth - kRight, at_y(y), "#ddd");
      svg += label(x_ + kLeft - 5, at_y(y) + 4, number(y), "end");
    }
    const double first = std::ceil(lowest_), by = highest_ - lowest_ > 10 ? 8 : 1;
    for (double x = first; panel_.log_x && x <= highest_; ++x) {
      svg += label(at_x(std::pow(10, x)), y_ + kHeight - kBottom + 16, "1e" + number(x), "middle");
    }
    const double every = panel_.log_x ? 0 : std::max(by, std::ceil((highest_ - lowest_) / 6));
    for (double x = first; every > 0 && x <= highest_; x += every) {
      svg += label(at_x(x), y_ + kHeight - kBottom + 16, number(x), "middle");
    }
    svg += label(x_ + kWidth / 2, y_ + kHeight - 8, panel_.x_name, "middle");
    double legend = y_ + kTop + 10;
    for (const Series& s : panel_.series) {
      svg += drawn(s);
      svg += "<text x=\"" + number(x_ + kLeft + 8) + "\" y=\"" + number(legend) + "\" fill=\"" +
             s.colour + "\">" + s.name + "</text>\n";
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
      marks += line(x - 4, at_y(at.p99), x + 4, at_y(at.p99), s.colour);
    }
    return "<polyline points=\"" + path + "\" fill=\"none\" stroke=\"" + s.colour + "\"/>\n" +
           marks;
  }

  const Panel& panel_;
  double x_, y_;
  double lowest_, highest_, most_ = 0, step_ = 1;
};

}  // namespace bench
