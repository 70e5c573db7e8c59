// Limits of size that are edited: when they count, what is refused, what it costs.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <memory>

#include "any_id.hpp"
#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "mesher/error.hpp"
#include "mesher/sizes.hpp"
#include "random_limits.hpp"

namespace {

using mesher::Box;
using mesher::BoxMesher;
using mesher::Error;
using mesher::ErrorCode;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using mesher::Segment;
using mesher::SizeLimits;

constexpr Box<2> kDomain{{0, 0}, {16, 16}};
constexpr Box<2> kMiddle{{5, 5}, {9, 9}};

AnyId id(std::int64_t i) { return AnyId{i}; }

std::vector<Point<2>> points(double scale = 1) {
  std::vector<Point<2>> all{{2, 8}, {13, 8.5}, {8, 3}, {6.5, 6}};
  for (auto& p : all) p = {p[0] * scale, p[1] * scale};
  return all;
}
Box<2> scaled(const Box<2>& b, double scale) {
  return {{b.lo[0] * scale, b.lo[1] * scale}, {b.hi[0] * scale, b.hi[1] * scale}};
}

template <class Target>
void announce(Target& m, double scale = 1) {
  std::int64_t next = 1;
  for (const auto& p : points(scale)) m.insert(id(next++), p);
  m.insert_segment(id(1), id(1), id(2));
}
Mesh<2> from_scratch(const Options<2>& options, double scale = 1) {
  return mesh_statically(points(scale), {Segment{id(1), id(1), id(2)}}, options);
}

struct Room {
  BoxMesher<2> m{Options<2>{.domain = kDomain}};
  Room() {
    announce(m);
    m.update();
  }
};

ErrorCode code(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::cannot_read;
}

}  // namespace

TEST_CASE("A limit comes, changes in a box, and goes again, with the next update each time") {
  Room room;
  const Mesh<2> without = room.m.mesh();
  room.m.limit({.max_measure = 0.5});
  CHECK(room.m.options().max_measure == 0);
  room.m.update();
  CHECK(room.m.options().max_measure == 0.5);
  CHECK(room.m.mesh() == from_scratch(room.m.options()));
  const Mesh<2> coarse = room.m.mesh();
  room.m.limit(kMiddle, {.max_measure = 0.01});
  const auto change = room.m.update();
  CHECK(room.m.mesh() == from_scratch(room.m.options()));
  for (const auto& v : change.vertices_added) {
    CHECK((v[0] > 3 && v[0] < 11 && v[1] > 3 && v[1] < 11));
  }
  room.m.limit(kMiddle, {.max_measure = 0.5});
  room.m.update();
  CHECK(room.m.options().box_limits.empty());
  CHECK(room.m.mesh() == coarse);
  room.m.limit(SizeLimits<2>());
  room.m.update();
  CHECK(room.m.mesh() == without);
  room.m.check_invariants();
}

TEST_CASE("Limits are announced with other edits, and before the first update, too") {
  BoxMesher<2> m({.domain = kDomain});
  announce(m);
  m.limit({.max_measure = 1});
  m.limit(kMiddle, {.max_measure = 0.1});
  m.update();
  CHECK(m.mesh() == from_scratch(m.options()));
  m.limit(kMiddle, {});
  m.move(id(4), {7, 7});
  m.update();
  auto moved = points();
  moved[3] = {7, 7};
  CHECK(m.mesh() == mesh_statically(moved, {Segment{id(1), id(1), id(2)}}, m.options()));
}

TEST_CASE("A limit changed to what it is runs no call") {
  Room room;
  const auto sizes = std::make_shared<support::Chessboard>();
  room.m.limit({.max_measure = 0.5, .sizes = sizes});
  room.m.limit(kMiddle, {.max_measure = 0.1});
  room.m.update();
  room.m.limit(kMiddle, {.max_measure = 0.1});
  CHECK(room.m.update().calls.executed == 0);
  room.m.limit(kMiddle, {.max_measure = 0.2});
  room.m.limit(kMiddle, {.max_measure = 0.1});
  CHECK(room.m.update().calls.executed == 0);
  room.m.limit(SizeLimits<2>());
  room.m.limit({.max_measure = 0.5, .sizes = sizes});
  room.m.limit(kMiddle, {.max_measure = 0.1});
  CHECK(room.m.update().calls.executed == 0);
}

TEST_CASE("A box without a place of the domain, or with one place, changes what it should") {
  Room room;
  room.m.limit({.max_measure = 0.4375});
  room.m.update();
  const Mesh<2> before = room.m.mesh();
  room.m.limit({{20, 20}, {30, 30}}, {.max_measure = 0.01});
  room.m.update();
  CHECK(room.m.mesh() == before);
  for (const Point<2> p : {Point<2>{7, 7}, Point<2>{0, 0}, Point<2>{7.3, 6.9}}) {
    room.m.limit({p, p}, {.max_measure = 0.01});
    room.m.update();
    CHECK(room.m.mesh() == from_scratch(room.m.options()));
  }
}

