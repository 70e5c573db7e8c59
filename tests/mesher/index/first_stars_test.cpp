// The stars of a first run: those that a search finds, written down alike.
#include "index/first_stars.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "delaunay_case.hpp"
#include "index/vertex_index.hpp"
#include "sac/sac.hpp"

namespace {

using mesher::Point;
using mesher::detail::FirstStars;
using mesher::detail::MeshBox;
using mesher::detail::Vertex;
using mesher::detail::VertexIndex;
using support::Kind;

}  // namespace

TEMPLATE_TEST_CASE_SIG("stars made at once are the stars that searches find", "[template]",
                       ((int D), D), 2, 3) {
  for (const Kind kind : support::kKinds) {
    if (kind == Kind::spread) continue;  // nearer than an index tells apart
    INFO(support::name(kind));
    MeshBox<D> box;
    box.lo.fill(-64);
    box.side = 128;
    box.boundary_steps = 4;
    VertexIndex<sac::PlainScope, D> index(box);
    sac::PlainScope s;
    box.for_each_boundary_point([&](const Point<D>& p) { index.add_boundary(p); });
    for (const auto& p : support::distinct_points<D>(kind, 300, 3)) index.insert(s, p);
    FirstStars<D> stars(index.pool());
    std::size_t written = 0, boundary = 0;
    index.pool().for_each([&](const Vertex<D>& v) {
      std::vector<std::uint32_t> expected, codes;
      boundary += v.boundary ? 1 : 0;
      if (!stars.write(v.self, codes)) {
        REQUIRE(v.boundary);
        return;
      }
      REQUIRE_FALSE(v.boundary);
      ++written;
      const auto cell = index.voronoi_cell(s, {const_cast<Vertex<D>*>(&v)}, index.whole());
      cell->write(expected);
      REQUIRE(codes == expected);
    });
    CHECK(written + boundary == index.pool().size());
    // Vertices that are not there are in no star.
    std::vector<std::uint32_t> codes;
    mesher::detail::VertexHandle gone = 0;
    index.pool().for_each([&](const Vertex<D>& v) { gone = v.self; });
    index.pool()[gone].alive = false;
    FirstStars<D> without(index.pool());
    CHECK_FALSE(without.write(gone, codes));
    index.pool().for_each([&](const Vertex<D>& v) {
      if (v.alive && without.write(v.self, codes)) {
        const auto around = mesher::detail::CellOf<D>::neighbours(codes);
        REQUIRE(std::find(around.begin(), around.end(), gone) == around.end());
      }
    });
  }
}
