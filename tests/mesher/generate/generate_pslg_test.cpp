// Families of points and lines: no two lines meet but at ends they share, whatever the seed.
#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "mesher/extra/generate.hpp"
#include "mesher/predicates.hpp"

namespace {

using mesher::Graph;
using mesher::Point;
using mesher::PointId;
using mesher::PslgKind;
using mesher::predicates::orient2d;

struct Line {
  PointId from, to;
  Point<2> a, b;
};

std::map<PointId, Point<2>> places_of(const Graph<2>& pslg) {
  std::map<PointId, Point<2>> places;
  for (const auto& p : pslg.points) places[p.id] = p.at;
  return places;
}

std::vector<Line> lines_of(const Graph<2>& pslg) {
  const auto places = places_of(pslg);
  std::vector<Line> lines;
  for (const auto& s : mesher::without_polylines(pslg).segments) {
    lines.push_back({s.from, s.to, places.at(s.from), places.at(s.to)});
  }
  return lines;
}

bool is_on(const Point<2>& p, const Line& s) {
  return orient2d(s.a, s.b, p) == 0 && std::min(s.a, s.b) <= p && p <= std::max(s.a, s.b);
}

// More than a shared end.
bool meet(const Line& s, const Line& t) {
  const auto is_end = [](PointId p, const Line& of) { return p == of.from || p == of.to; };
  for (const auto& [line, other] : {std::pair(s, t), std::pair(t, s)}) {
    if (!is_end(line.from, other) && is_on(line.a, other)) return true;
    if (!is_end(line.to, other) && is_on(line.b, other)) return true;
  }
  if (is_end(s.from, t) && is_end(s.to, t)) return true;
  return orient2d(s.a, s.b, t.a) * orient2d(s.a, s.b, t.b) < 0 &&
         orient2d(t.a, t.b, s.a) * orient2d(t.a, t.b, s.b) < 0;
}

void require_clean(const Graph<2>& pslg) {
  const auto lines = lines_of(pslg);
  const auto places = places_of(pslg);
  REQUIRE(places.size() == pslg.points.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    REQUIRE(lines[i].a != lines[i].b);
    for (std::size_t k = 0; k < i; ++k) REQUIRE_FALSE(meet(lines[i], lines[k]));
    for (const auto& [id, place] : places) {
      REQUIRE((id == lines[i].from || id == lines[i].to || !is_on(place, lines[i])));
    }
  }
}

}  // namespace

TEST_CASE("no family has lines that meet but at ends they share, or points on lines") {
  const std::string name = GENERATE(from_range(mesher::pslg_kind_names()));
  const std::uint64_t seed = GENERATE(1, 2, 3);
  const std::size_t n = GENERATE(0, 1, 2, 30, 200);
  INFO(name << ", n " << n << ", seed " << seed);
  const mesher::PslgFamily family{mesher::pslg_kind(name).value(), n, seed, {}};
  const Graph<2> pslg = mesher::generate_pslg(family);
  require_clean(pslg);
  CHECK(pslg == mesher::generate_pslg(family));
  CHECK(lines_of(pslg).size() >= n * 9 / 10);
  for (const auto& p : pslg.points)
    CHECK((p.at[0] > 0 && p.at[0] < 1 && p.at[1] > 0 && p.at[1] < 1));
}

TEST_CASE("the families have the lines that they are named for") {
  const auto make = [](PslgKind kind, std::size_t n) {
    return mesher::generate_pslg({kind, n, 5, {}});
  };
  CHECK(make(PslgKind::segments, 100).points.size() == 300);
  CHECK(make(PslgKind::polylines, 100).polylines.size() >= 8);
  CHECK(make(PslgKind::zigzag, 50).polylines.front().points.size() == 51);
  const auto lengths = lines_of(make(PslgKind::lengths, 2000));
  double shortest = 1, longest = 0;
  for (const auto& s : lengths) {
    const double length = std::hypot(s.a[0] - s.b[0], s.a[1] - s.b[1]);
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  CHECK(longest > 20 * shortest);
}

TEST_CASE("the legs of a fan are as far apart as asked") {
  const double degrees = GENERATE(0.001, 0.01, 1.0, 60.0);
  const auto lines = lines_of(mesher::generate_pslg({PslgKind::fan, 2, 1, degrees}));
  REQUIRE(lines.size() == 2);
  const auto direction = [](const Line& s) { return std::atan2(s.b[1] - s.a[1], s.b[0] - s.a[0]); };
  const double angle = (direction(lines[1]) - direction(lines[0])) * 180 / 3.14159265358979323846;
  CHECK(angle == Approx(degrees).epsilon(1e-8));
}

TEST_CASE("the families are the same bits on every machine") {
  std::uint64_t digest = 0;
  for (const std::string& name : mesher::pslg_kind_names()) {
    const Graph<2> pslg = mesher::generate_pslg({mesher::pslg_kind(name).value(), 50, 1, {}});
    for (const auto& p : pslg.points) {
      for (const double x : p.at) {
        digest = mesher::SplitMix64(digest ^ std::bit_cast<std::uint64_t>(x)).bits();
      }
    }
  }
  CHECK(digest == 0xb17239fe7664dd88);
}
