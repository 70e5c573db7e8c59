// Cells that are read from a triangulation are those that a search finds, to the last bit.
#include "index/live_triangulation.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <vector>

#include "delaunay_case.hpp"
#include "index/vertex_index.hpp"
#include "mesher/extra/generate.hpp"
#include "sac/sac.hpp"

namespace {

using mesher::Point;
using mesher::detail::CellOf;
using mesher::detail::LiveTriangulation;
using mesher::detail::MeshBox;
using mesher::detail::Vertex;
using mesher::detail::VertexHandle;
using mesher::detail::VertexIndex;
using support::Kind;

constexpr double kGood2 = 2;

template <int D>
MeshBox<D> box_around() {
  MeshBox<D> box;
  box.lo.fill(-64);
  box.side = 128;
  box.boundary_steps = 4;
  return box;
}

// The same vertices twice: of one set cells are read, of the other they are searched for.
template <int D>
struct Twice {
  sac::PlainScope s;
  MeshBox<D> box = box_around<D>();
  VertexIndex<sac::PlainScope, D> read{box}, searched{box};

  // `later` come one by one.
  Twice(const std::vector<Point<D>>& first, const std::vector<Point<D>>& later) {
    for (auto* index : {&read, &searched}) {
      box.for_each_boundary_point([&](const Point<D>& p) { index->add_boundary(p); });
      for (const auto& p : first) index->insert_early(s, p);
    }
    read.begin_questions(kGood2, [] {});
    for (const auto& p : later) insert(p);
  }
  void insert(const Point<D>& p) {
    const auto v = searched.insert(s, p);
    REQUIRE(read.insert(s, p)->self == v->self);
  }
};

// All that a rule asks of a cell.
template <int D>
auto corners_of(const CellOf<D>& cell) {
  std::vector<std::pair<Point<D>, std::array<std::uint32_t, D>>> all;
  for (int t = 0; t < cell.corners(); ++t) {
    std::array<std::uint32_t, D> codes;
    std::size_t k = 0;
    for (const int i : cell.ends(t)) codes[k++] = cell.code(i);
    std::sort(codes.begin(), codes.end());
    all.emplace_back(cell.corner(t), codes);
  }
  std::sort(all.begin(), all.end());
  return all;
}

template <int D>
bool all_good(const CellOf<D>& cell, double radius) {
  for (int t = 0; t < cell.corners(); ++t) {
    std::vector<Point<D>> simplex{cell.center().p};
    for (const int i : cell.ends(t)) {
      if (!cell.real(i)) return false;
      simplex.push_back(cell.place(i));
    }
    for (const auto& p : simplex) {
      for (const auto& q : simplex) {
        if (p != q && cell.corner2(t) > kGood2 * mesher::detail::squared_distance(p, q))
          return false;
      }
    }
    if (cell.corner2(t) >= radius * radius) return false;
  }
  return true;
}

// Returns: how many cells were not to be read at all.
template <int D>
std::size_t require_same(Twice<D>& twice) {
  std::size_t settled = 0;
  twice.searched.pool().for_each([&](Vertex<D>& v) {
    Vertex<D>& same = twice.read.pool()[v.self];
    REQUIRE(twice.read.nearest2(twice.s, {&same}) == twice.searched.nearest2(twice.s, {&v}));
    for (const double radius : {0.25, 1.0, 3.0, 16.0, twice.read.whole()}) {
      const auto cell = twice.read.voronoi_cell(twice.s, {&same}, radius);
      const auto expected = twice.searched.voronoi_cell(twice.s, {&v}, radius);
      cell->check_invariants();
      std::vector<std::uint32_t> codes, expected_codes;
      cell->write(codes);
      expected->write(expected_codes);
      REQUIRE(codes == expected_codes);
      REQUIRE(corners_of<D>(*cell) == corners_of<D>(*expected));
      if (!twice.read.is_settled({&same}, radius)) continue;
      ++settled;
      REQUIRE(all_good<D>(*expected, radius));
    }
  });
  return settled;
}

template <int D>
std::vector<Point<D>> part(const std::vector<Point<D>>& points, bool odd) {
  std::vector<Point<D>> some;
  for (std::size_t i = odd ? 1 : 0; i < points.size(); i += 2) some.push_back(points[i]);
  return some;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("cells read from the triangulation are those that searches find",
                       "[template]", ((int D), D), 2, 3) {
  std::size_t settled = 0;
  for (const Kind kind : support::kKinds) {
    if (kind == Kind::spread) continue;  // nearer than an index tells apart
    INFO(support::name(kind));
    const auto points = support::distinct_points<D>(kind, 300, 3);
    Twice<D> twice(part<D>(points, false), part<D>(points, true));
    REQUIRE_FALSE(twice.read.searches());
    settled += require_same(twice);
  }
  CHECK(settled > 0);
}

TEMPLATE_TEST_CASE_SIG("the nearest vertex is that of doubles where a pair is very near",
                       "[template]", ((int D), D), 2, 3) {
  // On a grid many are equally near; a pair is nearer than 2^-19 of that.
  std::vector<Point<D>> points;
  for (int i = 0; i < (D == 2 ? 36 : 216); ++i) {
    Point<D> p;
    for (std::size_t axis = 0, rest = static_cast<std::size_t>(i); axis < D; ++axis, rest /= 6) {
      p[axis] = static_cast<double>(rest % 6);
    }
    points.push_back(p);
    p[0] += 0x1p-24;
    if (i % 5 == 0) points.push_back(p);
  }
  Twice<D> twice(points, {});
  CHECK(require_same(twice) > 0);
}

TEST_CASE("a vertex is not inserted where there is one") {
  Twice<2> twice({{0, 0}, {1, 0}, {0, 1}}, {{1, 1}});
  CHECK_THROWS_AS(twice.read.insert(twice.s, {1, 1}), mesher::Error);
}

TEST_CASE("a line and a circle around it have no triangulation to read from") {
  const MeshBox<3> box = box_around<3>();
  VertexIndex<sac::PlainScope, 3> all(box);
  sac::PlainScope s;
  box.for_each_boundary_point([&](const Point<3>& p) { all.add_boundary(p); });
  for (const auto& p : mesher::generate_points<3>(mesher::PointKind::line_circle, 2000, 1)) {
    all.insert_early(s, p);
  }
  all.begin_questions(kGood2, [] {});
  CHECK(all.searches());
  CHECK(all.triangulation() == nullptr);
}
