// Below rho = 2: refinement of complexes ends, and what stays poor is beside isolated features, by
// a judge that has the input alone.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <optional>
#include <string>
#include <vector>

#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "graph/plc_builder.hpp"
#include "mesher/check.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/meshing.hpp"
#include "mesher/reports.hpp"
#include "random_complex.hpp"

namespace {

using mesher::Graph;
using mesher::GraphFile;
using mesher::LineId;
using mesher::Mesh;
using mesher::Options;
using mesher::PlcKind;
using mesher::Point;
using mesher::PointId;
using mesher::PolygonId;

Options<3> options_for(const Graph<3>& plc, double rho, std::size_t most) {
  return {.domain = mesher::snapped_domain<3>(places_of(plc)), .rho = rho, .max_vertices = most};
}

// What is wrong with a mesh, to which its complex is all that is known; nothing if nothing is.
std::string fault(const Mesh<3>& mesh, const Graph<3>& plc, double rho) {
  GraphFile<3> complex;
  complex.graph = plc;
  mesher::CheckOptions<3> options;
  options.graph = &complex;
  options.rho = rho;
  for (const auto& finding : check_mesh(mesh, options)) {
    if (!finding.holds) return finding.property + ": " + finding.detail;
  }
  return "";
}

std::string name(PlcKind kind) { return mesher::plc_kind_names()[static_cast<std::size_t>(kind)]; }

std::vector<std::array<Point<3>, 4>> all_simplices(const Mesh<3>& mesh) {
  std::vector<std::array<Point<3>, 4>> all;
  for (const auto& [a, b, c, d] : mesh.simplices) {
    const auto& v = mesh.vertices;
    all.push_back({v[a], v[b], v[c], v[d]});
  }
  return all;
}

// Parts of complexes in the eight cubes of a grid, which come and go.
class Grid {
 public:
  Grid(std::uint64_t seed, double rho)
      : random_(seed), m_({.domain = {{0, 0, 0}, {2, 2, 2}}, .rho = rho, .max_vertices = 100000}) {}

  void edit() {
    const std::size_t i = random_.below(parts_.size());
    if (!parts_[i]) return put(i);
    for (const auto& f : parts_[i]->polygons) m_.remove_polygon(f.id);
    for (const auto& s : parts_[i]->segments) m_.remove_line(s.id);
    for (const auto& p : parts_[i]->points) m_.remove(p.id);
    parts_[i].reset();
  }
  mesher::BoxMesher<3>& mesher() { return m_; }
  [[nodiscard]] Graph<3> all() const {
    Graph<3> all;
    for (const auto& part : parts_) {
      if (!part) continue;
      all.points.insert(all.points.end(), part->points.begin(), part->points.end());
      all.segments.insert(all.segments.end(), part->segments.begin(), part->segments.end());
      all.polygons.insert(all.polygons.end(), part->polygons.begin(), part->polygons.end());
    }
    return all;
  }

 private:
  void put(std::size_t i) {
    const auto at = [&](std::size_t bit) { return static_cast<double>(i >> bit & 1); };
    const auto complex =
        random_.part({at(0), at(1), at(2)}, 5 + static_cast<int>(random_.below(3)));
    Graph<3>& part = parts_[i].emplace();
    for (const auto& p : complex.points) part.points.push_back({PointId{++last_}, p});
    const auto id = [&](std::size_t k) { return part.points[k].id; };
    for (const auto& s : complex.segments) {
      part.segments.push_back({LineId{++last_}, id(s[0]), id(s[1])});
    }
    for (const auto& f : complex.faces) {
      mesher::Polygon polygon;
      polygon.id = PolygonId{++last_};
      for (const auto& loop : f.loops) {
        auto& corners = polygon.loops.emplace_back();
        for (const std::size_t k : loop) corners.push_back(id(k));
      }
      part.polygons.push_back(polygon);
    }
    announce(part, m_);
  }

