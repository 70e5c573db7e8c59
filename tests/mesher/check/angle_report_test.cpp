// Reports of small angles: of wedges, fans and bundles, and nothing of inputs without any.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "any_id.hpp"
#include "check/shrunk_vertices.hpp"
#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "geometry/segment_tests.hpp"
#include "mesher/check.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/reports.hpp"

namespace {

using mesher::AngleReport;
using mesher::Graph;
using mesher::LineId;
using mesher::Mesh;
using mesher::Point;
using mesher::PointId;
using mesher::PslgKind;
using mesher::detail::MeshLines;

AnyId id(std::int64_t i) { return AnyId{i}; }

mesher::Options<2> options_of(const Graph<2>& g) {
  std::vector<Point<2>> points;
  for (const auto& p : g.points) points.push_back(p.at);
  return {.domain = mesher::snapped_domain<2>(points)};
}

Mesh<2> mesh_of(const Graph<2>& graph) {
  const Graph<2> g = without_polylines(graph);
  std::vector<Point<2>> points;
  std::vector<PointId> ids;
  std::vector<mesher::Segment> segments;
  for (const auto& p : g.points) points.push_back(p.at), ids.push_back(p.id);
  for (const auto& s : g.segments) segments.push_back({s.id, s.from, s.to});
  return mesher::mesh_statically(points, segments, options_of(g), ids);
}

AngleReport report_of(const Graph<2>& g) { return mesher::angle_report(mesh_of(g), options_of(g)); }

Graph<2> generated(PslgKind kind, std::size_t n, std::uint64_t seed) {
  return mesher::generate_pslg({.kind = kind, .n = n, .seed = seed});
}

Graph<2> wedge(double degrees, double ratio) {
  const double turn = 0.3, angle = turn + degrees * 3.14159265358979323846 / 180;
  Graph<2> g;
  g.points = {{id(1), {0, 0}, 0},
              {id(2), {std::cos(turn), std::sin(turn)}, 0},
              {id(3), {ratio * std::cos(angle), ratio * std::sin(angle)}, 0}};
  g.segments = {{id(7), id(1), id(2), 0}, {id(4), id(1), id(3), 0}};
  return g;
}

std::size_t poor_triangles(const Mesh<2>& mesh, double rho) {
  return static_cast<std::size_t>(
      std::count_if(mesh.simplices.begin(), mesh.simplices.end(), [&](const auto& t) {
        return mesher::radius_edge(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]) >
               rho * (1 + 1e-9);
      }));
}

// Local feature sizes and nearest neighbours from their definitions.
class Naive {
 public:
  Naive(const Mesh<2>& mesh, const MeshLines& lines) : mesh_(mesh), lines_(lines) {
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
      const auto kind = mesh.kinds[v];
      const bool point = kind == mesher::VertexKind::input || kind == mesher::VertexKind::boundary;
      if (point) features_.push_back({v, v});
    }
    for (const auto& s : lines.segments()) features_.push_back({s.a, s.b});
  }
  [[nodiscard]] double nearest(std::uint32_t v) const {
    double best = 1e300;
    for (const auto& t : mesh_.simplices) {
      if (std::find(t.begin(), t.end(), v) == t.end()) continue;
      for (const std::uint32_t w : t) {
        if (w == v || !lines_.wedges_across(v, w, true).empty()) continue;
        best = std::min(best, lines_.distance(v, w));
      }
    }
    return best;
  }
  [[nodiscard]] double feature_size(std::uint32_t v) const {
    double best = 1e300;
    for (const auto& f : features_) {
      for (const auto& g : features_) {
        const bool joint = f[0] == g[0] || f[0] == g[1] || f[1] == g[0] || f[1] == g[1];
        if (!joint) best = std::min(best, std::max(distance(v, f), distance(v, g)));
      }
    }
    return best;
  }

 private:
  [[nodiscard]] double distance(std::uint32_t v, const std::array<std::uint32_t, 2>& f) const {
    if (lines_.through(v) != MeshLines::kNone) {
      const auto& own = lines_.segments()[lines_.through(v)];
      if (own.a == f[0] && own.b == f[1]) return 0;
    }
    const auto& at = mesh_.vertices;
    return std::sqrt(mesher::detail::distance2(at[v], at[f[0]], at[f[1]]));
  }

  const Mesh<2>& mesh_;
  const MeshLines& lines_;
  std::vector<std::array<std::uint32_t, 2>> features_;
};

}  // namespace

TEST_CASE("A wedge is reported with its angle, and what it forces") {
  for (const double degrees : {1.0, 0.1, 0.01, 0.001}) {
    for (const double ratio : {1.0, 0.7}) {
      INFO(degrees << " degrees, legs 1 : " << ratio);
      const Graph<2> g = wedge(degrees, ratio);
      const Mesh<2> mesh = mesh_of(g);
      const AngleReport report = mesher::angle_report(mesh, options_of(g));
      REQUIRE(report.angles.size() == 1);
      const auto& angle = report.angles[0];
      CHECK(angle.at == Point<2>{0, 0});
      CHECK(angle.lines == std::array{LineId{4}, LineId{7}});
      CHECK(angle.degrees == Approx(degrees).epsilon(1e-9));
      CHECK(angle.forced == report.forced);
      CHECK(report.forced == poor_triangles(mesh, 1.4142));
      CHECK(report.forced > 0);
      CHECK(angle.smallest_deg == report.smallest_forced_deg);
      CHECK(report.smallest_forced_deg >= 0.999 * degrees);
      CHECK(report.smallest_forced_deg <= 1.1 * degrees);
      CHECK(report.smallest_elsewhere_deg >= report.promised_deg - 1e-6);
      CHECK(report.promised_deg == Approx(20.7051).epsilon(1e-4));
      CHECK(report.shrunk.empty());
    }
  }
}

