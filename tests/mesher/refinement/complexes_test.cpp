// Meshes of complexes by each refinement: the complex is in the mesh, exactly, and what is wanted
// is of quality off small angles.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <random>
#include <stop_token>
#include <string>
#include <vector>

#include "facade/graph_runs.hpp"
#include "failing_new.hpp"
#include "mesher/check.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/meshing.hpp"
#include "mesher/write.hpp"
#include "random_complex.hpp"
#include "refined_complex.hpp"

namespace {

using mesher::Extent;
using mesher::Graph;
using mesher::Mesh;
using mesher::Options;
using mesher::PlcKind;
using mesher::Point;
using mesher::PointId;
using support::By;
using support::fault;
using support::id;
using support::mesh_of;
using support::options_for;
using support::plc_of;

// With other ids, and all in another order.
Graph<3> shuffled(const Graph<3>& plc) {
  std::mt19937_64 random(7);
  Graph<3> other = plc;
  const auto renamed = [](PointId& id) { id = PointId{1000 - 3 * static_cast<std::int64_t>(id)}; };
  std::shuffle(other.points.begin(), other.points.end(), random);
  std::shuffle(other.polygons.begin(), other.polygons.end(), random);
  std::shuffle(other.segments.begin(), other.segments.end(), random);
  for (auto& p : other.points) renamed(p.id);
  for (auto& s : other.segments) {
    std::swap(s.from, s.to);
    renamed(s.from), renamed(s.to);
  }
  for (auto& f : other.polygons) {
    for (auto& loop : f.loops) {
      std::rotate(loop.begin(), loop.begin() + 1, loop.end());
      for (auto& corner : loop) renamed(corner);
    }
    for (auto& edge : f.edges) renamed(edge[0]), renamed(edge[1]);
    for (auto& point : f.points) renamed(point);
  }
  return other;
}

// About the axes, by any angles.
void turn(Graph<3>& plc, std::mt19937_64& random) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double angle = std::uniform_real_distribution<double>(0, 6)(random);
    const auto turn_one = [&](Point<3>& p) {
      const double x = p[k], y = p[(k + 1) % 3];
      p[k] = std::cos(angle) * x - std::sin(angle) * y;
      p[(k + 1) % 3] = std::sin(angle) * x + std::cos(angle) * y;
    };
    for (auto& point : plc.points) turn_one(point.at);
    for (auto& seed : plc.seeds) turn_one(seed.at);
  }
}

// Up to eight parts beside each other, some of them as small as 2^-20, or far from the origin. At
// some corners, with few bits left for what is sharp, refinement does not end; it is said.
struct Scattered {
  support::Complex all;
  double offset = 0;

  explicit Scattered(std::uint64_t seed) {
    support::RandomComplex random(seed);
    const int parts = 1 + static_cast<int>(random.below(8));
    if (random.below(2) == 0) offset = 1000;
    const double scale = std::ldexp(1.0, -static_cast<int>(random.below(offset == 0 ? 20 : 4)));
    for (int cube = 0; cube < parts; ++cube) {
      const Point<3> corner{double(cube % 2), double(cube / 2 % 2), double(cube / 4)};
      const support::Complex part = random.part(corner);
      const double unit = random.below(3) == 0 ? scale : 1;
      add(part, [&](Point<3> p) {
        for (std::size_t i = 0; i < 3; ++i) p[i] = offset + corner[i] + unit * (p[i] - corner[i]);
        return p;
      });
    }
  }
  // A cube around them, this far away.
  void add_walls(double margin) {
    const double lo = offset - margin, hi = offset + 2 + margin;
    all.box({{lo, lo, lo}, {hi, hi, hi}});
  }
  [[nodiscard]] mesher::Box<3> domain() const {
    return {{offset, offset, offset}, {offset + 2, offset + 2, offset + 2}};
  }
  // Far away edges of 10^-9 at a corner are, by rounding, on it for one and not for another.
  [[nodiscard]] std::optional<double> rho() const {
    return offset == 0 ? std::optional(2.0) : std::nullopt;
  }

