// Rectangles in a polygon's frame.
#include "space/facet_piece.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "space/polygon_shape.hpp"

namespace {

using namespace mesher::detail;
using mesher::Point;

// A polygon of one loop, without a store.
Polygon polygon_of(std::vector<Point<3>> places) {
  Polygon f;
  f.loop_end = {static_cast<std::uint32_t>(places.size())};
  f.places = std::move(places);
  REQUIRE(find_shape(f));
  return f;
}

std::vector<FacetPiece> pieces_of(const Polygon& f, int level) {
  std::vector<FacetPiece> pieces{{&f}};
  for (int n = 0; n < level; ++n) {
    std::vector<FacetPiece> halves;
    for (const FacetPiece& piece : pieces) {
      for (const FacetPiece& half : piece.halves()) halves.push_back(half);
    }
    pieces = std::move(halves);
  }
  return pieces;
}

}  // namespace

TEST_CASE("pieces of a polygon are halved into rectangles of one shape that cover it") {
  const Polygon f = polygon_of({{0, 0, 0.3}, {0.9, 0.1, 0.3}, {0.8, 0.7, 0.3}, {0.1, 0.6, 0.3}});
  for (int level = 0; level < 8; ++level) {
    CAPTURE(level);
    const auto pieces = pieces_of(f, level);
    const auto [width, height] = pieces.front().sides();
    const double aspect = std::min(width, height) / std::max(width, height);
    CHECK(aspect == Approx(std::sqrt(0.5)).epsilon(1e-3));
    CHECK(pieces.front().longer_side() == std::max(width, height));
    const double area = width * height * static_cast<double>(pieces.size());
    CHECK(area == pieces_of(f, 0).front().sides()[0] * pieces_of(f, 0).front().sides()[1]);
    for (const Point<2>& corner : f.outline) {
      int around = 0;
      for (const FacetPiece& piece : pieces) {
        around += std::abs(corner[0] - piece.middle()[0]) <= width / 2 &&
                  std::abs(corner[1] - piece.middle()[1]) <= height / 2;
      }
      CHECK(around >= 1);
    }
  }
}

TEST_CASE("places of equal pieces leave no gap wider than 0.54 of a longer side between them") {
  const Polygon f = polygon_of({{0, 0, 0}, {1, 0, 0}, {1, 0.7, 0}, {0, 0.7, 0}});
  for (const int level : {6, 7}) {
    const auto pieces = pieces_of(f, level);
    const double side = pieces.front().longer_side();
    for (double u = 0.3; u < 0.7; u += 0.013) {
      for (double v = 0.25; v < 0.45; v += 0.011) {
        double nearest = 1;
        for (const FacetPiece& piece : pieces) {
          const Point<2> x = piece.place();
          nearest = std::min(nearest, std::hypot(x[0] - u, x[1] - v));
        }
        REQUIRE(nearest < 0.54 * side);
      }
    }
  }
}

TEST_CASE("pieces are ordered by value, and the order is total") {
  const Polygon f = polygon_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const Polygon g = polygon_of({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}});
  auto all = pieces_of(f, 3);
  const auto others = pieces_of(g, 3);
  all.insert(all.end(), others.begin(), others.end());
  for (const FacetPiece& x : all) {
    for (const FacetPiece& y : all) {
      CHECK((x == y) == ((x <=> y) == 0));
      CHECK(((x <=> y) < 0) == ((y <=> x) > 0));
      if (x == y) CHECK(hash_value(x) == hash_value(y));
    }
  }
}
