// What fits together and what does not: cases by name, and random triangles against exact tests.
#include "space/validity.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <optional>
#include <vector>

#include "feature_ids.hpp"
#include "feature_scene.hpp"
#include "space/all_fit.hpp"
#include "triangle_pairs.hpp"

namespace {

using namespace mesher::detail;
using mesher::Error;
using mesher::ErrorCode;
using mesher::LineId;
using mesher::Point;
using mesher::PointId;
using mesher::PolygonId;
using support::Motion;
using support::TrianglePair;

// Names are handles.
struct HandleNames : SpaceNames {
  PointId point(VertexHandle v) const override { return PointId{v}; }
  std::optional<LineId> segment(EdgeHandle e) const override {
    const auto it = segments.find(e);
    return it == segments.end() ? std::nullopt : std::optional(it->second);
  }
  PolygonId polygon(PolygonHandle f) const override { return PolygonId{f}; }
  std::map<EdgeHandle, LineId> segments;
};

struct Plc {
  explicit Plc(Motion moved = {}) : motion(moved) {}

  VertexHandle point(double x, double y, double z) {
    const Point<3> p = motion({x, y, z});
    const auto [it, fresh] = points.try_emplace(p, 0);
    if (fresh) it->second = scene.add_point(p)->self;
    return it->second;
  }
  const Edge& segment(VertexHandle a, VertexHandle b, std::int64_t id = 1) {
    const Edge& e = scene.features().insert(a, b);
    names.segments[e.self] = LineId{id};
    return e;
  }
  const Polygon& polygon(PolygonParts parts) { return scene.features().insert(std::move(parts)); }
  const Polygon& polygon(Loop loop) { return polygon(PolygonParts{{std::move(loop)}, {}, {}}); }

  // Of all features, with all.
  std::optional<SpaceConflict> conflict() {
    FeatureStore& store = scene.features().store();
    std::optional<SpaceConflict> first;
    for (const auto& [place, h] : points) keep_first(first, conflict_of(scene.pool()[h], store));
    store.edges().for_each([&](const Edge& e) {
      if (e.alive) keep_first(first, conflict_of(e, store, scene.point_tree()));
    });
    store.polygons().for_each([&](const Polygon& f) {
      if (f.alive) keep_first(first, conflict_of(f, store, scene.point_tree()));
    });
    REQUIRE(all_fit(store, [] {}) == !first.has_value());
    return first;
  }
  std::string message() {
    const auto first = conflict();
    if (!first) return "fits";
    try {
      fail(*first, names, scene.store());
    } catch (const Error& error) {
      return error.what();
    }
  }
  Motion motion;
  sac::PlainScope scope;
  support::FeatureScene<sac::PlainScope> scene{1, scope};
  HandleNames names;
  std::map<Point<3>, VertexHandle> points;
};

std::vector<Motion> motions() {
  mesher::SplitMix64 random(5);
  std::vector<Motion> all(1);
  for (int i = 0; i < 5; ++i) all.push_back(support::random_motion(random));
  return all;
}

Loop square(Plc& plc, double x, double y, double z, double side) {
  return {plc.point(x, y, z), plc.point(x + side, y, z), plc.point(x + side, y + side, z),
          plc.point(x, y + side, z)};
}

template <class Build>
void require_kind(std::optional<SpaceConflict::Kind> kind, Build&& build) {
  for (const Motion& motion : motions()) {
    Plc plc(motion);
    build(plc);
    const auto conflict = plc.conflict();
    INFO(plc.message());
    REQUIRE(conflict.has_value() == kind.has_value());
    if (kind) REQUIRE(conflict->kind == *kind);
  }
}

using Kind = SpaceConflict::Kind;

}  // namespace

TEST_CASE("Polygons around a box, with a wall and a hole, fit together") {
  require_kind(std::nullopt, [](Plc& plc) {
    const auto at = [&](double x, double y, double z) { return plc.point(x, y, z); };
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {0.0, 1.0}) {
        Loop loop;
        for (const auto& [u, v] : {std::pair(0., 0.), {1., 0.}, {1., 1.}, {0., 1.}}) {
          Point<3> p{};
          p[axis] = side, p[(axis + 1) % 3] = u, p[(axis + 2) % 3] = v;
          loop.push_back(at(p[0], p[1], p[2]));
        }
        plc.polygon(loop);
      }
    }
    plc.polygon({{square(plc, 0.1, 0.1, 0.5, 0.8), square(plc, 0.3, 0.3, 0.5, 0.2)}, {}, {}});
    plc.polygon(square(plc, 0.3, 0.3, 0.5, 0.2));  // fills the hole
    plc.segment(at(0.3, 0.3, 0.5), at(0.3, 0.3, 0.7));
    plc.segment(at(0, 0, 0), at(0.1, 0.1, 0.1));
  });
}

