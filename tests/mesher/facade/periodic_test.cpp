// Sides that fit together: twins of vertices and of edges, on random cells; what is refused.
#include "mesher/periodic.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "mesher/check.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/sizes.hpp"
#include "mesher/write.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::Error;
using mesher::ErrorCode;
using mesher::Graph;
using mesher::LineId;
using mesher::Point;
using mesher::PointId;

constexpr std::int64_t kLeft = 4, kRight = 2, kBottom = 1, kTop = 3;

// A cell whose sides may bend: those at the right and above are the others, moved.
class Cell {
 public:
  explicit Cell(std::uint64_t seed) : random_(seed) {
    const bool bends = seed % 2 == 1;
    right_ = {1, bends ? .1 * random_.unit() : 0};
    up_ = {bends ? .2 * random_.unit() : 0, 1};
    const double scale = seed % 3 == 0 ? 1 : .1 + 3 * random_.unit();
    for (Point<2>* by : {&right_, &up_}) *by = {(*by)[0] * scale, (*by)[1] * scale};
    scale_ = scale;
    origin_ = {seed % 3 == 0 ? 0 : random_.unit(), seed % 3 == 0 ? 0 : random_.unit() - .5};
    const PointId a = point(origin_), b = point(moved(origin_, right_));
    const PointId c = point(moved(moved(origin_, right_), up_)), d = point(moved(origin_, up_));
    side(a, b, d, c, up_, right_, kBottom, kTop, bends);
    side(a, d, b, c, right_, up_, kLeft, kRight, bends);
    inside(seed % 5);
  }

  Graph<2> graph;

 private:
  static Point<2> moved(const Point<2>& p, const Point<2>& by) {
    return {p[0] + by[0], p[1] + by[1]};
  }
  PointId point(const Point<2>& at) {
    graph.points.push_back({PointId{static_cast<std::int64_t>(graph.points.size())}, at});
    return graph.points.back().id;
  }
  LineId line() { return LineId{next_line_++}; }

  // From a to b, and the same from c to d, which is as far from it as `by`.
  void side(PointId a, PointId b, PointId c, PointId d, const Point<2>& by, const Point<2>& along,
            std::int64_t marker, std::int64_t other, bool bends) {
    std::vector<PointId> from{a}, to{c};
    const std::size_t inner = bends ? 1 + random_.below(3) : random_.below(2);
    for (std::size_t i = 1; i <= inner; ++i) {
      const double part = static_cast<double>(i) / static_cast<double>(inner + 1);
      Point<2> p{origin_[0] + part * along[0], origin_[1] + part * along[1]};
      if (bends) {
        const double out = .1 * scale_ * (random_.unit() - .5);
        p[along[0] > along[1] ? 1 : 0] += out;
      } else if (along[1] > along[0]) {
        p[0] = origin_[0];  // upright, bit for bit
      } else {
        p[1] = origin_[1];
      }
      from.push_back(point(p));
      Point<2> q = moved(p, by);
      // The far sides of a straight cell are straight, too.
      if (!bends) q[along[1] > along[0] ? 0 : 1] = graph.points[2].at[along[1] > along[0] ? 0 : 1];
      to.push_back(point(q));
    }
    from.push_back(b);
    to.push_back(d);
    if (random_.below(2) == 0) std::reverse(to.begin(), to.end());
    if (from.size() == 2 || random_.below(2) == 0) {
      for (std::size_t i = 1; i < from.size(); ++i) {
        graph.segments.push_back({line(), from[i - 1], from[i], marker});
      }
    } else {
      graph.polylines.push_back({line(), from, marker});
    }
    graph.polylines.push_back({line(), to, other});
  }

  [[nodiscard]] Point<2> within(double u, double v) const {
    return {origin_[0] + u * right_[0] + v * up_[0], origin_[1] + u * right_[1] + v * up_[1]};
  }

  void inside(std::size_t how) {
    const auto between = [&] { return .15 + .7 * random_.unit(); };
    for (std::size_t i = 0; i < 5 * how; ++i) point(within(between(), between()));
    // Near one side, and not near its twin.
    if (how > 1) point(within(.02 + .05 * random_.unit() + (how % 2 == 0 ? .1 : 0), between()));
    if (how == 3) {
      const PointId a = point(within(.4, .4)), b = point(within(.41, .6)),
                    c = point(within(.6, .5));
      graph.polylines.push_back({line(), {a, b, c, a}, 9});
      graph.seeds = {mesher::hole_seed<2>(1, within(.47, .5))};
    }
    if (how == 4) {
      graph.segments.push_back({line(), point(within(.11, .2)), point(within(.125, .8)), 7});
      graph.seeds = {mesher::region_seed<2>(1, within(.5, .5), 3)};
    }
  }

