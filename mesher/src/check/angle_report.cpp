// Small angles, the triangles that stay for them, and the angles of the others.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "check/forced.hpp"
#include "check/mesh_lines.hpp"
#include "check/shrunk_vertices.hpp"
#include "geometry/input_point.hpp"
#include "mesher/check.hpp"
#include "mesher/reports.hpp"
#include "rules/mesh_box.hpp"
#include "sizes/limits.hpp"
#include "text/id_text.hpp"
#include "text/text.hpp"

namespace mesher {

namespace {

using detail::MeshLines;

using Corners = Mesh<2>::Simplex;

class Report {
 public:
  Report(const Mesh<2>& mesh, const Options<2>& options)
      : mesh_(mesh), options_(options), lines_(mesh) {}

  AngleReport make() {
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) look_around(v);
    for (const Corners& t : mesh_.simplices) look_at(t);
    out_.angles = angles();
    out_.promised_deg = std::asin(1 / (2 * options_.rho)) * detail::kDegrees;
    out_.shrunk = shrunk();
    return std::move(out_);
  }
  // Of the triangles at these indices, and of their corners.
  AngleNews make_news(const std::vector<std::size_t>& triangles) {
    std::vector<Point<2>> corners;
    for (const std::size_t i : triangles) {
      look_at(mesh_.simplices[i]);
      for (const auto v : mesh_.simplices[i]) corners.push_back(mesh_.vertices[v]);
    }
    std::sort(corners.begin(), corners.end());
    AngleNews news{angles(), shrunk()};
    std::erase_if(news.shrunk, [&](const ShrunkVertex& v) {
      return !std::binary_search(corners.begin(), corners.end(), v.at);
    });
    return news;
  }

 private:
  [[nodiscard]] std::vector<SmallAngle> angles() const {
    std::vector<SmallAngle> all;
    for (const auto& [key, angle] : angles_) all.push_back(angle);
    std::sort(all.begin(), all.end(), detail::is_before);
    return all;
  }
  // Where regions limit sizes, or growth, it is not known what is wanted.
  [[nodiscard]] std::vector<ShrunkVertex> shrunk() const {
    const bool limits_regions =
        options_.region_areas == RegionAreas::limits && options_.region_limits == nullptr;
    if (limits_regions || options_.growth != 0) return {};
    std::vector<ShrunkVertex> all = detail::shrunk_vertices(mesh_, lines_, kShrinks);
    const detail::Limits<2> limits(options_, detail::mesh_box(options_));
    std::erase_if(all, [&](const auto& v) { return detail::is_wanted(v, limits); });
    return all;
  }

  // A small angle, by its apex and its segments.
  SmallAngle& angle(std::uint32_t s, std::uint32_t t, std::uint32_t apex) {
    const auto [it, is_new] = angles_.try_emplace({apex, std::min(s, t), std::max(s, t)});
    if (is_new) {
      const LineId one = lines_.segments()[s].line, other = lines_.segments()[t].line;
      it->second.at = mesh_.vertices[apex];
      it->second.lines = {std::min(one, other), std::max(one, other)};
      it->second.degrees = lines_.degrees(s, t, apex);
    }
    return it->second;
  }

  // Each segment that ends at v, and the next one around.
  void look_around(std::uint32_t v) {
    std::vector<std::uint32_t> around = lines_.ending_at(v);
    if (around.size() < 2) return;
    const auto direction = [&](std::uint32_t s) {
      const Point<2> u = lines_.along(s, v);
      return std::tuple(std::atan2(u[1], u[0]), s);
    };
    std::sort(around.begin(), around.end(),
              [&](auto s, auto t) { return direction(s) < direction(t); });
    for (std::size_t i = 0; i < around.size(); ++i) {
      const std::uint32_t s = around[i], t = around[(i + 1) % around.size()];
      if (lines_.degrees(s, t, v) < detail::kSmall) angle(s, t, v);
    }
  }

  void look_at(const Corners& t) {
    const Point<2>&a = mesh_.vertices[t[0]], &b = mesh_.vertices[t[1]], &c = mesh_.vertices[t[2]];
    const double degrees = smallest_angle_deg(a, b, c);
    const double ratio = radius_edge(a, b, c);
    if (ratio > options_.rho * (1 + detail::kPoorRounding)) {
      const auto place = [&](std::uint32_t v) { return mesh_.vertices[v]; };
      const auto [p, q] = detail::shortest_edge(t, place);
      const auto wedges = lines_.wedges_across(p, q, false);
      for (const auto& w : wedges) detail::count(angle(w.s, w.t, w.apex), degrees);
      if (!wedges.empty()) {
        detail::keep_smallest(out_.smallest_forced_deg, degrees);
        ++out_.forced;
        return;
      }
    }
    detail::keep_smallest(out_.smallest_elsewhere_deg, degrees);
  }

  const Mesh<2>& mesh_;
  const Options<2>& options_;
  MeshLines lines_;
  std::map<std::array<std::uint32_t, 3>, SmallAngle> angles_;
  AngleReport out_;
};

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

}  // namespace

AngleNews angle_news(const Mesh<2>& mesh, const Options<2>& options,
                     const std::vector<std::array<Point<2>, 3>>& triangles) {
  if (mesh.edges.empty()) return {};
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < mesh.simplices.size(); ++i) {
    const auto& [a, b, c] = mesh.simplices[i];
    const std::array corners{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
    if (std::binary_search(triangles.begin(), triangles.end(), corners)) indices.push_back(i);
  }
  return Report(mesh, options).make_news(indices);
}

AngleReport angle_report(const Mesh<2>& mesh, const Options<2>& options) {
  return Report(mesh, options).make();
}

std::string AngleReport::text() const {
  std::string text;
  if (!angles.empty()) {
    const auto smallest = std::min_element(angles.begin(), angles.end(),
                                           [](auto& a, auto& b) { return a.degrees < b.degrees; });
    text += std::to_string(angles.size()) + " angles under 60 degrees, the smallest " +
            number(smallest->degrees) + " at " + detail::place_text(smallest->at) + ", of lines " +
            id_text(smallest->lines[0]) + " and " + id_text(smallest->lines[1]) + ".\n";
    text += std::to_string(forced) + " triangles stay for them" +
            (forced == 0 ? "" : ", with angles from " + number(smallest_forced_deg) + " degrees") +
            "; all angles of others are at least " + number(promised_deg) + ".\n";
  }
  if (shrunk.empty()) return text;
  const auto worst = std::max_element(shrunk.begin(), shrunk.end(), [](auto& a, auto& b) {
    return a.feature_size * b.nearest < b.feature_size * a.nearest;
  });
  text += "Lengths have shrunk by more than " + number(kShrinks) + " at " +
          std::to_string(shrunk.size()) + " vertices, most at " + detail::place_text(worst->at) +
          ": " + number(worst->nearest) + " to the next, where features are " +
          number(worst->feature_size) + " apart";
  for (std::size_t i = 0; i < worst->lines.size(); ++i) {
    text += (i == 0 ? ", of lines " : ", ") + id_text(worst->lines[i]);
  }
  text +=
      worst->degrees < 180 ? ", at an angle of " + number(worst->degrees) + " degrees.\n" : ".\n";
  return text;
}

}  // namespace mesher
