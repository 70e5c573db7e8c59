// Complexes meshed from scratch: the mesh contains them, is of quality off small angles, and is as
// small as the model's.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <string>

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
  CHECK(report.wrong_faces == 0);
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

struct Family {
  const char* name;
  double parameter;
  std::size_t model;  // vertices inside, without facet Disencroach
};
constexpr Family kFamilies[] = {
    {"cube", 0, 8},        {"cubepoly", 0, 42},   {"dumbbell", 0, 59}, {"nested", 0.1, 524},
    {"lhole", 0, 70},      {"cloudbox", 300, 809}, {"wedge", 20, 62},   {"wedge", 5, 168},
    {"wedge", 1, 431},     {"fan", 2, 1225},      {"vee", 5, 87},
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
      {"skew", 1e-3, 0},  {"skew", 1e-6, 0}, {"plates", 0.02, 0}, {"spike", 5, 0},
      {"segfac", 5, 0},   {"segfac", 0.5, 0}, {"tet", 0.1, 0},     {"tet", 0.01, 0},
      {"fan", 8, 0},      {"wedge", 0.3, 0},  {"vee", 0.1, 0},
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

TEST_CASE("meshes of complexes have at most 1.1 times the model's vertices [rules C]") {
  for (const Family& family : kFamilies) {
    const Complex complex = support::complex_of(family.name, family.parameter);
    const Options<3> options = options_for(complex);
    PlcRun run(complex, options);
    INFO(family.name << ' ' << family.parameter);
    CHECK(10 * count_inside(run, options) <= 11 * family.model);
  }
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
