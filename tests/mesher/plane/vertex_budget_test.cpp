// Meshes that may have so many vertices and no more.
#include <catch2/catch.hpp>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "any_id.hpp"
#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "feature_ids.hpp"

namespace {

using mesher::ErrorCode;
using mesher::LineId;
using mesher::Point;

AnyId id(int i) { return AnyId{i}; }

// What `run` throws, of too many vertices.
template <class Run>
mesher::Error refusal_of(Run&& run) {
  try {
    run();
  } catch (const mesher::Error& error) {
    REQUIRE(error.code() == ErrorCode::too_many);
    return error;
  }
  FAIL("not refused");
  throw std::logic_error("not reached");
}

// The ids that it names.
template <class Run>
std::vector<LineId> named_by(Run&& run) {
  return support::ids_of(refusal_of(std::forward<Run>(run)));
}

// What is said of `segments`, of which points 1 and 2, and 3 and 4 are the ends.
std::string said_of(const std::vector<mesher::Segment>& segments, std::size_t most) {
  const std::vector<Point<2>> points{{0.1, 0.5}, {0.9, 0.5}, {0.1, 0.50001}, {0.9, 0.50002}};
  const mesher::Options<2> options{.domain = {{0, 0}, {1, 1}}, .max_vertices = most};
  return refusal_of([&] { (void)mesher::mesh_statically(points, segments, options); }).message();
}

}  // namespace

TEST_CASE(
    "A bundle that needs more vertices than there may be is refused by name, and the mesh stays") {
  const mesher::Options<2> options{.domain = {{0, 0}, {1, 1}}, .max_vertices = 3000};
  mesher::BoxMesher<2> m(options);
  m.insert({id(1), id(2), id(3), id(4)}, {{0.1, 0.5}, {0.9, 0.5}, {0.1, 0.50001}, {0.9, 0.50002}});
  m.insert_segment(id(10), id(1), id(2));
  m.update();
  const auto before = m.mesh();
  m.insert_segment(id(11), id(3), id(4));
  const auto named = named_by([&] { m.update(); });
  CHECK(std::set(named.begin(), named.end()) == std::set{LineId{10}, LineId{11}});
  CHECK(m.mesh() == before);
  m.check_invariants();
  m.insert(id(5), {0.3, 0.3});
  m.update();
  CHECK(m.mesh().vertices.size() > before.vertices.size());
  m.check_invariants();
}

TEST_CASE("Too many vertices are said to be on two lines at most, with how many are on each") {
  const mesher::Segment first{id(10), id(1), id(2)}, second{id(11), id(3), id(4)};
  const std::regex both(
      "more than 3000 vertices are needed; so far ([0-9]+) are on segment 1[01] and ([0-9]+) on "
      "segment 1[01]");
  std::smatch counts;
  const std::string said = said_of({first, second}, 3000);
  REQUIRE(std::regex_match(said, counts, both));
  CHECK(std::stoi(counts[1]) >= std::stoi(counts[2]));
  CHECK(said_of({}, 5) == "more than 5 vertices are needed");
}

TEST_CASE("A mesh may have just as many vertices as it needs, and not one less") {
  const std::vector<Point<2>> points{{0.1, 0.5}, {0.9, 0.52}, {0.4, 0.5}, {0.7, 0.2}};
  const std::vector<mesher::Segment> segments{{id(1), id(1), id(2)}, {id(2), id(3), id(4)}};
  mesher::Options<2> options{.domain = {{0, 0}, {1, 1}}};
  const auto mesh = mesher::mesh_statically(points, segments, options);
  const auto dynamic = [&] {
    mesher::BoxMesher<2> m(options);
    for (int i = 0; i < 4; ++i) m.insert(id(i + 1), points[static_cast<std::size_t>(i)]);
    m.insert_segment(id(1), id(1), id(2));
    m.update();
    m.insert_segment(id(2), id(3), id(4));
    m.update();
    return m.mesh();
  };
  options.max_vertices = mesh.vertices.size();
  CHECK(mesher::mesh_statically(points, segments, options) == mesh);
  CHECK(dynamic() == mesh);
  --options.max_vertices;
  named_by([&] { (void)mesher::mesh_statically(points, segments, options); });
  named_by([&] { (void)dynamic(); });
}
