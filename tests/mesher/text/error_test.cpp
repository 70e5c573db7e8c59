// What the mesher refuses, how it says so, and that nothing has changed afterwards.
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "edit_sequence.hpp"
#include "mesher/check.hpp"
#include "mesher/mesher.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::Error;
using mesher::ErrorCode;
using mesher::FeatureId;
using mesher::Mesh;
using mesher::Mesher;
using mesher::Options;
using mesher::Point;
using support::error_of;

const Options<2> kUnit{.domain = {{0, 0}, {1, 1}}};

// Far from the origin doubles are sparse: neighbouring ones leave no room for new vertices.
constexpr double kFar = 0x1p30;
constexpr double kStep = 0x1p-22;  // between doubles there
const Options<2> kFarAway{.domain = {{kFar, kFar}, {kFar + 1, kFar + 1}}, .rho = 1.1};
const Point<2> kA{kFar + 0.5, kFar + 0.5};
const Point<2> kBesideA{kFar + 0.5 + kStep, kFar + 0.5};

// The error's code and words, after a look that the mesher is as before.
template <class Run>
std::string refused(Mesher<2>& m, Run run) {
  const Mesh<2> before = m.mesh();
  const std::size_t size = m.size();
  const Error error = error_of(run);
  CHECK(m.size() == size);
  const auto change = m.update();
  CHECK(change.calls.executed == 0);
  CHECK(change.vertices_added.empty());
  CHECK(change.simplices_removed.empty());
  CHECK(m.mesh() == before);
  m.check_invariants();
  return std::string(code_name(error.code())) + ": " + error.message();
}

Mesher<2> with(const Options<2>& options, const std::vector<Point<2>>& points) {
  Mesher<2> m(options);
  std::int64_t id = 1;
  for (const auto& p : points) m.insert(FeatureId{id++}, p);
  m.update();
  return m;
}

}  // namespace

TEST_CASE("an edit that is refused names ids and values and changes nothing") {
  Mesher<2> m = with(kUnit, {{0.25, 0.5}, {0.5, 0.25}});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto insert = [&](Point<2> p) { return refused(m, [&] { m.insert(FeatureId{7}, p); }); };
  const auto move = [&](Point<2> p) {  // whether a place is free when all have moved, update() says
    return refused(m, [&] {
      m.move(FeatureId{2}, p);
      m.update();
    });
  };

  CHECK(insert({0.25, 0.5}) == "duplicate_point: point 7 (0.25, 0.5) lies on point 1");
  CHECK(move({0.25, 0.5}) == "duplicate_point: point 2 (0.25, 0.5) lies on point 1");
  CHECK(
      insert({0.25, 0.5 + 0x1p-52})
          .starts_with(
              "too_close: point 7 (0.25, 0.5000000000000002) is too close to point 1 (0.25, 0.5)"));
  CHECK(move({0.25 + 0x1p-54, 0.5}).starts_with("too_close: point 2 "));
  CHECK(insert({1.5, 0.5}) ==
        "outside_domain: point 7 (1.5, 0.5) lies outside the domain [0, 1] x [0, 1]");
  CHECK(move({0.5, -1}) ==
        "outside_domain: point 2 (0.5, -1) lies outside the domain [0, 1] x [0, 1]");
  CHECK(insert({nan, 0}).starts_with("not_finite: point 7 (nan, 0)"));
  CHECK(insert({0, -infinity}).starts_with("not_finite: point 7 (0, -inf)"));
  CHECK(insert({1e-40, 0.5}).starts_with("magnitude: point 7 (1e-40, 0.5)"));
  CHECK(refused(m, [&] {
          m.insert(FeatureId{1}, {0.75, 0.75});
        }) == "repeated_id: point 1 is there already");
  CHECK(refused(m, [&] { m.remove(FeatureId{9}); }) == "unknown_id: point 9 is not there");
  CHECK(refused(m, [&] {
          m.move(FeatureId{9}, {0.5, 0.5});
        }) == "unknown_id: point 9 is not there");
}