 private:
  template <class Move>
  void add(const support::Complex& part, Move&& move) {
    const std::size_t first = all.points.size();
    for (const Point<3>& p : part.points) all.points.push_back(move(p));
    for (auto s : part.segments) all.segments.push_back({s[0] + first, s[1] + first});
    for (auto face : part.faces) {
      for (auto& loop : face.loops) {
        for (std::size_t& i : loop) i += first;
      }
      all.faces.push_back(face);
    }
  }
};

std::size_t poor_ones(const Mesh<3>& mesh) { return mesher::count_above(mesh, 2); }

}  // namespace

TEMPLATE_TEST_CASE_SIG("complexes of all families are in their meshes, and these of quality", "",
                       ((By B), B), By::svr, By::refine) {
  for (const std::string& name : mesher::plc_kind_names()) {
    const auto kind = mesher::plc_kind(name);
    for (const Extent extent : {Extent::enclosed, Extent::box}) {
      if (*kind == PlcKind::bricks && extent == Extent::box) continue;  // large
      INFO(name << (extent == Extent::box ? " in the box" : ""));
      const Graph<3> plc = mesher::generate_plc({*kind});
      CHECK(fault(mesh_of<B>(plc, options_for(plc), extent), plc, extent) == "");
    }
  }
}

TEMPLATE_TEST_CASE_SIG("so it is of complexes in no frame of the axes, near each other and sharp",
                       "", ((By B), B), By::svr, By::refine) {
  constexpr std::pair<const char*, double> kFamilies[] = {
      {"cube", 0},     {"cubepoly", 0}, {"skew", 1e-3},  {"skew", 1e-6},    {"dumbbell", 0},
      {"nested", 0.1}, {"lhole", 0},    {"plates", .02}, {"cloudbox", 300}, {"wedge", 20},
      {"wedge", 5},    {"wedge", 1},    {"fan", 8},      {"spike", 5},      {"vee", 5},
      {"vee", 0.5},    {"segfac", 5},   {"tet", 0.1},
  };
  for (const auto& [name, parameter] : kFamilies) {
    INFO(name << ' ' << parameter);
    const Graph<3> plc = plc_of(turned(support::complex_of(name, parameter)));
    CHECK(fault(mesh_of<B>(plc, options_for(plc)), plc, Extent::box) == "");
  }
}

TEMPLATE_TEST_CASE_SIG("so it is at random corners, however sharp", "", ((By B), B), By::svr,
                       By::refine) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    support::RandomComplex random(seed);
    for (int kind = 0; kind < support::RandomComplex::kKinds; ++kind) {
      for (int n = 0; n < 8; ++n) {
        INFO("seed " << seed << ", kind " << kind << ", " << n);
        const Graph<3> plc = plc_of(random.part({0, 0, 0}, kind));
        const Options<3> options{.domain = {{0, 0, 0}, {1, 1, 1}}, .max_vertices = 20000};
        CHECK(fault(mesh_of<B>(plc, options), plc, Extent::box) == "");
      }
    }
  }
}

TEMPLATE_TEST_CASE_SIG("so it is of many random complexes", "[soak]", ((By B), B), By::svr,
                       By::refine) {
  int refused = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    INFO("seed " << seed);
    const Scattered parts(seed);
    const Graph<3> plc = plc_of(parts.all);
    const Options<3> options{.domain = parts.domain(), .max_vertices = 60000};
    try {
      const std::string said = fault(mesh_of<B>(plc, options), plc, Extent::box, parts.rho());
      CHECK(said == "");
    } catch (const mesher::Error& e) {
      CHECK((e.code() == mesher::ErrorCode::too_close || e.code() == mesher::ErrorCode::too_many));
      ++refused;
    }
  }
  CHECK(refused < 100);
}

