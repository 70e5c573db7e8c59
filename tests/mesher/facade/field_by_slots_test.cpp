// The example of a solver's field holds, and the README shows a part of it.
#include "field_by_slots.hpp"

#include <map>

#include "feature_ids.hpp"
#include "mesher/extra/generate.hpp"
#include "snippets.hpp"

using support::id;

TEST_CASE("a solver's field by slots has the values that vertices had before an edit") {
  mesher::Mesher<2> m({.domain = {{0, 0}, {1, 1}}, .extent = mesher::Extent::box});
  m.keep_slots(true);
  example::Heat heat{m, {}};
  mesher::SplitMix64 random(1);
  for (int i = 0; i < 40; ++i) {
    m.insert(id(i), {0.25 + random.unit() / 2, 0.25 + random.unit() / 2});
  }
  heat.update();
  for (int i = 0; i < 30; ++i) {
    example::relax(m.live(), heat.at);
    std::map<mesher::Point<2>, double> before;  // by place, from all of the mesh
    for (const auto& p : m.box_mesh().vertices) before[p] = heat.at[m.live().find(p)];
    if (i % 3 == 0) m.remove(id(i));
    m.insert(id(100 + i), {0.25 + random.unit() / 2, 0.25 + random.unit() / 2});
    heat.update();
    for (const auto& p : m.box_mesh().vertices) {
      const auto it = before.find(p);
      REQUIRE(heat.at[m.live().find(p)] == (it == before.end() ? p[0] : it->second));
    }
  }
}

TEST_CASE("the README's solver is a part of the example") {
  CHECK(support::is_mesher_snippet("README.md", "struct Heat {", "examples/field_by_slots.hpp"));
}
