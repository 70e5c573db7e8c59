// What refinements of points do before and after: checks, the order of points, the mesh.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mesh/canonical.hpp"
#include "mesher/mesher.hpp"
#include "mesher/predicates.hpp"
#include "program/meter.hpp"
#include "refinement/distinct_order.hpp"
#include "refinement/refined_mesh.hpp"
#include "rules/mesh_box.hpp"
#include "text/text.hpp"

namespace mesher::detail {

/// `name`: of the algorithm.
template <int D>
void require_radius_edge(const Options<D>& options, const std::string& name) {
  if (options.rule == Rule::radius_edge) return;
  throw Error(ErrorCode::bad_option, name + " needs the rule radius-edge");
}

inline void require_k(double k) {
  if (k > 0 && k < 1) return;
  throw Error(ErrorCode::bad_option, "k is " + text::to_text(k) + ", it must be between 0 and 1");
}

template <int D, class Algorithm>
[[nodiscard]] Mesh<D> mesh_of(const Algorithm& algorithm, const OnFeatures& on = {}) {
  const auto& kernel = algorithm.kernel();
  const auto for_each_simplex = [&](auto&& visit) {
    kernel.for_each_finite([&](std::uint32_t s) { visit(kernel.simplices().corners(s)); });
  };
  std::vector<Point<D>> places;
  places.reserve(kernel.places());
  for (std::uint32_t v = 1; v <= kernel.places(); ++v) places.push_back(kernel.place(v));
  return canonical<D>(places, std::span(algorithm.kinds()).subspan(1), 1, on, for_each_simplex);
}

/// What all refinements are told alike. Requires: settings.least_limit is set.
template <int D, class Settings>
void set_common(Settings& settings, const Options<D>& options, const MeshBox<D>& box,
                bool follow_degrees, const RunControl& control) {
  settings.rho = options.rho;
  if constexpr (D == 3) settings.min_dihedral = options.min_dihedral;
  const auto limits = std::make_shared<Limits<D>>(options, box);
  settings.growth = options.growth;
  const bool limits_regions = settings.least_limit < Limits<D>::kNone;
  if (limits->any() || limits_regions || options.growth != 0) settings.limits = limits;
  settings.most_vertices = options.max_vertices;
  settings.follow_degrees = follow_degrees;
  if (!watches(control)) return;
  // A run that begins anew does not say so.
  settings.watch = [&control, most = std::make_shared<std::size_t>(0)](std::size_t vertices) {
    *most = std::max(*most, vertices);
    if (!report(control, {.phase = Phase::steiner, .done = *most})) fail_cancelled();
  };
}

/// `stats`: may be null.
template <int D, class Algorithm, class Stats>
void set_stats(Stats* stats, const Algorithm& algorithm, const Mesh<D>& mesh) {
  if (stats == nullptr) return;
  *stats = algorithm.stats();
  stats->vertices = mesh.vertices.size();
  stats->simplices = mesh.simplices.size();
}

/// take(algorithm) of an Algorithm that has run, in a coarse box if that will do. Bounds stronger
/// than the default may need vertices beside its sides.
template <class Algorithm, int D, class Take>
[[nodiscard]] auto refined_in(const MeshBox<D>& box, const std::vector<Point<D>>& points,
                              typename Algorithm::Settings settings, Take&& take) {
  const auto run = [&] {
    Algorithm algorithm(box, points, settings);
    algorithm.run();
    return take(algorithm);
  };
  const auto coarsest = [&] {
    if constexpr (D == 3 && requires { settings.only_enclosed; }) {
      if (settings.only_enclosed && points.size() <= kFewPoints) return kCoarsestSteps;
    }
    return kCoarseSteps;
  };
  if (settings.rho >= Options<D>{}.rho) {
    for (settings.box_steps = coarsest(); settings.box_steps <= kCoarseSteps;
         settings.box_steps *= 2) {
      try {
        return run();
      } catch (const SideReached&) {
      }
    }
  }
  settings.box_steps = 0;
  return run();
}

/// What an Algorithm makes of the points. `settings`: but for what is in `options`.
template <template <int> class Algorithm, int D, class Stats>
[[nodiscard]] Mesh<D> mesh_points(const std::vector<Point<D>>& points, const Options<D>& options,
                                  typename Algorithm<D>::Settings settings,
                                  const std::vector<PointId>& ids, Stats* stats,
                                  const RunControl& control) {
  const MeshBox<D> box = mesh_box(options);
  set_common(settings, options, box, stats != nullptr, control);
  const std::vector<Point<D>> sorted = in_distinct_order<D>(points, ids, options.domain, box);
  return refined_in<Algorithm<D>, D>(box, sorted, settings, [&](const Algorithm<D>& algorithm) {
    Mesh<D> mesh = mesh_of<D>(algorithm);
    set_stats(stats, algorithm, mesh);
    return mesh;
  });
}

}  // namespace mesher::detail
