// Complexes meshed from scratch: the mesh contains them, is of quality off small angles, and is as
// small as the model's.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <iterator>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "plc_run.hpp"
#include "random_complex.hpp"

namespace {

using mesher::Options;
using mesher::Point;
using support::Complex;
using support::ComplexReport;
using support::PlcRun;

constexpr double kRho = 2;

// The box of the points: not rounded, so that the model's box is used.
Options<3> options_for(const Complex& complex) {
  Options<3> options;
  auto& [lo, hi] = options.domain;
  lo = hi = complex.points[0];
  for (const Point<3>& p : complex.points) {
    for (std::size_t i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], p[i]);
      hi[i] = std::max(hi[i], p[i]);
    }
  }
  options.max_vertices = 30000;
  return options;
}

void require_good(PlcRun& run) {
  const ComplexReport report = check(run.mesh(), kRho);
  CHECK(report.missing_edges == 0);
  CHECK(report.wrong_edges == 0);
  CHECK(report.area_error < 1e-12);
  CHECK(report.poor == 0);
}

// As the model counts: in the domain, or on a feature.
std::size_t count_inside(PlcRun& run, const Options<3>& options) {
  std::size_t inside = 0;
  run.world().vertices.pool().for_each([&](const mesher::detail::Vertex<3>& v) {
    bool in = !v.boundary;
    for (std::size_t i = 0; i < 3; ++i) {
      in = in && v.p[i] >= options.domain.lo[i] && v.p[i] <= options.domain.hi[i];
    }
    inside += in || v.input || v.on_segment ? 1 : 0;
  });
  return inside;
}

std::set<Point<3>> vertices_of(const Complex& complex, const Options<3>& options) {
  PlcRun run(complex, options);
  std::set<Point<3>> places;
  run.world().vertices.pool().for_each([&](const auto& v) { places.insert(v.p); });
  return places;
}
std::size_t count_different(const std::set<Point<3>>& a, const std::set<Point<3>>& b) {
  std::vector<Point<3>> different;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(),
                                std::back_inserter(different));
  return different.size();
}

struct Family {
  const char* name;
  double parameter;
  std::size_t model;  // vertices inside
};
constexpr Family kFamilies[] = {
    {"cube", 0, 8},    {"cubepoly", 0, 64},    {"dumbbell", 0, 59},    {"nested", 0.1, 652},
    {"lhole", 0, 73},  {"cloudbox", 300, 809}, {"plates", 0.02, 1057}, {"wedge", 20, 62},
    {"wedge", 5, 168}, {"wedge", 1, 431},      {"fan", 2, 1225},       {"vee", 5, 87},
    {"spike", 8, 81},  {"skew", 1e-3, 142},
};

}  // namespace

TEST_CASE("a complex is in its mesh: edges are unions of edges, polygons of faces [rules C3]") {
  for (const Family& family : kFamilies) {
    for (const bool is_turned : {false, true}) {
      INFO(family.name << ' ' << family.parameter << (is_turned ? ", turned" : ""));
      Complex complex = support::complex_of(family.name, family.parameter);
      if (is_turned) complex = turned(std::move(complex));
      PlcRun run(complex, options_for(complex));
      require_good(run);
    }
  }
}

TEST_CASE("so it is where features nearly touch, and at needles and slivers") {
  constexpr Family kHard[] = {
      {"skew", 1e-3, 0}, {"skew", 1e-6, 0},  {"plates", 0.02, 0}, {"spike", 5, 0},
      {"segfac", 5, 0},  {"segfac", 0.5, 0}, {"tet", 0.1, 0},     {"tet", 0.01, 0},
      {"fan", 8, 0},     {"wedge", 0.3, 0},  {"vee", 0.1, 0},
  };
  for (const auto& [name, parameter, model] : kHard) {
    for (const bool is_turned : {false, true}) {
      INFO(name << ' ' << parameter << (is_turned ? ", turned" : ""));
      Complex complex = support::complex_of(name, parameter);
      if (is_turned) complex = turned(std::move(complex));
      PlcRun run(complex, options_for(complex));
      require_good(run);
    }
  }
}

TEST_CASE("meshes of complexes have at most 1.25 times the model's vertices [rules C]") {
  for (const Family& family : kFamilies) {
    const Complex complex = support::complex_of(family.name, family.parameter);
    const Options<3> options = options_for(complex);
    PlcRun run(complex, options);
    INFO(family.name << ' ' << family.parameter);
    CHECK(4 * count_inside(run, options) <= 5 * family.model);
  }
}

// One fan in ten has up to three times as many as those of nearly its angle: which, is chance. The
// model's has 167 at 8 degrees.
TEST_CASE("fans have hardly more vertices than the model's in the median, and few have many more") {
  std::vector<std::size_t> counts;
  for (double angle = 5; angle <= 11; angle += 0.5) {
    const Complex complex = support::complex_of("fan", angle);
    const Options<3> options = options_for(complex);
    PlcRun run(complex, options);
    counts.push_back(count_inside(run, options));
  }
  std::sort(counts.begin(), counts.end());
  CHECK(counts[counts.size() / 2] <= 225);
  CHECK(counts.back() <= 5 * 167);
}

