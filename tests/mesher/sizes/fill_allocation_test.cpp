// Out of memory at every allocation, one after the other, of an update of a mesh with a largest
// area.
#include <catch2/catch.hpp>

#include "failing_new.hpp"
#include "mesher/mesher.hpp"

namespace {

using mesher::FeatureId;
using mesher::Mesh;
using mesher::Mesher;
using mesher::Options;

FeatureId id(std::int64_t i) { return FeatureId{i}; }

Options<2> options() {
  Options<2> o{.domain = {{0, 0}, {16, 16}}};
  o.max_area = 6;
  return o;
}

// A wall in a room that is filled. A point comes on a place that is filled, another near the wall,
// which moves.
struct Filled {
  Mesher<2> m{options()};
  Mesh<2> before;

  Filled() {
    m.insert({id(1), id(2), id(3)}, {{2, 8}, {13, 8.5}, {8, 3}});
    m.insert_segment(id(1), id(1), id(2));
    m.update();
    before = m.mesh();
  }
  [[nodiscard]] mesher::Point<2> filled_place() const {
    for (std::size_t i = 0;; ++i) {
      const auto& p = before.vertices.at(i);
      const bool inside = p[0] > 4 && p[0] < 12 && p[1] > 10 && p[1] < 14;
      if (inside && before.kinds[i] == mesher::VertexKind::steiner) return p;
    }
  }
  void announce() {
    m.insert(id(4), {8, 8.5});
    m.insert(id(5), filled_place());
    m.move(id(2), {13, 9.5});
    m.remove(id(3));
  }
};

}  // namespace

TEST_CASE("an update of a filled mesh in which any one allocation fails leaves it, works again") {
  Filled whole;
  whole.announce();
  whole.m.update();
  const Mesh<2> expected = whole.m.mesh();
  REQUIRE_FALSE(expected == whole.before);
  bool burnt = true;
  std::uint64_t count = 1;
  for (; burnt; ++count) {
    CAPTURE(count);
    Filled f;
    f.announce();
    const bool failed = support::fails(count, burnt, [&] { f.m.update(); });
    f.m.check_invariants();
    if (failed) {
      REQUIRE(f.m.mesh() == f.before);
      f.announce();
      f.m.update();
      f.m.check_invariants();
    }
    REQUIRE(f.m.mesh() == expected);
  }
  CHECK(count > 100);
}