  mesher::SplitMix64 random_;
  Point<2> right_{}, up_{}, origin_{};
  double scale_ = 1;
  std::int64_t next_line_ = 0;
};

using Ends = std::array<std::uint32_t, 2>;

std::set<Ends> edges_of(const mesher::MeshData<2>& mesh, std::int64_t marker) {
  std::set<Ends> edges;
  for (const auto& e : mesh.features.edges) {
    if (e.marker == marker) edges.insert({e.low, e.high});
  }
  return edges;
}

// Guarantees (1) and (2) of periodic.hpp.
void require_twins(const mesher::MeshData<2>& mesh, const Graph<2>& graph,
                   const mesher::PeriodicSides& sides) {
  std::map<std::uint32_t, std::uint32_t> twins;
  std::set<std::uint32_t> taken;
  for (const auto& [a, b] : sides.vertices) {
    REQUIRE(twins.emplace(a, b).second);
    REQUIRE(taken.insert(b).second);
  }
  REQUIRE(std::is_sorted(sides.vertices.begin(), sides.vertices.end()));
  const auto from = edges_of(mesh, sides.from), to = edges_of(mesh, sides.to);
  std::set<Ends> images;
  std::set<std::uint32_t> on_from;
  for (const auto& [a, b] : from) {
    on_from.insert({a, b});
    REQUIRE(twins.contains(a));
    REQUIRE(twins.contains(b));
    const auto [low, high] = std::minmax(twins[a], twins[b]);
    images.insert({low, high});
  }
  REQUIRE(on_from.size() == twins.size());
  REQUIRE(images == to);
  double largest = 0;
  for (const auto& p : graph.points) {
    largest = std::max({largest, std::abs(p.at[0]), std::abs(p.at[1])});
  }
  for (const auto& [a, b] : sides.vertices) {
    const Point<2>&p = mesh.vertices[a], &q = mesh.vertices[b];
    const bool is_input = mesh.kinds[a] == mesher::VertexKind::input;
    REQUIRE(is_input == (mesh.kinds[b] == mesher::VertexKind::input));
    for (std::size_t i = 0; i < 2; ++i) {
      REQUIRE(std::abs(p[i] + sides.translation[i] - q[i]) <= 0x1p-48 * largest);
      if (sides.translation[i] == 0) REQUIRE(p[i] == q[i]);
    }
  }
}

void require_checked(const mesher::MeshData<2>& mesh, const Graph<2>& graph, double rho) {
  mesher::GraphFile<2> file;
  file.graph = graph;
  file.points.resize(graph.points.size());
  file.segments.resize(graph.segments.size());
  file.polylines.resize(graph.polylines.size());
  file.seeds.resize(graph.seeds.size());
  mesher::CheckOptions<2> options;
  options.graph = &file;
  options.rho = rho * (1 + 1e-9);
  options.boundary = mesher::BoundaryRule::lines;
  for (const auto& finding : mesher::check_mesh(mesh, options)) {
    INFO(finding.property << ": " << finding.detail);
    REQUIRE(finding.holds);
  }
}

const std::vector<mesher::PeriodicMarkers> kBoth{{.from = kLeft, .to = kRight},
                                                 {.from = kBottom, .to = kTop}};

TEST_CASE("sides of random cells have twins of all vertices and edges, by every algorithm") {
  std::size_t more = 0;  // rounds after the first
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    INFO("seed " << seed);
    const Cell cell(seed);
    for (const auto algorithm :
         {mesher::Algorithm::automatic, mesher::Algorithm::svr, mesher::Algorithm::gap_balls}) {
      if (algorithm == mesher::Algorithm::gap_balls && seed % 4 != 0) continue;
      mesher::Options<2> options{.algorithm = algorithm};
      if (seed % 7 == 2) options.max_measure = .01;
      if (seed % 7 == 4 && algorithm == mesher::Algorithm::automatic) options.min_angle = 27;
      if (seed % 7 == 5) {
        options.sizes =
            mesher::sampled_sizes<2>({{{-1, 0}, .04}, {{5, 0}, 1}, {{-1, 5}, .04}, {{5, 5}, 2}});
      }
      const auto made = mesher::periodic_mesh(cell.graph, kBoth, options);
      more += made.rounds - 1;
      REQUIRE(made.mesh.features.periodic.size() == 2);
      for (std::size_t i = 0; i < 2; ++i) {
        const auto& sides = made.mesh.features.periodic[i];
        REQUIRE((sides.from == kBoth[i].from && sides.to == kBoth[i].to));
        REQUIRE(sides.vertices.size() >= 2);
        require_twins(made.mesh, cell.graph, sides);
      }
      require_checked(made.mesh, cell.graph, mesher::radius_edge_bound(options));
      // Again, and with everything in another order.
      Graph<2> turned = cell.graph;
      std::reverse(turned.points.begin(), turned.points.end());
      std::reverse(turned.segments.begin(), turned.segments.end());
      std::reverse(turned.polylines.begin(), turned.polylines.end());
      const auto again = mesher::periodic_mesh(turned, kBoth, options);
      const mesher::Mesh<2>&first = made.mesh, &second = again.mesh;
      REQUIRE(first == second);
      REQUIRE(made.mesh.features == again.mesh.features);
    }
  }
  CHECK(more > 100);
}