TEST_CASE("A wall on the inside of a floor that declares its edge fits, else its edge is named") {
  const auto build = [](Plc& plc, bool declared) {
    const VertexHandle a = plc.point(0.25, 0.5, 0), b = plc.point(0.75, 0.5, 0);
    PolygonParts floor{{square(plc, 0, 0, 0, 1)}, {}, {a, b}};
    if (declared) floor.edges = {{a, b}};
    plc.polygon(floor);
    plc.polygon(Loop{a, b, plc.point(0.75, 0.5, 1), plc.point(0.25, 0.5, 1)});
  };
  require_kind(std::nullopt, [&](Plc& plc) { build(plc, true); });
  require_kind(Kind::edge_on_polygon, [&](Plc& plc) { build(plc, false); });
}

TEST_CASE("Points on edges and polygons are conflicts, those beside are not") {
  require_kind(Kind::point_on_edge, [](Plc& plc) {
    plc.segment(plc.point(0, 0, 0), plc.point(1, 1, 0));
    plc.point(0.5, 0.5, 0);
  });
  require_kind(Kind::point_on_polygon, [](Plc& plc) {
    plc.polygon(square(plc, 0, 0, 0, 1));
    plc.point(0.5, 0.25, 0);
  });
  require_kind(std::nullopt, [](Plc& plc) {
    plc.segment(plc.point(0, 0, 0), plc.point(1, 1, 0));
    plc.polygon(square(plc, 0, 0, 1, 1));
    plc.point(0.5, 0.5, 1e-9);
    plc.point(1.25, 0.5, 1);
    plc.point(2, 2, 0);
    plc.point(0.5, 0.5, 1 - 1e-9);
  });
}

TEST_CASE("Edges that cross or overlap are conflicts, those that pass are not") {
  require_kind(Kind::crossing_edges, [](Plc& plc) {
    plc.segment(plc.point(0, 0, 0), plc.point(1, 1, 0));
    plc.segment(plc.point(0, 1, 0), plc.point(1, 0, 0));
  });
  require_kind(Kind::point_on_edge, [](Plc& plc) {
    const VertexHandle a = plc.point(0, 0, 0);
    plc.segment(a, plc.point(1, 1, 1));
    plc.segment(a, plc.point(2, 2, 2));
  });
  require_kind(std::nullopt, [](Plc& plc) {
    plc.segment(plc.point(0, 0, 0), plc.point(1, 1, 0));
    plc.segment(plc.point(0, 1, 1e-9), plc.point(1, 0, 1e-9));
    plc.segment(plc.point(2, 2, 0), plc.point(3, 3, 0));
  });
}

TEST_CASE("Segments through polygons are conflicts, those that end at a corner are not") {
  require_kind(Kind::edge_through_polygon, [](Plc& plc) {
    plc.polygon(square(plc, 0, 0, 0, 1));
    plc.segment(plc.point(0.5, 0.25, -1), plc.point(0.5, 0.5, 1));
  });
  require_kind(std::nullopt, [](Plc& plc) {
    plc.polygon(square(plc, 0, 0, 0, 1));
    plc.segment(plc.point(0, 0, 0), plc.point(0.5, 0.5, 1));
    plc.segment(plc.point(1.5, 0.25, -1), plc.point(1.5, 0.5, 1));
  });
}

// One end is nearer to the plane than corners are, wherever that is between these, but the border's
// edges are far: such edges would be split without end.
TEST_CASE("A segment goes through a polygon that is not quite flat, however near to its plane") {
  for (const double off : {1e-10, 1e-9}) {
    const auto build = [&](Plc& plc, double x) {
      plc.polygon(
          Loop{plc.point(0, 0, 0), plc.point(1, 0, off), plc.point(1, 1, 0), plc.point(0, 1, off)});
      plc.segment(plc.point(x - 0.1, 0.52, 1.5 * off), plc.point(x + 1.1, 0.48, -0.9 * off));
    };
    INFO(off);
    require_kind(Kind::edge_through_polygon, [&](Plc& plc) { build(plc, 0); });
    require_kind(std::nullopt, [&](Plc& plc) { build(plc, 2); });
  }
}

