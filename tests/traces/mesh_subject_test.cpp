// The mesher's traces over random edits, in the plane and in space: concise, monotone, those of
// runs from scratch, and no propagation does more than twice the distance of the traces.
#include "mesh_subject.hpp"

#include <catch2/catch.hpp>
#include <cstdint>

#include "mesher/extra/generate.hpp"
#include "traces/audit.hpp"
#include "traces/stability.hpp"

namespace {

template <int D>
tool::MeshSubject<D> subject(mesher::PointKind kind, mesher::Rule rule, std::uint64_t seed) {
  auto points = mesher::generate_points<D>(kind, 50, seed);
  mesher::Options<D> options;
  options.domain = mesher::snapped_domain<D>(points);
  options.rule = rule;
  options.record_weights = true;
  return {options, std::move(points), seed};
}

constexpr mesher::PointKind kKinds[] = {mesher::PointKind::uniform, mesher::PointKind::clusters,
                                        mesher::PointKind::grid, mesher::PointKind::line_circle};

}  // namespace

TEMPLATE_TEST_CASE_SIG("an update of a mesh does at most twice the distance of the traces",
                       "[Theorem 1.4.4]", ((int D), D), 2, 3) {
  for (const auto kind : kKinds) {
    const auto seed = 5 + static_cast<std::uint64_t>(kind);
    auto mesh = subject<D>(kind, mesher::Rule::radius_edge, seed);
    for (const auto& row : traces::stability(mesh, D == 2 ? 20 : 8)) {
      INFO("kind " << static_cast<int>(kind) << ", seed " << seed << ": work " << row.work()
                   << ", distance " << row.distance);
      CHECK(row.drift == 0);
      CHECK(row.distance > 0);
      CHECK(row.work() <= 2 * row.distance);
      CHECK(row.weight_distance > row.distance);
      CHECK(row.weight_work() <= 2 * row.weight_distance);
    }
  }
}

TEMPLATE_TEST_CASE_SIG("traces of meshes are concise, and monotone from edit to edit",
                       "[Def 1.4.2, 1.4.3]", ((int D), D), 2, 3) {
  for (const auto rule : {mesher::Rule::radius_edge, mesher::Rule::voronoi_aspect}) {
    const std::uint64_t seed = 3;
    auto mesh = subject<D>(mesher::PointKind::uniform, rule, seed);
    traces::Trace before = mesh.fresh_trace();
    for (int i = 0; i < 6; ++i) {
      mesh.edit();
      traces::Trace after = mesh.fresh_trace();
      INFO("rule " << static_cast<int>(rule) << ", seed " << seed << ", edit " << i);
      CHECK(after.unnamed == 0);
      CHECK(traces::check_concise(after).surplus == 0);
      CHECK(traces::check_monotone(before, after).moved == 0);
      before = std::move(after);
    }
  }
}