TEST_CASE("of many points to insert, all are or none is") {
  Mesher<2> m = with(kUnit, {{0.25, 0.5}});
  const std::vector<FeatureId> ids{FeatureId{2}, FeatureId{3}, FeatureId{4}};
  CHECK(error_of([&] {
          m.insert(ids, {{0.1, 0.1}, {0.9, 0.9}, {0.25, 0.5}});
        }).code() == ErrorCode::duplicate_point);
  CHECK(error_of([&] {
          m.insert(ids, {{0.1, 0.1}, {0.9, 0.9}, {2, 2}});
        }).code() == ErrorCode::outside_domain);
  CHECK(error_of([&] {
          m.insert({FeatureId{2}, FeatureId{2}}, {{0.1, 0.1}, {0.9, 0.9}});
        }).code() == ErrorCode::repeated_id);
  CHECK(m.size() == 1);
  CHECK_FALSE(m.contains(FeatureId{2}));
  m.update();
  CHECK(m.mesh() == mesher::mesh_statically<2>({{0.25, 0.5}}, kUnit));
  m.check_invariants();
}

TEST_CASE("options that make no sense are refused") {
  const auto code = [](Options<2> options) {
    return error_of([&] { Mesher<2> m(options); }).code();
  };
  CHECK(code({.domain = {{0, 0}, {0, 0}}}) == ErrorCode::bad_option);
  CHECK(code({.domain = {{1, 0}, {0, 1}}}) == ErrorCode::bad_option);
  CHECK(code({.domain = {{0, 0}, {1, 1}}, .rho = 1}) == ErrorCode::bad_option);
  CHECK(code({.domain = {{0, 0}, {1, std::nan("")}}}) == ErrorCode::bad_option);
  CHECK(code({.domain = {{0x1p60, 0}, {0x1p60 + 512, 1}}}) == ErrorCode::bad_option);
  CHECK(code({.domain = {{0, 0}, {0x1p101, 1}}}) == ErrorCode::bad_option);
}

TEST_CASE("edits taken back leave the mesh, and edits after them work") {
  Mesher<2> m = with(kUnit, {{0.25, 0.5}, {0.5, 0.25}});
  const Mesh<2> before = m.mesh();
  m.insert(FeatureId{3}, {0.75, 0.75});
  m.remove(FeatureId{1});
  m.move(FeatureId{2}, {0.1, 0.1});
  m.discard_edits();
  CHECK(m.size() == 2);
  CHECK(m.mesh() == before);
  m.insert(FeatureId{3}, {0.75, 0.75});
  m.update();
  CHECK(m.mesh() == mesher::mesh_statically<2>({{0.25, 0.5}, {0.5, 0.25}, {0.75, 0.75}}, kUnit));
  m.remove(FeatureId{3});
  m.update();
  CHECK(m.mesh() == before);
  m.check_invariants();
}

TEST_CASE("an update that fails leaves mesh and points as before its edits") {
  Mesher<2> m = with(kFarAway, {kA, {kFar + 0.25, kFar}, {kFar + 0.75, kFar + 0.25}});
  const Mesh<2> before = m.mesh();
  const auto fails = [&](auto edits) {
    edits();
    CHECK(error_of([&] { m.update(); }).code() == ErrorCode::too_close);
    CHECK(m.size() == 3);
    CHECK(m.mesh() == before);
    m.check_invariants();
    CHECK(m.update().calls.executed == 0);
    CHECK(m.mesh() == before);
    m.check_invariants();
  };
  SECTION("an insertion") {
    fails([&] { m.insert(FeatureId{4}, kBesideA); });
  }
  SECTION("a removal and an insertion: what the removal discarded comes back") {
    fails([&] {
      m.remove(FeatureId{2});
      m.insert(FeatureId{4}, kBesideA);
    });
  }
  SECTION("a move") {
    fails([&] { m.move(FeatureId{2}, kBesideA); });
  }
  SECTION("a removed point inserted again, and a good insertion") {
    fails([&] {
      m.remove(FeatureId{3});
      m.insert(FeatureId{5}, {kFar + 0.75, kFar + 0.25});
      m.insert(FeatureId{4}, kBesideA);
      m.insert(FeatureId{6}, {kFar + 1, kFar + 1});
      m.remove(FeatureId{2});
    });
  }
  // It goes on from there.
  m.insert(FeatureId{4}, {kFar + 0.5, kFar + 0.875});
  m.remove(FeatureId{2});
  m.update();
  CHECK(m.mesh() == mesher::mesh_statically<2>(
                        {kA, {kFar + 0.75, kFar + 0.25}, {kFar + 0.5, kFar + 0.875}}, kFarAway));
  m.check_invariants();
}