TEST_CASE("the mesh is that of the graph with the points that sides have got") {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    INFO("seed " << seed);
    const Cell cell(seed);
    const auto box = mesher::periodic_box_mesh(cell.graph, kBoth);
    mesher::Options<2> options;
    options.domain = mesher::snapped_domain<2>(mesher::places_of(cell.graph));
    CHECK(box.mesh == mesher::box_mesh(box.graph, options));
    CHECK(box.graph.points.size() == cell.graph.points.size() + box.points.size());
    std::map<LineId, std::size_t> inner;
    for (const auto& [point, line] : box.points) ++inner[line];
    std::size_t on_lines = 0;
    for (const auto& l : box.graph.polylines) on_lines += l.points.size();
    std::size_t before = 0;
    for (const auto& l : cell.graph.polylines) before += l.points.size();
    const std::size_t lost = cell.graph.segments.size() - box.graph.segments.size();
    CHECK(on_lines == before + 2 * lost + box.points.size());
    for (const auto& twins : box.sides) CHECK(twins.points.size() >= 2);
  }
}

Graph<2> square() {
  Graph<2> graph;
  graph.points = {{PointId{1}, {0, 0}},
                  {PointId{2}, {1, 0}},
                  {PointId{3}, {1, 1}},
                  {PointId{4}, {0, 1}},
                  {PointId{5}, {.03, .4}}};
  graph.segments = {{LineId{1}, PointId{1}, PointId{2}, kBottom},
                    {LineId{2}, PointId{2}, PointId{3}, kRight},
                    {LineId{3}, PointId{3}, PointId{4}, kTop},
                    {LineId{4}, PointId{4}, PointId{1}, kLeft}};
  return graph;
}

Error refused(const Graph<2>& graph, const std::vector<mesher::PeriodicMarkers>& pairs) {
  try {
    static_cast<void>(mesher::periodic_mesh(graph, pairs));
  } catch (const Error& error) {
    return error;
  }
  FAIL("it was meshed");
  throw;
}

TEST_CASE("sides that are not the same, or are named twice, are refused") {
  using Pairs = std::vector<mesher::PeriodicMarkers>;
  const auto text = [](const Graph<2>& graph, const Pairs& pairs) {
    const Error error = refused(graph, pairs);
    CHECK(error.code() == ErrorCode::bad_option);
    return error.message();
  };
  CHECK(text(square(), {{4, 77}}) == "periodic sides: no line has the marker 77");
  CHECK(text(square(), {{4, 0}}) == "periodic sides: 0 is no marker");
  CHECK(text(square(), {{4, 4}}) == "periodic sides: the marker 4 is named twice");
  CHECK(text(square(), {{4, 2}, {1, 2}}) == "periodic sides: the marker 2 is named twice");
  CHECK_THAT(text(square(), {{4, 1}}), Catch::Contains("nothing is moved"));
  Graph<2> graph = square();
  graph.points[2].at = {1, 1 + 1e-9};
  CHECK(refused(graph, {{4, 2}}).features() == std::vector<mesher::Feature>{PointId{4}});
  graph = square();  // another point in the side
  graph.points.push_back({PointId{6}, {1, .5}});
  graph.segments[1] = {LineId{2}, PointId{2}, PointId{6}, kRight};
  graph.segments.push_back({LineId{5}, PointId{6}, PointId{3}, kRight});
  CHECK_THAT(text(graph, {{4, 2}}), Catch::Contains("have 3 points, those of marker 4 2"));
  graph = square();  // the same points, joined in another way
  graph.points.push_back({PointId{6}, {0, .5}});
  graph.points.push_back({PointId{7}, {1, .5}});
  graph.segments[3] = {LineId{4}, PointId{4}, PointId{6}, kLeft};
  graph.segments.push_back({LineId{5}, PointId{6}, PointId{1}, kLeft});
  graph.polylines = {{LineId{6}, {PointId{2}, PointId{7}}, kRight}};
  CHECK_THAT(text(graph, {{4, 2}}), Catch::Contains("is no line of marker 2"));
  graph = square();  // a line from a point that is not there
  graph.segments[1].from = PointId{70};
  CHECK(refused(graph, {{4, 2}}).code() == ErrorCode::unknown_id);
  graph = square();  // lines that cross, as without periodic sides
  graph.segments.push_back({LineId{9}, PointId{1}, PointId{3}});
  graph.segments.push_back({LineId{10}, PointId{2}, PointId{4}});
  CHECK(refused(graph, {{4, 2}}).code() == ErrorCode::crossing_segments);
  mesher::Options<2> few;
  few.max_vertices = 10;
  CHECK_THROWS_AS(mesher::periodic_mesh(square(), {{4, 2}}, few), Error);
}