TEST_CASE("The report's text says which lines, how many triangles, and what is promised") {
  CHECK(report_of(wedge(1, 1)).text() ==
        "1 angles under 60 degrees, the smallest 1 at (0, 0), of lines 4 and 7.\n"
        "7 triangles stay for them, with angles from 1 degrees; all angles of others are at least "
        "20.71.\n");
  CHECK(report_of(wedge(61, 1)).text().empty());
}

TEST_CASE("Of inputs without small angles there is nothing to report") {
  for (const auto kind : {PslgKind::segments, PslgKind::lengths, PslgKind::polylines}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      INFO("kind " << static_cast<int>(kind) << " seed " << seed);
      const AngleReport report = report_of(generated(kind, 300, seed));
      CHECK(report.angles.empty());
      CHECK(report.forced == 0);
      CHECK(report.shrunk.empty());
      CHECK(report.text().empty());
      CHECK(report.smallest_elsewhere_deg >= report.promised_deg - 1e-6);
    }
  }
}

TEST_CASE("Lengths that limits of size ask for have not shrunk") {
  mesher::Options<2> options{.domain = {{0, 0}, {16, 16}}};
  const std::vector<mesher::Point<2>> points{{2, 2}, {13, 3}, {9, 14}};
  for (const double area : {0.0, 0.5, 0.01}) {
    options.max_measure = area;
    const auto mesh = mesher::mesh_statically<2>(points, options);
    CHECK(mesher::angle_report(mesh, options).shrunk.empty());
  }
}

TEST_CASE("A fan has as many small angles as legs, and they force equally much") {
  Graph<2> g = generated(PslgKind::fan, 30, 1);
  const AngleReport report = report_of(g);
  REQUIRE(report.angles.size() == 30);
  for (const auto& angle : report.angles) {
    CHECK(angle.degrees == Approx(12));
    CHECK(angle.forced == report.angles[0].forced);
  }
  CHECK(report.forced == 30 * report.angles[0].forced);
  CHECK(report.forced > 0);
}

TEST_CASE("All poor triangles are those that small angles force") {
  for (const auto kind : {PslgKind::trees, PslgKind::zigzag, PslgKind::bundle}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      INFO("kind " << static_cast<int>(kind) << " seed " << seed);
      const Graph<2> g = generated(kind, kind == PslgKind::bundle ? 12 : 80, seed);
      const Mesh<2> mesh = mesh_of(g);
      const AngleReport report = mesher::angle_report(mesh, options_of(g));
      CHECK(report.forced == poor_triangles(mesh, 1.4142));
      std::size_t sum = 0;
      for (const auto& angle : report.angles) sum += angle.forced;
      CHECK(sum >= report.forced);
      CHECK(report.smallest_elsewhere_deg >= report.promised_deg - 1e-6);
    }
  }
}

TEST_CASE("The guard finds the vertices at which lengths shrink, by the definition") {
  std::size_t found = 0;
  for (const auto kind : {PslgKind::trees, PslgKind::segments, PslgKind::fan, PslgKind::bundle}) {
    const Graph<2> g = generated(kind, kind == PslgKind::bundle ? 5 : 12, 3);
    const Mesh<2> mesh = mesh_of(g);
    const MeshLines lines(mesh);
    const Naive naive(mesh, lines);
    for (const double allowed : {1.3, 2.0, 4.0}) {
      std::vector<std::pair<Point<2>, double>> expected;
      for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
        const double nearest = naive.nearest(v);
        if (mesh.kinds[v] == mesher::VertexKind::boundary || nearest == 1e300) continue;
        const double size = naive.feature_size(v);
        if (size * size > allowed * nearest * (allowed * nearest)) {
          expected.emplace_back(mesh.vertices[v], size);
        }
      }
      const auto shrunk = mesher::detail::shrunk_vertices(mesh, lines, allowed);
      INFO("kind " << static_cast<int>(kind) << " allowed " << allowed);
      REQUIRE(shrunk.size() == expected.size());
      for (std::size_t i = 0; i < shrunk.size(); ++i) {
        CHECK(shrunk[i].at == expected[i].first);
        CHECK(shrunk[i].feature_size == Approx(expected[i].second));
      }
      found += shrunk.size();
    }
  }
  CHECK(found > 100);
}

TEST_CASE("The guard names the small angles that make lengths shrink") {
  const AngleReport report = report_of(generated(PslgKind::trees, 1000, 1));
  REQUIRE(!report.shrunk.empty());
  for (const auto& v : report.shrunk) {
    CHECK(v.degrees < 60);
    CHECK(!v.lines.empty());
    CHECK(v.feature_size > mesher::kShrinks * v.nearest);
  }
  CHECK(report.text().find("Lengths have shrunk") != std::string::npos);
}

TEST_CASE("A mesh that has followed edits has the report of a fresh one") {
  const Graph<2> g = wedge(5, 0.7);
  mesher::BoxMesher<2> m(options_of(g));
  for (const auto& p : g.points) m.insert(p.id, p.at);
  for (const auto& s : g.segments) m.insert_segment(s.id, s.from, s.to);
  m.insert(id(9), {0.4, 0.2});
  m.update();
  m.remove(id(9));
  m.update();
  const AngleReport followed = mesher::angle_report(m.mesh(), m.options());
  CHECK(followed.text() == report_of(g).text());
  CHECK(followed.forced > 0);
  CHECK(mesher::angle_report({}, m.options()).text().empty());
}
