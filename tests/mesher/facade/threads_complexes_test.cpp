// Meshers of points, lines and polygons in space on several threads: at every step the mesh, the
// change and the errors are those of one thread, whatever happens on the way.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "by_threads.hpp"
#include "facade/box_mesher.hpp"
#include "failing_update.hpp"
#include "plc_families.hpp"
#include "space_parcels.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Change;
using mesher::Error;
using mesher::LineId;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using mesher::PointId;
using mesher::Polygon;
using mesher::PolygonId;
using mesher::Progress;
using mesher::RunControl;
using support::is_same;
using support::is_tiled;
using support::said;

constexpr double kAcross = support::SpaceParcels<BoxMesher<3>>::kAcross;

Options<3> options_for(int threads, double rho = 2, double side = kAcross) {
  Options<3> options;
  options.domain = {{0, 0, 0}, {side, side, side}};
  options.rho = rho;
  options.threads = threads;
  return options;
}

// The same edits of two meshers, one of which has several threads.
class Pair {
 public:
  Pair(int threads, double rho = 2, double side = kAcross)
      : many_(options_for(threads, rho, side)), one_(options_for(1, rho, side)) {}

  void insert(PointId id, const Point<3>& p) {
    both([&](auto& m) { m.insert(id, p); });
  }
  void remove(PointId id) {
    both([&](auto& m) { m.remove(id); });
  }
  void move(PointId id, const Point<3>& p) {
    both([&](auto& m) { m.move(id, p); });
  }
  void insert_segment(LineId id, PointId a, PointId b) {
    both([&](auto& m) { m.insert_segment(id, a, b); });
  }
  void remove_line(LineId id) {
    both([&](auto& m) { m.remove_line(id); });
  }
  void insert_polygon(const Polygon& polygon) {
    both([&](auto& m) { m.insert_polygon(polygon); });
  }
  void remove_polygon(PolygonId id) {
    both([&](auto& m) { m.remove_polygon(id); });
  }
  void discard_edits() {
    both([&](auto& m) { m.discard_edits(); });
  }
  void insert(const support::Complex& complex, std::int64_t first) {
    const auto id = [&](std::size_t i) { return PointId{first + static_cast<std::int64_t>(i)}; };
    for (std::size_t i = 0; i < complex.points.size(); ++i) insert(id(i), complex.points[i]);
    std::int64_t next = first;
    for (const auto& [a, b] : complex.segments) insert_segment(LineId{next++}, id(a), id(b));
    for (const auto& face : complex.faces) {
      Polygon polygon{PolygonId{next++}, {}};
      for (const auto& loop : face.loops) {
        auto& ids = polygon.loops.emplace_back();
        for (const std::size_t i : loop) ids.push_back(id(i));
      }
      for (const std::size_t i : face.on) polygon.points.push_back(id(i));
      insert_polygon(polygon);
    }
  }

  // Both refuse in the same words, or both do it and are equal. Throws the error.
  void update() {
    Change<3> change, expected;
    std::optional<Error> refused, refused_by_one;
    try {
      expected = one_.update();
    } catch (const Error& e) {
      refused_by_one = e;
    }
    try {
      change = many_.update();
    } catch (const Error& e) {
      refused = e;
    }
    REQUIRE((refused ? said(*refused) : "") == (refused_by_one ? said(*refused_by_one) : ""));
    REQUIRE(many_.mesh() == one_.mesh());
    REQUIRE(is_same(change, expected));
    REQUIRE(change.faces_added == expected.faces_added);
    REQUIRE(change.faces_removed == expected.faces_removed);
    REQUIRE(change.guard == expected.guard);
    REQUIRE(many_.stats().vertices == one_.stats().vertices);
    REQUIRE(many_.stats().simplices == one_.stats().simplices);
    if (is_always_tiled && many_.size() > 1) REQUIRE(is_tiled(many_));
    if (refused) throw *refused;
  }
  void check() const {
    many_.check_invariants();
    REQUIRE(many_.points() == one_.points());
    REQUIRE(many_.lines() == one_.lines());
    REQUIRE(many_.polygons() == one_.polygons());
  }
  bool is_always_tiled = true;

  BoxMesher<3>& many() { return many_; }
  BoxMesher<3>& one() { return one_; }

 private:
  // What is refused at once is refused by both.
  template <class Edit>
  void both(Edit&& edit) {
    const auto told = [&](BoxMesher<3>& m) -> std::optional<Error> {
      try {
        edit(m);
      } catch (const Error& e) {
        return e;
      }
      return std::nullopt;
    };
    const auto a = told(many_), b = told(one_);
    REQUIRE((a ? said(*a) : "") == (b ? said(*b) : ""));
    if (a) throw *a;
  }

  BoxMesher<3> many_, one_;
};

void check_edits(std::uint64_t seed, int threads, int updates, double rho = 2) {
  CAPTURE(seed, threads, rho);
  Pair pair(threads, rho);
  support::SpaceParcels<Pair> parcels(pair, seed);
  int done = 0;
  for (int update = 0; update < updates; ++update) {
    CAPTURE(update);
    const std::uint64_t count = update == 0 ? 6 : 1 + parcels.below(3);
    done += parcels.edit_and(count, [&] { pair.update(); });
    if (update % 4 == 3) pair.check();
  }
  pair.check();
  CHECK(done > updates / 2);
}

}  // namespace

TEST_CASE("with complexes, on several threads every update is that of one") {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    check_edits(seed, seed % 2 == 0 ? 2 : 5, 8);
  }
}
TEST_CASE("soak: with complexes, on several threads every update is that of one", "[.soak][soak]") {
  for (std::uint64_t seed = 20; seed < 60; ++seed) {
    check_edits(seed, 2 + static_cast<int>(seed % 7), 16, seed % 3 == 0 ? 1.3 : 2);
  }
}

TEST_CASE("with complexes, on several threads every update is that of one, whatever rho is") {
  std::uint64_t seed = 100;
  for (const double rho : {1.25, 1.42, 3.0, 10.0}) check_edits(seed++, 3, 6, rho);
}