TEST_CASE("without pairs it is mesh(); corners up to rounding are twins") {
  const mesher::MeshData<2> plain = mesher::mesh(square()).mesh;
  const auto none = mesher::periodic_mesh(square(), {});
  CHECK(none.rounds == 1);
  const mesher::Mesh<2>&a = plain, &b = none.mesh;
  CHECK(a == b);
  CHECK(plain.features == none.mesh.features);
  Graph<2> graph = square();
  for (auto& p : graph.points) p.at = {.1 + .7 * p.at[0], .2 + p.at[1]};
  graph.points[1].at[0] = graph.points[2].at[0] = .8;  // .1 + .7 is below
  const auto made = mesher::periodic_mesh(graph, {{.from = kLeft, .to = kRight}});
  require_twins(made.mesh, graph, made.mesh.features.periodic.at(0));
  for (const auto& [p, q] : made.mesh.features.periodic[0].vertices) {
    CHECK(made.mesh.vertices[p][0] == .1);
    CHECK(made.mesh.vertices[q][0] == .8);
    CHECK(made.mesh.vertices[p][1] == made.mesh.vertices[q][1]);
  }
}

// The numbers behind `$Periodic` of a file.
std::vector<double> periodic_section(const std::string& path) {
  std::ifstream file(path);
  std::string word;
  std::vector<double> numbers;
  while (file >> word && word != "$Periodic") {
  }
  while (file >> word && word != "$EndPeriodic") {
    if (word != "Affine") numbers.push_back(std::stod(word));
  }
  return numbers;
}

TEST_CASE(".msh pairs the nodes of sides, in both versions and orders") {
  const support::ScratchFolder folder;
  const auto made = mesher::periodic_mesh(square(), kBoth);
  const auto n = made.mesh.vertices.size();
  for (const int order : {1, 2}) {
    for (const auto version : {mesher::MshVersion::v2_2, mesher::MshVersion::v4_1}) {
      const std::string path = folder.path("cell.msh");
      mesher::write_mesh(made.mesh, path, {.order = order, .msh = version});
      auto numbers = periodic_section(path);
      std::size_t at = 0;
      const auto next = [&] { return numbers.at(at++); };
      CHECK(next() == 2);
      for (std::size_t i = 0; i < 2; ++i) {
        const auto& sides = made.mesh.features.periodic[i];
        CHECK(next() == 1);
        const double slave = next(), master = next();  // curves are by marker, from 1
        CHECK(slave == static_cast<double>(sides.to));
        CHECK(master == static_cast<double>(sides.from));
        if (version == mesher::MshVersion::v4_1) CHECK(next() == 16);
        for (std::size_t k = 0; k < 16; ++k) {
          const bool moves = k % 4 == 3 && k < 12;
          CHECK(next() == (moves ? sides.translation[k / 4] : k % 5 == 0 ? 1 : 0));
        }
        const auto count = static_cast<std::size_t>(next());
        const std::size_t corners = sides.vertices.size();
        CHECK(count == (order == 1 ? corners : 2 * corners - 1));
        for (std::size_t k = 0; k < count; ++k) {
          const auto b = static_cast<std::size_t>(next()), a = static_cast<std::size_t>(next());
          CHECK((a <= n) == (k < corners));
          CHECK((b <= n) == (k < corners));
          if (k < corners) {
            CHECK((a == sides.vertices[k][0] + 1 && b == sides.vertices[k][1] + 1));
          }
        }
      }
      CHECK(at == numbers.size());
    }
  }
  const std::string path = folder.path("plain.msh");
  mesher::write_mesh(mesher::mesh(square()).mesh, path);
  CHECK(periodic_section(path).empty());
}

}  // namespace