TEST_CASE("Limits that make no sense are refused when they are announced, and change nothing") {
  Room room;
  room.m.limit({.max_measure = 0.5});
  const auto bad = [&](const Box<2>& box, const SizeLimits<2>& limits) {
    return code([&] { room.m.limit(box, limits); }) == ErrorCode::bad_option;
  };
  CHECK(bad(kMiddle, {.max_measure = -1}));
  CHECK(bad(kMiddle, {.max_measure = std::nan("")}));
  CHECK(bad(kMiddle, {.max_measure = 1e-30}));
  CHECK(bad({{2, 2}, {1, 3}}, {.max_measure = 1}));
  CHECK(bad({{std::nan(""), 2}, {1, 3}}, {.max_measure = 1}));
  room.m.update();
  CHECK(room.m.options().box_limits.empty());
  CHECK(room.m.mesh() == from_scratch(room.m.options()));
  BoxMesher<2> other({.domain = kDomain, .rule = mesher::Rule::voronoi_aspect});
  CHECK(code([&] { other.limit({.max_measure = 1}); }) == ErrorCode::bad_option);
  other.limit(SizeLimits<2>());
}

TEST_CASE("An update that is refused, stopped or discarded leaves the mesh and the limits") {
  Room room;
  room.m.limit({.max_measure = 0.5});
  room.m.update();
  const Mesh<2> before = room.m.mesh();
  const auto unchanged = [&] {
    room.m.check_invariants();
    return room.m.mesh() == before && room.m.options().max_measure == 0.5 &&
           room.m.options().box_limits.empty();
  };
  // A size is found out to be bad while the update is under way.
  room.m.limit(kMiddle, {.sizes = std::make_shared<mesher::SlopedSizes<2>>(
                             [](const Point<2>& p) { return p[0] > 8 ? -1.0 : 0.1; }, 0, 0.1)});
  CHECK(code([&] { room.m.update(); }) == ErrorCode::bad_option);
  CHECK(unchanged());
  // Another edit of the batch is bad.
  room.m.limit(SizeLimits<2>());
  room.m.remove(id(1));
  CHECK(code([&] { room.m.update(); }) == ErrorCode::point_in_use);
  CHECK(unchanged());
  // Somebody stops it; it stays announced.
  room.m.limit(kMiddle, {.max_measure = 0.01});
  mesher::RunControl control;
  control.progress = [](const mesher::Progress& p) { return p.done < 300; };
  CHECK(code([&] { room.m.update(control); }) == ErrorCode::cancelled);
  CHECK(unchanged());
  room.m.update();
  CHECK(room.m.mesh() == from_scratch(room.m.options()));
  room.m.limit(kMiddle, {.max_measure = 0.5});
  room.m.update();
  room.m.limit(kMiddle, {.max_measure = 0.01});
  room.m.discard_edits();
  CHECK(room.m.update().calls.executed == 0);
  CHECK(unchanged());
}

TEST_CASE("A limit that needs more vertices than there may be is refused") {
  BoxMesher<2> m({.domain = kDomain, .max_vertices = 500});
  announce(m);
  m.update();
  const Mesh<2> before = m.mesh();
  m.limit(kMiddle, {.max_measure = 0.001});
  CHECK(code([&] { m.update(); }) == ErrorCode::too_many);
  CHECK(m.mesh() == before);
  m.check_invariants();
}

TEST_CASE("At scales of 2^-60 and 2^60 limits are edited as at 1") {
  for (const double scale : {0x1p-60, 0x1p60}) {
    BoxMesher<2> m({.domain = scaled(kDomain, scale)});
    announce(m, scale);
    m.update();
    const double unit = scale * scale;
    m.limit({.max_measure = 0.5 * unit});
    m.limit(scaled(kMiddle, scale), {.max_measure = 0.05 * unit});
    m.update();
    CHECK(m.mesh() == from_scratch(m.options(), scale));
    BoxMesher<2> one({.domain = kDomain});
    announce(one);
    one.limit({.max_measure = 0.5});
    one.limit(kMiddle, {.max_measure = 0.05});
    one.update();
    const Mesh<2> small = one.mesh();
    REQUIRE(m.mesh().vertices.size() == small.vertices.size());
    CHECK(m.mesh().simplices == small.simplices);
    m.limit(scaled(kMiddle, scale), {});
    m.update();
    CHECK(m.mesh() == from_scratch(m.options(), scale));
    m.check_invariants();
  }
}

TEST_CASE("Many boxes over each other are forgotten where later ones cover them") {
  Room room;
  room.m.limit({.max_measure = 1});
  room.m.update();
  for (int step = 0; step < 40; ++step) {
    const double x = 0.25 * step;
    room.m.limit({{x - 0.25, 4}, {x + 2.75, 7}}, {.max_measure = 1});
    room.m.limit({{x, 4}, {x + 3, 7}}, {.max_measure = 0.1});
    room.m.update();
    REQUIRE(room.m.options().box_limits.size() <= 2);
  }
  CHECK(room.m.mesh() == from_scratch(room.m.options()));
}

TEST_CASE("A Mesher's limits are edited as those of a BoxMesher") {
  mesher::Mesher<2> m(Options<2>{.domain = kDomain});
  announce(m);
  m.update();
  m.limit({.max_measure = 1});
  m.limit(kMiddle, {.max_measure = 0.1});
  m.update();
  CHECK(m.box_mesh() == from_scratch(m.options()));
  m.check_invariants();
}