// Of two triangles with a common side, of tetrahedra, and of triangles with a segment at a corner
// every third has no mesh by the model's rules: copies have to share their distances.
TEST_CASE("refinement ends at random corners, however sharp") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    support::RandomComplex random(seed);
    for (int kind = 0; kind < support::RandomComplex::kKinds; ++kind) {
      for (int n = 0; n < 8; ++n) {
        INFO("seed " << seed << ", kind " << kind << ", " << n);
        const Complex complex = random.part({0, 0, 0}, kind);
        Options<3> options;
        options.domain = {{0, 0, 0}, {1, 1, 1}};
        options.max_vertices = 20000;
        PlcRun run(complex, options);
        require_good(run);
      }
    }
  }
}

// The first has a tip of 30, 41 and 48 degrees, the second two sides at 62 degrees: between the
// angles up to which vertices were copied and from which feet yield.
TEST_CASE("refinement ends at tips where copies are copied, and at angles just over 60 degrees") {
  const Complex::Places tips[] = {{{2.1648359523632417, 1.5668346226702006, 0.67273961329500964},
                                   {2.6708397317089099, 1.7303640950373023, 0.77892219860039802},
                                   {2.539814177952433, 1.5831604129854147, 0.59574617232301719},
                                   {2.4411910936309642, 1.1833897922236605, 0.59509786344242266}},
                                  {{0.34805775646409221, 2.212627211989969, 0.29553729050436905},
                                   {0.70853288543013437, 2.4009961749153463, 0.21366495897902374},
                                   {0.88732577227381582, 2.3989269025010742, 0.4116002045667827},
                                   {0.17355010244570118, 2.7731127523670951, 0.59326784253385989}}};
  for (const auto& p : tips) {
    Complex complex;
    for (std::size_t i = 0; i < 4; ++i) {
      complex.face({p[i], p[(i + 1) % 4], p[(i + 2) % 4]});
    }
    Options<3> options;
    options.domain = {{0, 0, 0}, {3, 3, 3}};
    options.max_vertices = 20000;
    PlcRun run(complex, options);
    require_good(run);
  }
}

// A page's edges are near each other at its corner, and a copy there is on one of them or on none:
// by how far it was turned, whatever the length of the edges, and whichever came first.
TEST_CASE(
    "a point at a corner of pages is meshed, however near, and whoever else has their edges") {
  for (const double away : {1e-7, 1e-9, 2e-10, 1e-11}) {
    INFO(away);
    Complex complex;
    const Point<3> corner{0, 0, 0}, hinge{0, 1, 0};
    const auto outer = [](double angle) { return Point<3>{std::cos(angle), 0.2, std::sin(angle)}; };
    for (const double angle : {0.3, 0.65}) complex.face({corner, hinge, outer(angle)});
    complex.point({away * std::cos(0.4), away, away * std::sin(0.4)});
    Options<3> options;
    options.domain = {{-1, -1, -1}, {1, 1, 1}};
    options.max_vertices = 20000;
    PlcRun run(complex, options);
    require_good(run);
    Complex other = complex;
    std::reverse(other.faces.begin(), other.faces.end());
    for (const double angle : {0.3, 0.65}) other.segment(corner, outer(angle));
    CHECK(vertices_of(other, options) == vertices_of(complex, options));
  }
}

// Before anything is refined there are vertices wherever others are nearer: one more point changes
// those around it. Without them half of all vertices change, and more.
TEST_CASE("between sides that are near each other a point changes few vertices [Fig 6.4]") {
  for (const double gap : {0.09, 0.075, 0.06}) {
    Complex complex = support::complex_of("nested", gap);
    const Options<3> options = options_for(complex);
    const auto before = vertices_of(complex, options);
    std::vector<std::size_t> changed;
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> within(0.3, 0.7);
    for (int n = 0; n < 9; ++n) {
      complex.points.push_back({within(random), within(random), within(random)});
      changed.push_back(count_different(before, vertices_of(complex, options)));
      complex.points.pop_back();
    }
    std::sort(changed.begin(), changed.end());
    INFO("gap " << gap << ", of " << before.size() << " vertices " << changed[4]);
    CHECK(changed[4] < 60);
  }
}

TEST_CASE("the mesh of a complex depends on no order of points, segments, polygons, corners") {
  for (const Family& family : {Family{"lhole", 0, 0}, {"wedge", 5, 0}, {"vee", 5, 0}}) {
    INFO(family.name);
    Complex complex = turned(support::complex_of(family.name, family.parameter));
    const Options<3> options = options_for(complex);
    const auto result = PlcRun(complex, options).result();
    std::mt19937_64 random(7);
    std::vector<std::size_t> to(complex.points.size());
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = i;
    std::shuffle(to.begin(), to.end(), random);
    Complex other = complex;
    for (std::size_t i = 0; i < to.size(); ++i) other.points[to[i]] = complex.points[i];
    for (auto& s : other.segments) s = {to[s[1]], to[s[0]]};
    for (auto& f : other.faces) {
      for (auto& loop : f.loops) {
        for (std::size_t& i : loop) i = to[i];
        std::reverse(loop.begin(), loop.end());
      }
    }
    std::shuffle(other.faces.begin(), other.faces.end(), random);
    std::reverse(other.segments.begin(), other.segments.end());
    CHECK(PlcRun(other, options).result() == result);
  }
}