TEST_CASE("Polygons that cross without an edge through one are conflicts") {
  require_kind(Kind::crossing_polygons, [](Plc& plc) {  // along the diagonal of both
    const VertexHandle a = plc.point(0, 0, 0), b = plc.point(1, 1, 1);
    plc.polygon(Loop{a, plc.point(1, 0, 0), b, plc.point(0, 1, 1)});
    plc.polygon(Loop{a, plc.point(0, 1, 0), b, plc.point(1, 0, 1)});
  });
  require_kind(std::nullopt, [](Plc& plc) {  // the common points' middle is in a bay of one
    const VertexHandle a = plc.point(0, 0, 0), b = plc.point(2, 0, 0);
    plc.polygon(Loop{a, plc.point(1, 2, 0), b, plc.point(1, 1, 0)});
    plc.polygon(Loop{a, b, plc.point(1, 0, 2)});
  });
}

TEST_CASE("Polygons that overlap in their plane are conflicts, those side by side are not") {
  require_kind(Kind::edge_on_polygon, [](Plc& plc) {
    const VertexHandle a = plc.point(0, 0, 0), b = plc.point(1, 0, 0), c = plc.point(0.5, 1, 0);
    plc.polygon(Loop{a, b, c});
    plc.polygon(Loop{a, b, plc.point(1.5, 1, 0), c});
  });
  require_kind(Kind::overlapping_polygons, [](Plc& plc) {
    const Loop inner = square(plc, 1, 1, 0, 1);
    plc.polygon(
        {{square(plc, 0, 0, 0, 3)},
         {{inner[0], inner[1]}, {inner[1], inner[2]}, {inner[2], inner[3]}, {inner[3], inner[0]}},
         {}});
    plc.polygon(inner);
  });
  require_kind(std::nullopt, [](Plc& plc) {
    plc.polygon(square(plc, 0, 0, 0, 1));
    plc.polygon(square(plc, 1, 0, 0, 1));
    plc.polygon(square(plc, 1, 1, 0, 1));
  });
}

TEST_CASE("Pages at small angles fit together") {
  const double angle = GENERATE(1e-1, 1e-3, 1e-6, 1e-10);
  require_kind(std::nullopt, [&](Plc& plc) {
    const VertexHandle a = plc.point(0, 0, 0), b = plc.point(0, 1, 0);
    for (int i = 0; i < 4; ++i) {
      const double x = std::cos(i * angle), z = std::sin(i * angle);
      plc.polygon(Loop{a, b, plc.point(x, 1, z), plc.point(x, 0, z)});
    }
  });
}

TEST_CASE("Two random triangles fit together if they have only what their common corners span") {
  const std::uint64_t seed = GENERATE(1, 2, 3, 4);
  CAPTURE(seed);
  mesher::SplitMix64 random(seed);
  std::size_t fitting = 0, total = 0;
  for (int round = 0; round < 1500; ++round) {
    const auto side = 2 + random.below(3);
    TrianglePair::Triangle t, u;
    for (auto* triangle : {&t, &u}) {
      for (auto& corner : *triangle) {
        for (auto& x : corner) x = static_cast<std::int64_t>(random.below(side));
      }
    }
    for (int i = 0; i < 2; ++i) {
      if (random.below(2) == 0) u[random.below(3)] = t[random.below(3)];
    }
    if (!TrianglePair::has_area(t) || !TrianglePair::has_area(u)) continue;
    const bool fit = TrianglePair(t, u).fit();
    if (std::is_permutation(t.begin(), t.end(), u.begin())) continue;
    ++total, fitting += fit;
    for (const Motion& motion : {Motion{}, support::random_motion(random)}) {
      Plc plc(motion);
      for (const auto& triangle : {t, u}) {
        Loop loop;
        for (const auto& c : triangle) {
          loop.push_back(plc.point(static_cast<double>(c[0]) / 4, static_cast<double>(c[1]) / 4,
                                   static_cast<double>(c[2]) / 4));
        }
        plc.polygon(loop);
      }
      INFO(plc.message());
      CAPTURE(round, t, u);
      REQUIRE(!plc.conflict().has_value() == fit);
    }
  }
  REQUIRE(fitting > total / 10);
  REQUIRE(fitting < total * 9 / 10);
}

