// Costs of edits against one quantity: JSON lines of medians, fits and growth, and a picture.
#pragma once

#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "../../mesher/bench/chart.hpp"
#include "../../mesher/bench/sample.hpp"
#include "ground.hpp"

namespace bench {

/// Costs by what they are plotted against.
using Plot = std::map<double, std::vector<Cost>>;

inline void add(Plot& plot, double x, const EditCosts& costs) {
  plot[x].push_back(costs.come);
  plot[x].push_back(costs.go);
}

/// What is edited, and its colour in the picture.
struct Kind {
  const char* name;
  const char* colour;
};
inline constexpr const char* kQuantities[] = {"distance", "work", "weight", "microseconds"};

/// Plots of all kinds against one quantity.
struct Against {
  const char* name;
  const char* axis;
  bool log_x;
  std::vector<Plot> plots;  ///< by kind
};

inline Series series_of(const Plot& plot, const Kind& kind, int quantity) {
  Series series{kind.name, kind.colour, {}};
  for (const auto& [x, costs] : plot) {
    std::vector<double> values;
    for (const Cost& cost : costs) {
      if (const auto value = cost.quantity(quantity)) values.push_back(*value);
    }
    if (values.size() < 4) continue;
    series.points.push_back({x, quantile(values, 0.5), quantile(values, 0.99)});
  }
  return series;
}

// Least squares: y = a + b x, and how much of y's variance that explains.
inline void print_fit(const char* bench, const char* against, const Series& s,
                      const char* quantity) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (const auto& at : s.points) {
    n += 1, x += at.x, y += at.median;
    xx += at.x * at.x, xy += at.x * at.median, yy += at.median * at.median;
  }
  if (n < 3) return;
  const double b = (n * xy - x * y) / (n * xx - x * x), a = (y - b * x) / n;
  const double variance = n * yy - y * y;
  const double r2 = variance > 0 ? b * b * (n * xx - x * x) / variance : 1;
  std::printf(
      "{\"bench\":\"%s\",\"against\":\"%s\",\"kind\":\"%s\",\"quantity\":\"%s\","
      "\"fit\":[%.4g,%.4g],\"r2\":%.3f}\n",
      bench, against, s.name.c_str(), quantity, a, b, r2);
}

inline void print_growth(const char* bench, const Series& s, const char* quantity) {
  double at_10000 = 0;
  for (const auto& at : s.points) at_10000 = at.x == 10000 ? at.median : at_10000;
  if (at_10000 == 0 || s.points.back().x <= 10000) return;
  std::printf(
      "{\"bench\":\"%s\",\"against\":\"n\",\"kind\":\"%s\",\"quantity\":\"%s\","
      "\"to\":%.0f,\"growth_from_10000\":%.3f}\n",
      bench, s.name.c_str(), quantity, s.points.back().x, s.points.back().median / at_10000);
}

inline void print_places(const char* bench, const char* against, const Series& s,
                         const char* quantity) {
  for (const auto& at : s.points) {
    std::printf(
        "{\"bench\":\"%s\",\"against\":\"%s\",\"kind\":\"%s\",\"quantity\":\"%s\","
        "\"x\":%.4g,\"median\":%.1f,\"p99\":%.1f}\n",
        bench, against, s.name.c_str(), quantity, at.x, at.median, at.p99);
  }
}

/// Prints all figures and writes the picture. 0, or 1 if that cannot be written.
[[nodiscard]] inline int draw(const char* bench, const std::vector<Kind>& kinds,
                              const std::vector<Against>& all, const std::string& path) {
  std::vector<Panel> panels;
  for (int quantity = 0; quantity < 4; ++quantity) {
    const char* const name = kQuantities[quantity];
    for (const Against& against : all) {
      Panel panel{name, against.axis, against.log_x, {}};
      for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        const Series s = series_of(against.plots[kind], kinds[kind], quantity);
        if (s.points.empty()) continue;
        print_places(bench, against.name, s, name);
        against.log_x ? print_growth(bench, s, name) : print_fit(bench, against.name, s, name);
        panel.series.push_back(s);
      }
      panels.push_back(panel);
    }
  }
  std::ofstream file(path);
  file << Chart::draw(panels, static_cast<int>(all.size()));
  if (file.flush()) return 0;
  std::fprintf(stderr, "%s: cannot write %s\n", bench, path.c_str());
  return 1;
}

}  // namespace bench