TEST_CASE("where doubles do not suffice the features around are named, points and lines") {
  const auto ids = [](const Error& error) {
    CHECK(error.code() == ErrorCode::too_close);
    return std::set<FeatureId>(error.ids().begin(), error.ids().end());
  };
  Mesher<2> m = with(kFarAway, {kA, {kFar + 0.25, kFar}, {kFar + 0.75, kFar + 0.25}});
  m.insert(FeatureId{4}, kBesideA);
  CHECK(ids(error_of([&] { m.update(); })) == std::set{FeatureId{1}, FeatureId{4}});
  CHECK(ids(error_of([&] {
          (void)mesher::mesh_statically<2>({{kFar, kFar}, kBesideA, kA}, kFarAway,
                                           {FeatureId{7}, FeatureId{8}, FeatureId{9}});
        })) == std::set{FeatureId{8}, FeatureId{9}});
  Options<2> options = kFarAway;
  options.rho = 1.05;
  for (int step = 0; step < 5; ++step) {
    const Point<2> beside{kA[0] + step * kStep, kA[1] + (1 + step) * kStep};
    const Error error = error_of([&] {
      (void)mesher::mesh_statically({{kFar, kFar + 0.5}, {kFar + 1, kFar + 0.5}, beside},
                                    {{FeatureId{5}, FeatureId{1}, FeatureId{2}}}, options);
    });
    CHECK(ids(error) == std::set{FeatureId{3}, FeatureId{5}});
    CHECK(error.message().find("segment 5") != std::string::npos);
    CHECK(error.message().find("point 3") != std::string::npos);
  }
}

TEST_CASE("a first update that fails leaves a mesher without points") {
  Mesher<2> m(kFarAway);
  m.insert(FeatureId{1}, kA);
  m.insert(FeatureId{2}, kBesideA);
  CHECK(error_of([&] { m.update(); }).code() == ErrorCode::too_close);
  CHECK(m.size() == 0);
  m.insert(FeatureId{1}, kA);
  m.update();
  CHECK(m.mesh() == mesher::mesh_statically<2>({kA}, kFarAway));
}

TEST_CASE("refinement ends with an error where doubles are too sparse for it, for every rho") {
  for (const double rho : {1.05, 1.06, 1.1, 1.2, 1.4142, 2.0}) {
    for (const auto rule : {mesher::Rule::radius_edge, mesher::Rule::voronoi_aspect}) {
      for (int step = 1; step < 6; ++step) {
        Options<2> options = kFarAway;
        options.rho = rho;
        options.rule = rule;
        try {
          const Point<2> b{kA[0] + step * kStep, kA[1] + (step - 3) * kStep};
          const Mesh<2> mesh = mesher::mesh_statically<2>({kA, b}, options);
          CHECK(mesher::quality(mesh).max_radius_edge <= rho * (1 + 1e-9));
        } catch (const Error& error) {
          CHECK(error.code() == ErrorCode::too_close);
        }
      }
    }
  }
}

TEST_CASE("zero has no sign in a mesh") {
  const Options<2> options{.domain = {{-1, -1}, {1, 1}}};
  const Mesh<2> expected = mesher::mesh_statically<2>({{0.0, 0.0}, {0.5, 0.0}}, options);
  Mesher<2> m = with(options, {{-0.0, -0.0}, {0.5, -0.0}});
  m.move(FeatureId{1}, {0.0, -0.0});
  m.update();
  const Mesh<2> mesh = m.mesh();
  CHECK(mesh == expected);
  for (const auto& p : mesh.vertices) {
    for (const double x : p) CHECK((x != 0 || !std::signbit(x)));
  }
}