TEST_CASE("A point, an edge and a triangle are judged beside few of a polygon's 10000 corners") {
  const auto looked_at = [](int n) {
    Plc plc;
    Loop round;
    for (int i = 0; i < n; ++i) {
      const double at = 6.283185307179586 * i / n;
      round.push_back(plc.point(0.5 + 0.4 * std::cos(at), 0.5 + 0.4 * std::sin(at), 0.5));
    }
    plc.polygon(round);
    FeatureStore& store = plc.scene.features().store();
    const VertexHandle a = plc.point(0.5, 0.4, 0.25), b = plc.point(0.5, 0.4, 0.75);
    const VertexHandle on_it = plc.point(0.5, 0.6, 0.5);
    const std::uint64_t before = store.looked_at();
    REQUIRE(conflict_of(plc.scene.pool()[on_it], store)->kind == Kind::point_on_polygon);
    const Edge& through = plc.segment(a, b);
    REQUIRE(conflict_of(through, store, plc.scene.point_tree())->kind ==
            Kind::edge_through_polygon);
    const Polygon& triangle = plc.polygon({a, b, on_it});
    static_cast<void>(conflict_of(triangle, store, plc.scene.point_tree()));
    return store.looked_at() - before;
  };
  const std::uint64_t few = looked_at(100), many = looked_at(10000);
  CAPTURE(few, many);
  CHECK(many < few + 150);
}

TEST_CASE("Errors name both features and the place") {
  Plc plc;
  const Polygon& f = plc.polygon(square(plc, 0, 0, 0, 1));
  const Edge& e = plc.segment(plc.point(0.5, 0.25, -1), plc.point(0.5, 0.25, 1), 7);
  static_cast<void>(e);
  REQUIRE(f.self == 1);
  REQUIRE(plc.message() ==
          "error[segment_through_polygon]: segment 7 goes through polygon 1 at (0.5, 0.25, 0)");
  Plc crossing;
  crossing.polygon(square(crossing, 0, 0, 0, 1));
  const VertexHandle on_it = crossing.point(0.5, 0.5, 0);
  crossing.segment(crossing.point(0.5, -1, 0), on_it, 3);
  REQUIRE(crossing.message() ==
          "error[point_on_polygon]: point 5 lies on polygon 1 at (0.5, 0.5, 0), which does "
          "not declare it");
}

TEST_CASE("A polygon that crosses itself is told so") {
  Plc plc;
  plc.polygon(Loop{plc.point(0, 0, 0), plc.point(3, 0, 0), plc.point(3, 1, 0), plc.point(1, -1, 0),
                   plc.point(0, 2, 0)});
  REQUIRE(plc.message().substr(0, 25) == "error[crossing_segments]:");
  REQUIRE(plc.message().find("an edge of polygon 1 crosses another of it at") != std::string::npos);
}

TEST_CASE("What is no polygon is refused, with its id and the place") {
  Plc plc;
  mesher::Position at{};
  const auto code = [&](PolygonParts parts) -> std::string {
    Polygon& f = plc.scene.features().store().record(std::move(parts));
    try {
      require_shape(f, PolygonId{9}, plc.scene.store());
    } catch (const Error& error) {
      REQUIRE(support::ids_of(error) == support::ids({9}));
      REQUIRE(error.places().size() == 1);
      at = error.places()[0];
      return std::string(code_name(error.code()));
    }
    return "";
  };
  const Loop outer = square(plc, 0, 0, 0, 1), hole = square(plc, 0.25, 0.25, 0, 0.4);
  const Loop beside = square(plc, 1.5, 1.5, 0, 1);
  const VertexHandle in = plc.point(0.75, 0.75, 0), out = plc.point(3, 3, 0),
                     up = plc.point(0.75, 0.75, 1);
  REQUIRE(code({{outer, hole}, {}, {in}}).empty());
  REQUIRE(code({{outer}, {{hole[0], hole[1]}, {hole[1], in}}, {}}).empty());
  REQUIRE(code({{{outer[0], outer[1], out}}, {}, {}}).empty());
  REQUIRE(code({{{outer[0], outer[2], out}}, {}, {}}) == "bad_polygon");  // on one line
  CHECK(at == mesher::position_of(Point<3>{0, 0, 0}));
  REQUIRE(code({{{outer[0], outer[1], up, outer[3]}}, {}, {}}) == "not_flat");
  REQUIRE(code({{outer}, {}, {up}}) == "not_flat");
  CHECK(at == mesher::position_of(Point<3>{0.75, 0.75, 1}));
  REQUIRE(code({{outer, beside}, {}, {}}) == "bad_polygon");
  CHECK(at == mesher::position_of(Point<3>{1.5, 1.5, 0}));
  REQUIRE(code({{outer}, {}, {out}}) == "bad_polygon");
  CHECK(at == mesher::position_of(Point<3>{3, 3, 0}));
  REQUIRE(code({{outer, hole}, {{outer[0], outer[2]}}, {}}) == "bad_polygon");  // through the hole
  REQUIRE(code({{outer, {outer[0], outer[1], in}}, {}, {}}) == "bad_polygon");  // an edge twice
}