namespace {

// As many as refuse, of complexes in walls, near them or far, of which the inside is wanted alone.
template <By B>
int refused_in_walls(std::uint64_t first_seed, std::uint64_t last_seed) {
  int refused = 0;
  for (std::uint64_t seed = first_seed; seed <= last_seed; ++seed) {
    INFO("seed " << seed);
    Scattered parts(seed);
    parts.add_walls(std::ldexp(1.0, -static_cast<int>(seed % 8)));
    const Graph<3> plc = plc_of(parts.all);
    Options<3> options = options_for(plc);
    options.max_vertices = 60000;
    try {
      const Mesh<3> mesh = mesh_of<B>(plc, options, Extent::enclosed);
      CHECK(fault(mesh, plc, Extent::enclosed, parts.rho()) == "");
    } catch (const mesher::Error& e) {
      CHECK((e.code() == mesher::ErrorCode::too_close || e.code() == mesher::ErrorCode::too_many));
      ++refused;
    }
  }
  return refused;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("what walls enclose is of quality too in a box of few vertices", "",
                       ((By B), B), By::svr, By::refine) {
  CHECK(refused_in_walls<B>(1, 40) < 4);
}

TEMPLATE_TEST_CASE_SIG("so it is in many walls", "[soak]", ((By B), B), By::svr, By::refine) {
  CHECK(refused_in_walls<B>(41, 1500) < 75);
}

TEMPLATE_TEST_CASE_SIG("a mesh of a complex depends on no order, and on no ids", "", ((By B), B),
                       By::svr, By::refine) {
  for (const char* name : {"lhole", "wedge", "vee", "fan"}) {
    INFO(name);
    const Graph<3> plc = plc_of(turned(support::complex_of(name, name[0] == 'l' ? 0 : 5)));
    const Mesh<3> mesh = mesh_of<B>(plc, options_for(plc), Extent::enclosed);
    CHECK(mesh_of<B>(shuffled(plc), options_for(plc), Extent::enclosed) == mesh);
  }
}

// The corner that they share is on both loops: which is in the other, no test of it can tell.
TEMPLATE_TEST_CASE_SIG("a hole may touch its polygon's border at a corner", "", ((By B), B),
                       By::svr, By::refine) {
  support::Complex plate;
  plate.points = {{1, 1, 2}, {3, 1, 2}, {3, 3, 2}, {1, 3, 2}, {1.8, 1.4, 2}, {1.6, 1.9, 2}};
  plate.faces.push_back({{{0, 1, 2, 3}, {0, 4, 5}}, {}});
  for (const Graph<3>& plc : {plc_of(plate), plc_of(turned(plate))}) {
    const Mesh<3> mesh = mesh_of<B>(plc, options_for(plc));
    CHECK(fault(mesh, plc, Extent::box) == "");
  }
}

TEMPLATE_TEST_CASE_SIG("what is not wanted is not refined: the outside, and holes", "", ((By B), B),
                       By::svr, By::refine) {
  Graph<3> plc = mesher::generate_plc({PlcKind::nested, 0.02});
  for (const double x : {0.3, 0.301}) {  // two points inside are near each other
    plc.points.push_back({mesher::PointId{static_cast<std::uint32_t>(1000 * x)}, {x, 0.3, 0.3}});
  }
  const Options<3> options = options_for(plc);
  const Mesh<3> all = mesh_of<B>(plc, options),
                enclosed = mesh_of<B>(plc, options, Extent::enclosed);
  CHECK(poor_ones(all) == 0);
  CHECK(poor_ones(enclosed) > 0);
  CHECK(enclosed.vertices.size() < all.vertices.size());
  const Point<3> middle{0.5, 0.5, 0.5};
  plc.seeds.push_back(mesher::hole_seed<3>(0, middle));
  const Mesh<3> shell = mesh_of<B>(plc, options, Extent::enclosed);
  CHECK(shell.vertices.size() < enclosed.vertices.size());
  CHECK(fault(shell, plc, Extent::enclosed) == "");
  for (const Point<3>& p : {Point<3>{0.5, 0.5, 0.02}, Point<3>{0.5, 0.02, 0.02},
                            Point<3>{0.02, 0.02, 0.02}, Point<3>{50, 50, 50}}) {
    plc.seeds.back().at = p;  // on a polygon, on its edge, on its corner, in no region
    CHECK(mesh_of<B>(plc, options, Extent::enclosed) == enclosed);
  }
  // Nothing is enclosed: then all is wanted.
  plc = mesher::generate_plc({PlcKind::vee});
  plc.polygons.clear();
  CHECK(mesh_of<B>(plc, options_for(plc), Extent::enclosed) == mesh_of<B>(plc, options_for(plc)));
}

// As near to a polygon as doubles come, rounding says on which side of it a hole is.
TEMPLATE_TEST_CASE_SIG("wherever a hole on a turned polygon counts to, what is kept is refined", "",
                       ((By B), B), By::svr, By::refine) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 12; ++i) {
    Graph<3> plc = mesher::generate_plc({PlcKind::nested, 0.4});
    const auto add = [&](const Point<3>& p) {
      plc.points.push_back({id(plc.points.size()), p, 0});
    };
    for (int k = 1; k < 6; ++k) {  // close to each other, inside and outside of the inner box
      add({0.41 + 0.001 * k * k, 0.5, 0.5});
      add({0.1 + 0.002 * k * k, 0.1, 0.1});
    }
    plc.seeds.push_back(mesher::hole_seed<3>(0, {0.5, 0.5, 0.4}));
    turn(plc, random);
    INFO("turn " << i);
    CHECK(fault(mesh_of<B>(plc, options_for(plc), Extent::enclosed), plc, Extent::enclosed) == "");
  }
}

