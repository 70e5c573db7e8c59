// Meshers of points, lines and polygons in space on several threads: at every step the mesh, the
// change and the errors are those of one thread, whatever happens on the way.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <optional>
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
using mesher::SizeLimits;
using support::is_same;
using support::is_tiled;
using support::said;

constexpr double kAcross = support::SpaceParcels<BoxMesher<3>>::kAcross;

constexpr mesher::Box<3> kParcels{{0, 0, 0}, {kAcross, kAcross, kAcross}};

Options<3> options_for(int threads, double rho = 2, const mesher::Box<3>& domain = kParcels) {
  Options<3> options;
  options.domain = domain;
  options.rho = rho;
  options.threads = threads;
  return options;
}

Options<3> on_one_thread(Options<3> options) {
  options.threads = 1;
  return options;
}

// The same edits of two meshers, one of which has several threads.
class Pair {
 public:
  explicit Pair(int threads, double rho = 2, const mesher::Box<3>& domain = kParcels)
      : Pair(options_for(threads, rho, domain)) {}
  explicit Pair(const Options<3>& options) : many_(options), one_(on_one_thread(options)) {}

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
  void limit(const SizeLimits<3>& limits) {
    both([&](auto& m) { m.limit(limits); });
  }
  void limit(const mesher::Box<3>& box, const SizeLimits<3>& limits) {
    both([&](auto& m) { m.limit(box, limits); });
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

  void remove_any_feature() {
    if (!one_.polygons().empty()) return remove_polygon(one_.polygons().front().id);
    if (!one_.lines().empty()) remove_line(one_.lines().front().id);
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
    // What is refused is tried again by one thread; tiles stay where that refuses it, too.
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

// `prepare` makes other edits before each update but the first.
template <class Prepare>
void check_edits(std::uint64_t seed, const Options<3>& options, int updates, Prepare&& prepare) {
  CAPTURE(seed, options.threads, options.rho, options.min_dihedral, options.max_measure);
  Pair pair(options);
  support::SpaceParcels<Pair> parcels(pair, seed);
  int done = 0;
  for (int update = 0; update < updates; ++update) {
    CAPTURE(update);
    const std::uint64_t count = update == 0 ? 6 : 1 + parcels.below(3);
    done += parcels.edit_and(count, [&] {
      if (update != 0) prepare(pair, parcels);
      pair.update();
    });
    if (update % 4 == 3) pair.check();
  }
  pair.check();
  CHECK(done > updates / 2);
}
void check_edits(std::uint64_t seed, int threads, int updates, double rho = 2) {
  check_edits(seed, options_for(threads, rho), updates, [](auto&, auto&) {});
}

// Limits in boxes, sometimes everywhere; none in some.
void edit_limits(Pair& pair, support::SpaceParcels<Pair>& any) {
  constexpr double kMeasures[] = {0, 0.001, 0.01, 0.1};
  const SizeLimits<3> limits{.max_measure = kMeasures[any.below(4)]};
  if (any.below(6) == 0) return pair.limit(limits);
  mesher::Box<3> box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.lo[i] = 0.25 * static_cast<double>(any.below(8));
    box.hi[i] = box.lo[i] + 0.125 * static_cast<double>(1 + any.below(4));
  }
  pair.limit(box, limits);
}
void check_limits(std::uint64_t seed, int threads, int updates, double measure, double least) {
  Options<3> options = options_for(threads);
  options.max_measure = measure;
  options.min_dihedral = least;
  check_edits(seed, options, updates, edit_limits);
}

}  // namespace

TEST_CASE("with complexes, on several threads every update is that of one") {
  for (const std::uint64_t seed : {1, 2, 4}) check_edits(seed, seed % 2 == 0 ? 2 : 4, 8);
}
TEST_CASE("soak: with complexes, on several threads every update is that of one", "[.soak][soak]") {
  for (std::uint64_t seed = 20; seed < 60; ++seed) {
    check_edits(seed, 2 + static_cast<int>(seed % 7), 16, seed % 3 == 0 ? 1.3 : 2);
  }
}

TEST_CASE("with complexes, on several threads every update is that of one, whatever rho is") {
  std::uint64_t seed = 100;
  for (const double rho : {1.42, 3.0}) check_edits(seed++, 2, 4, rho);
}

TEST_CASE("with complexes and limits of size, on several threads every update is that of one") {
  check_limits(200, 2, 6, 0.01, 0);
  check_limits(201, 3, 6, 0, 0);  // limits come, and go, in updates
}
TEST_CASE("with complexes, on several threads slivers are split as by one") {
  for (const std::uint64_t seed : {300, 301}) {
    Options<3> options = options_for(seed == 300 ? 2 : 5);
    options.min_dihedral = 10;
    check_edits(seed, options, 6, [](auto&, auto&) {});
  }
  check_limits(302, 3, 4, 0.02, 12);
}
TEST_CASE("soak: with complexes, limits and slivers on several threads", "[.soak][soak]") {
  for (std::uint64_t seed = 310; seed < 340; ++seed) {
    check_limits(seed, 2 + static_cast<int>(seed % 6), 12, seed % 2 == 0 ? 0.01 : 0,
                 seed % 3 == 0 ? 10 : 0);
  }
}

TEST_CASE("families of complexes, on several threads") {
  struct Family {
    const char* name;
    double parameter;
  };
  int tiled = 0;
  for (const Family& family : {Family{"cube", 0},
                               {"cubepoly", 0},
                               {"dumbbell", 0},
                               {"lhole", 0},
                               {"plates", 0.05},
                               {"wedge", 20},
                               {"fan", 12},
                               {"segfac", 20}}) {
    for (const bool is_turned : {false, true}) {
      CAPTURE(family.name, is_turned);
      support::Complex complex = support::complex_of(family.name, family.parameter);
      if (is_turned) complex = support::turned(complex);
      mesher::Box<3> box{complex.points[0], complex.points[0]};
      for (const Point<3>& p : complex.points) {
        for (std::size_t i = 0; i < 3; ++i) {
          box.lo[i] = std::min(box.lo[i], p[i]), box.hi[i] = std::max(box.hi[i], p[i]);
        }
      }
      Pair pair(3, 2, box);
      pair.is_always_tiled = false;  // where all is in one tile it cannot be told
      pair.insert(complex, 1);
      pair.update();
      pair.check();
      tiled += is_tiled(pair.many());
      pair.remove_any_feature();
      pair.update();
      pair.check();
    }
  }
  CHECK(tiled > 8);
}

TEST_CASE("lines and polygons come to points on several threads, and all go again") {
  for (const int threads : {2, 5}) {
    Pair pair(threads);
    support::SpaceParcels<Pair> parcels(pair, 9);
    for (int i = 1; i <= 40; ++i) {
      const double x = 0.05 + 0.045 * i;
      pair.insert(PointId{1000 + i}, {x, 0.011 * i, 1.9 - 0.03 * i});
    }
    pair.update();
    REQUIRE(parcels.edit_and(6, [&] { pair.update(); }));
    pair.check();
    for (const auto& polygon : pair.one().polygons()) pair.remove_polygon(polygon.id);
    for (const auto& line : pair.one().lines()) pair.remove_line(line.id);
    pair.update();
    pair.check();
    for (const auto& p : pair.one().points()) pair.remove(p.id);
    pair.update();
    pair.check();
  }
}

namespace {

// A polygon goes, a corner moves, a segment comes, in two tiles.
struct ComplexWorld {
  BoxMesher<3> m{options_for(2, 2, {{0, 0, 0}, {1, 1, 1}})};
  Mesh<3> before;
  ComplexWorld() {
    const double corners[4][3] = {
        {0.2, 0.2, 0.2}, {0.8, 0.3, 0.2}, {0.4, 0.8, 0.3}, {0.5, 0.5, 0.9}};
    for (int i = 0; i < 4; ++i) {
      m.insert(PointId{i + 1}, {corners[i][0], corners[i][1], corners[i][2]});
    }
    int id = 1;
    for (const auto& face : {std::array{1, 2, 3}, std::array{1, 2, 4}, std::array{2, 3, 4}}) {
      m.insert_polygon({PolygonId{id++}, {{PointId{face[0]}, PointId{face[1]}, PointId{face[2]}}}});
    }
    m.update();
    before = m.mesh();
  }
  void announce() {
    m.remove_polygon(PolygonId{1});
    m.move(PointId{4}, {0.52, 0.5, 0.88});
    m.insert(PointId{5}, {0.1, 0.9, 0.1}), m.insert(PointId{6}, {0.9, 0.9, 0.2});
    m.insert_segment(LineId{1}, PointId{5}, PointId{6});
  }
};

}  // namespace

TEST_CASE("with complexes, on several threads an update in which an allocation fails leaves them") {
  support::check_failing_updates<ComplexWorld>(support::SeeMesh{}, 397);
}
TEST_CASE("soak: with complexes, the same for every allocation", "[.soak][soak]") {
  support::check_failing_updates<ComplexWorld>();
}

TEST_CASE("with complexes, an update on several threads that is stopped, anywhere, is taken back") {
  Pair pair(3);
  support::SpaceParcels<Pair> parcels(pair, 3);
  REQUIRE(parcels.edit_and(6, [&] { pair.update(); }));
  BoxMesher<3>& m = pair.many();
  const Mesh<3> before = m.mesh();
  const auto announce = [&] {
    m.remove_polygon(m.polygons().front().id);
    m.insert(PointId{5000}, {0.31, 1.7, 1.2}), m.insert(PointId{5001}, {1.62, 0.4, 0.7});
  };
  bool is_done = false;
  int stopped = 0;
  for (int after = 1; !is_done; after = after * 2 + 1) {
    int calls = 0;
    RunControl control;
    control.progress = [&](const Progress&) { return ++calls < after; };
    announce();
    is_done = !support::is_stopped(m, control, before);
    stopped += !is_done;
  }
  m.check_invariants();
  CHECK(is_tiled(m));
}