  support::RandomComplex random_;
  mesher::BoxMesher<3> m_;
  std::array<std::optional<Graph<3>>, 8> parts_;
  std::int64_t last_ = 0;
};

Graph<3> plc_of(const support::Complex& complex) {
  mesher::detail::PlcBuilder b;
  for (const Point<3>& p : complex.points) b.point(p);
  for (const auto& s : complex.segments) b.segment(complex.points[s[0]], complex.points[s[1]]);
  for (const auto& f : complex.faces) {
    std::vector<std::vector<Point<3>>> loops;
    for (const auto& loop : f.loops) {
      auto& corners = loops.emplace_back();
      for (const std::size_t i : loop) corners.push_back(complex.points[i]);
    }
    b.polygon(loops);
  }
  return b.finish();
}

}  // namespace

TEST_CASE(
    "below rho = 2 refinement of families ends, and what stays poor is beside isolated features") {
  struct Family {
    PlcKind kind;
    double rho;
    std::size_t most;  // vertices
  };
  std::size_t gave_in = 0;
  for (const auto& [kind, rho, most] : {Family{PlcKind::dumbbell, 1.42, 2100},
                                        {PlcKind::vee, 1.42, 1600},
                                        {PlcKind::tee, 1.42, 2000},
                                        {PlcKind::pages, 1.42, 3000},
                                        {PlcKind::cloud, 1.42, 6500},
                                        {PlcKind::vee, 1.2, 8000},
                                        {PlcKind::cube_square, 1.2, 10000},
                                        {PlcKind::tetrahedron, 1.7, 1000},
                                        {PlcKind::leaning, 1.7, 900},
                                        {PlcKind::nested, 1.7, 1500}}) {
    INFO(name(kind) << ", rho " << rho);
    const Graph<3> plc = mesher::generate_plc({kind});
    const Mesh<3> mesh = mesh_statically(plc, options_for(plc, rho, most));
    REQUIRE(fault(mesh, plc, rho) == "");
    const mesher::GuardReport report = mesher::guard_report(mesh, plc, rho);
    CHECK(report.tetrahedra <= mesher::count_above(mesh, rho));
    gave_in += report.tetrahedra > 0 ? 1 : 0;
    CHECK(report.places.empty() == (report.tetrahedra == 0));
  }
  CHECK(gave_in > 2);
}

TEST_CASE("below rho = 2 refinement ends at random corners") {
  for (const std::uint64_t seed : {1, 2}) {
    support::RandomComplex random(seed);
    for (int kind = 2; kind < support::RandomComplex::kKinds; ++kind) {
      for (const double rho : {1.7, 1.42, 1.3}) {
        INFO("seed " << seed << ", kind " << kind << ", rho " << rho);
        const Graph<3> plc = plc_of(random.part({0, 0, 0}, kind));
        const Mesh<3> mesh = mesh_statically(plc, options_for(plc, rho, 30000));
        CHECK(fault(mesh, plc, rho) == "");
      }
    }
  }
}

TEST_CASE("nothing is poor beside features that are not isolated, or where rho is not guarded") {
  const Graph<3> plc = mesher::generate_plc({PlcKind::nested});
  const Mesh<3> mesh = mesh_statically(plc, options_for(plc, 2, 10000));
  CHECK(fault(mesh, plc, 2) == "");
  CHECK(fault(mesh, plc, 1.42) != "");
  CHECK(mesher::guard_report(mesh, plc, 2).places.empty());
  CHECK(mesher::guard_report(mesh, plc, 1.42).places.empty());
}

TEST_CASE("a feature alone is refined to the size of its parts, however far others are") {
  mesher::detail::PlcBuilder b;
  b.polygon({{{0, 0, 0}, {1, 0, 0}, {1, 0.02, 0}, {0, 0.02, 0}}});
  const Graph<3> plc = b.finish();
  const Mesh<3> mesh = mesh_statically(plc, options_for(plc, 1.7, 10000));
  CHECK(fault(mesh, plc, 1.7) == "");
  CHECK(mesher::guard_report(mesh, plc, 1.7).tetrahedra == 0);
  CHECK(mesher::count_above(mesh, 1.7) == 0);
}

