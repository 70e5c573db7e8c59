// The engine's detectors have nothing to say about the mesher: its program is concise and monotone.
#include <catch2/catch.hpp>

#include "edit_sequence.hpp"
#include "traced_world.hpp"

TEST_CASE(
    "no two calls have one label, and none is made again, over random edits [Def 1.4.2, 1.4.3]") {
  for (const support::Family family : support::kFamilies) {
    for (const auto rule : {mesher::Rule::radius_edge, mesher::Rule::voronoi_aspect}) {
      mesher::Options<2> options;
      options.rule = rule;
      const auto sequence = random_sequence(family, options, 40, 150, 11);
      support::TracedWorld world(sequence.options);
      support::PointSet points;
      for (const auto& step : sequence.steps) {
        for (const auto& edit : step) perform(edit, world, points);
        world.update();
      }
      INFO(name(family) << ", rule " << static_cast<int>(rule) << ", seed " << sequence.seed);
      const sac::AuditReport& report = world.engine().audit();
      CHECK(report.duplicates == 0);
      CHECK(report.first_duplicate == "");
      CHECK(report.reordered == 0);
      CHECK(report.first_reordered == "");
    }
  }
}