TEMPLATE_TEST_CASE_SIG("what cannot be meshed is refused", "", ((By B), B), By::svr, By::refine) {
  const Graph<3> plc = mesher::generate_plc({PlcKind::cube_square});
  const auto refusal = [&](const Graph<3>& bad, auto&& change) {
    Options<3> options = options_for(plc);
    change(options);
    try {
      static_cast<void>(mesh_of<B>(bad, options));
    } catch (const mesher::Error& e) {
      return std::string(mesher::code_name(e.code()));
    }
    return std::string();
  };
  const auto same = [](const auto&) {};
  CHECK(refusal(plc, [](auto& o) { o.rho = 1.9; }) == "bad_option");
  CHECK(refusal(plc, [](auto& o) { o.max_measure = -1; }) == "bad_option");
  CHECK(refusal(plc, [](auto& o) { o.rule = mesher::Rule::voronoi_aspect; }) == "bad_option");
  CHECK(refusal(plc, [](auto& o) { o.max_vertices = 110; }) == "too_many");
  Options<3> few = options_for(plc);
  few.max_measure = 1e-4;
  few.max_vertices = 500;
  try {
    static_cast<void>(mesh_of<B>(plc, few));
    FAIL("a mesh of more vertices than allowed");
  } catch (const mesher::Error& e) {
    INFO(e.what());
    CHECK(e.code() == mesher::ErrorCode::too_many);
    CHECK(e.features().size() == 2);
    CHECK(e.places().size() == 1);
  }
  Graph<3> bad = plc;
  bad.points[0].at[0] += 0.1;
  CHECK(refusal(bad, same) == "not_flat");
  bad = plc;
  bad.polygons[0].loops[0][0] = PointId{99};
  CHECK(refusal(bad, same) == "unknown_id");
  std::stop_source stop;
  stop.request_stop();
  CHECK_THROWS_AS(
      mesh_of<B>(plc, options_for(plc), Extent::box, {.progress = {}, .stop = stop.get_token()}),
      mesher::Error);
}

TEMPLATE_TEST_CASE_SIG("without memory a mesh of a complex fails, and nothing is lost", "",
                       ((By B), B), By::svr, By::refine) {
  const Graph<3> plc = mesher::generate_plc({PlcKind::dumbbell});
  const Options<3> options = options_for(plc);
  const Mesh<3> mesh = mesh_of<B>(plc, options);
  bool burnt = true;
  int failures = 0;
  for (std::uint64_t count = 1; burnt; count += 1 + count / 4) {
    Mesh<3> other;
    const bool failed = support::fails(count, burnt, [&] { other = mesh_of<B>(plc, options); });
    failures += failed ? 1 : 0;
    if (!failed) CHECK(other == mesh);
  }
  CHECK(failures > 10);
}

TEST_CASE("what happened in a run on a complex is told") {
  const Graph<3> plc = mesher::generate_plc({PlcKind::cloud, 200});
  mesher::SvrStats svr;
  const Mesh<3> mesh = mesher::svr(plc, options_for(plc), Extent::box, {}, &svr);
  CHECK(svr.vertices == mesh.vertices.size());
  CHECK(svr.simplices == mesh.simplices.size());
  CHECK(svr.warped + svr.crowded > 100);
  CHECK(svr.worst_radius_edge > 2);
  mesher::RefineStats refined;
  const Mesh<3> other = mesher::refine(plc, options_for(plc), Extent::box, {}, &refined);
  CHECK(refined.simplices == other.simplices.size());
  CHECK(refined.made > other.simplices.size());
}