TEST_CASE("the guard says beside which feature it gave in, and where") {
  const Graph<3> plc = mesher::generate_plc({PlcKind::pages});
  const Mesh<3> mesh = mesh_statically(plc, options_for(plc, 1.3, 20000));
  const mesher::GuardReport report = mesher::guard_report(mesh, plc, 1.3);
  REQUIRE(!report.places.empty());
  std::size_t all = 0;
  for (const mesher::PoorBeside& place : report.places) {
    const auto is = [&](const auto& f) { return place.feature == mesher::Feature(f.id); };
    CHECK((std::any_of(plc.polygons.begin(), plc.polygons.end(), is) ||
           std::any_of(plc.segments.begin(), plc.segments.end(), is)));
    CHECK(place.max_radius_edge > 1.42);
    all += place.tetrahedra;
  }
  CHECK(all == report.tetrahedra);
  CHECK(report.text().find(" tetrahedra stay poor beside it, ") != std::string::npos);
}

TEST_CASE("edits below rho = 2 leave a fresh run's mesh, and say where the guard gave in") {
  const double rho = 1.3;
  Graph<3> plc = mesher::generate_plc({PlcKind::vee});
  const Options<3> options = options_for(plc, rho, 30000);
  mesher::BoxMesher<3> m(options);
  announce(plc, m);
  const auto first = m.update();
  CHECK(first.guard == mesher::guard_report(m.mesh(), plc, rho));
  CHECK(first.guard.tetrahedra > 0);
  std::size_t news = 0;
  mesher::SplitMix64 random(5);
  const auto number = [&](double lo, double hi) { return lo + (hi - lo) * random.unit(); };
  for (int update = 0; update < 12; ++update) {
    INFO("update " << update);
    if (update % 3 == 2) {
      m.remove(plc.points.back().id);
      plc.points.pop_back();
    } else {
      Point<3> p;
      for (std::size_t i = 0; i < 3; ++i) {
        p[i] = number(options.domain.lo[i], options.domain.hi[i]);
      }
      plc.points.push_back({PointId{100 + update}, p});
      m.insert(plc.points.back().id, p);
    }
    const auto change = m.update();
    const Mesh<3> mesh = m.mesh();
    REQUIRE(mesh == mesh_statically(plc, options));
    REQUIRE(fault(mesh, plc, rho) == "");
    CHECK(change.guard == guard_news(mesh, plc, rho, change.simplices_added));
    news += change.guard.tetrahedra;
  }
  CHECK(news > 0);
  m.check_invariants();
}

// Calls visit(change, news) for edits of grids, with what the whole mesh says of what is new.
template <class Visit>
void follow(Visit&& visit) {
  for (const double rho : {1.3, 1.42}) {
    for (const std::uint64_t seed : {1, 2}) {
      Grid grid(seed, rho);
      for (int update = 0; update < 6; ++update) {
        INFO("rho " << rho << ", seed " << seed << ", update " << update);
        for (int n = 0; n < (update == 0 ? 3 : 1); ++n) grid.edit();
        const auto change = grid.mesher().update();
        const auto mesh = grid.mesher().mesh();
        visit(change.guard, guard_news(mesh, grid.all(), rho, change.simplices_added));
        CHECK(guard_report(mesh, grid.all(), rho) ==
              guard_news(mesh, grid.all(), rho, all_simplices(mesh)));
      }
    }
  }
}

// What is at a small angle is told by labels in an update, by places in a mesh, which excuses more.
TEST_CASE("after edits of polygons a change says it, too, but for what angles excuse") {
  std::size_t all = 0, excused = 0;
  follow([&](const mesher::GuardReport& said, const mesher::GuardReport& news) {
    for (const mesher::PoorBeside& place : news.places) {
      CHECK(std::any_of(said.places.begin(), said.places.end(), [&](const mesher::PoorBeside& p) {
        return p.feature == place.feature && p.tetrahedra >= place.tetrahedra;
      }));
    }
    all += news.tetrahedra;
    excused += said.tetrahedra - news.tetrahedra;
  });
  CHECK(all > 0);
  CHECK(excused < all);
}
