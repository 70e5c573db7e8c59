// Out of memory at every allocation, one after the other, of an update of a mesh with a largest
// area.
#include <catch2/catch.hpp>

#include "any_id.hpp"
#include "facade/box_mesher.hpp"
#include "failing_update.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Mesh;
using mesher::Options;

AnyId id(std::int64_t i) { return AnyId{i}; }

Options<2> options() {
  Options<2> o{.domain = {{0, 0}, {16, 16}}};
  o.max_measure = 6;
  return o;
}

// A wall in a room that is filled. A point comes on a place that is filled, another near the wall,
// which moves.
struct Filled {
  BoxMesher<2> m{options()};
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

// From no limit to one, with a box that has another.
struct Limited {
  BoxMesher<2> m{Options<2>{.domain = {{0, 0}, {16, 16}}}};
  Mesh<2> before;

  Limited() {
    m.insert({id(1), id(2), id(3)}, {{2, 8}, {13, 8.5}, {8, 3}});
    m.insert_segment(id(1), id(1), id(2));
    m.update();
    before = m.mesh();
  }
  void announce() {
    m.limit({.max_measure = 6});
    m.limit({{6, 6}, {9, 10}}, {.max_measure = 1});
    m.insert(id(4), {8, 8.5});
    m.remove(id(3));
  }
};

// Back to no limit.
struct Unlimited : Limited {
  Unlimited() {
    Limited::announce();
    m.update();
    before = m.mesh();
  }
  void announce() {
    m.limit(mesher::SizeLimits<2>());
    m.move(id(2), {13, 9.5});
  }
};

// A change in a box alone.
struct Boxed : Limited {
  Boxed() {
    Limited::announce();
    m.update();
    before = m.mesh();
  }
  void announce() { m.limit({{5, 8}, {8, 11}}, {.max_measure = 0.5}); }
};

}  // namespace

TEST_CASE("an update in which limits come and any one allocation fails leaves all, works again") {
  support::check_failing_updates<Limited>();
}

TEST_CASE("an update in which limits go and any one allocation fails leaves all, works again") {
  support::check_failing_updates<Unlimited>();
}

TEST_CASE("an update with limits in a box in which any one allocation fails leaves all") {
  support::check_failing_updates<Boxed>();
}

TEST_CASE("an update of a filled mesh in which any one allocation fails leaves it, works again") {
  support::check_failing_updates<Filled>();
}
