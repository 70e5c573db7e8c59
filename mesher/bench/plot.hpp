// Curves as SVG, both axes logarithmic.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace bench {

struct Curve {
  std::string name;
  std::vector<std::array<double, 2>> points;  ///< positive
};

struct Plot {
  std::string title{};
  std::vector<Curve> curves{};

  /// Throws: std::runtime_error.
  void write(const std::filesystem::path& path) const;
};

/// Where coordinates of one axis go.
struct PlotAxis {
  double least = HUGE_VAL, most = -HUGE_VAL;

  void add(double x) { least = std::min(least, x), most = std::max(most, x); }
  [[nodiscard]] double at(double x, double from, double to) const {
    if (!(most > least)) return (from + to) / 2;
    return from + (to - from) * std::log(x / least) / std::log(most / least);
  }
};

inline void Plot::write(const std::filesystem::path& path) const {
  constexpr const char* kColours[] = {"#1b6", "#26c", "#c62", "#a2a", "#777"};
  std::ofstream file(path);
  PlotAxis x, y;
  for (const Curve& curve : curves) {
    for (const auto& p : curve.points) x.add(p[0]), y.add(p[1]);
  }
  const auto text = [&](double at_x, double at_y, const char* colour, const std::string& words) {
    file << "<text x=\"" << at_x << "\" y=\"" << at_y << "\" fill=\"" << colour << "\">" << words
         << "</text>\n";
  };
  file << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 640 440\" "
          "font-family=\"sans-serif\" font-size=\"12\">\n"
          "<rect width=\"640\" height=\"440\" fill=\"#fff\"/>\n"
          "<path d=\"M70 40V390H620\" fill=\"none\" stroke=\"#000\"/>\n";
  text(70, 25, "#000", title);
  const auto number = [](double value) {
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), "%.3g", value);
    return std::string(digits.data());
  };
  text(70, 408, "#000", number(x.least));
  text(590, 408, "#000", number(x.most));
  text(8, 390, "#000", number(y.least));
  text(8, 50, "#000", number(y.most));
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const char* colour = kColours[i % std::size(kColours)];
    file << "<polyline fill=\"none\" stroke=\"" << colour << "\" points=\"";
    for (const auto& p : curves[i].points) {
      file << x.at(p[0], 75, 610) << ',' << y.at(p[1], 385, 50) << ' ';
    }
    file << "\"/>\n";
    text(90, 60 + 16 * static_cast<double>(i), colour, curves[i].name);
  }
  file << "</svg>\n";
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace bench
