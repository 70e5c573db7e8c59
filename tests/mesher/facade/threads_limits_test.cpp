// Limits of size on several threads: at every step the mesh, the change and the errors are those of
// one thread, whatever happens on the way.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "by_threads.hpp"
#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "facade/tiled_state.hpp"
#include "failing_update.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/sizes.hpp"
#include "program/world_impl.hpp"
#include "random_limits.hpp"
#include "rules/mesh_box.hpp"
#include "sizes/fill_places.hpp"

namespace {

using mesher::Box;
using mesher::BoxMesher;
using mesher::Change;
using mesher::ErrorCode;
using mesher::Graph;
using mesher::LineId;
using mesher::Mesh;
using mesher::Mesher;
using mesher::Options;
using mesher::Point;
using mesher::PointId;
using mesher::PointKind;
using mesher::Progress;
using mesher::PslgKind;
using mesher::RunControl;
using mesher::SizeLimits;
using mesher::SplitMix64;
using support::is_same;
using support::is_tiled;
using support::noticed;
using support::said;

constexpr double kSide = 16;  // of all domains here

template <int D>
Options<D> options_for(int threads) {
  Options<D> options;
  options.domain.hi.fill(kSide);
  options.domain.lo.fill(0);
  options.threads = threads;
  return options;
}

template <class Act>
std::string said_by(Act&& act) {
  try {
    act();
  } catch (const mesher::Error& e) {
    return said(e);
  }
  return {};
}

template <int D>
Point<D> any_place(SplitMix64& random, double from = 0, double to = kSide) {
  Point<D> p;
  for (double& x : p) x = from + random.unit() * (to - from);
  return p;
}

// The same edits of two meshers, one of which has several threads.
template <int D>
class Pair {
 public:
  explicit Pair(int threads, const SizeLimits<D>& limits = {})
      : many_(options_for<D>(threads)), one_(options_for<D>(1)) {
    if (limits != SizeLimits<D>()) limit(limits);
  }

  bool insert(const Point<D>& p) {
    const PointId id{next_};
    const std::string refused = said_by([&] { many_.insert(id, p); });
    REQUIRE(said_by([&] { one_.insert(id, p); }) == refused);
    next_ += refused.empty();
    return refused.empty();
  }
  void insert(const std::vector<Point<D>>& points) {
    for (const Point<D>& p : points) insert(p);
  }
  void begin_ids_at(std::int64_t next) { next_ = next; }
  // A line between two new points.
  void insert_line(const Point<D>& p, const Point<D>& q) {
    if (!insert(p) || !insert(q)) return;
    both([&](auto& m) { m.insert_segment(LineId{next_}, PointId{next_ - 2}, PointId{next_ - 1}); });
  }
  template <class Edit>
  void both(Edit&& edit) {
    edit(many_), edit(one_);
  }
  void limit(const SizeLimits<D>& limits) {
    both([&](auto& m) { m.limit(limits); });
  }
  void limit(const Box<D>& box, const SizeLimits<D>& limits) {
    both([&](auto& m) { m.limit(box, limits); });
  }
  void remove_any(SplitMix64& random) {
    const auto all = one_.points();
    if (all.empty()) return;
    const PointId id = all[random.below(all.size())].id;
    if (one_.contains(id)) both([&](auto& m) { m.remove(id); });
  }
  void move_any(SplitMix64& random, double by) {
    const auto all = one_.points();
    if (all.empty()) return;
    auto [id, to, marker] = all[random.below(all.size())];
    if (!one_.contains(id)) return;
    for (double& x : to) x = std::clamp(x + by * (2 * random.unit() - 1), 0.0, kSide);
    const PointId moved = id;
    const Point<D> place = to;
    both([&](auto& m) { m.move(moved, place); });
  }
  void remove_any_line(SplitMix64& random) {
    const auto all = one_.lines();
    if (all.empty()) return;
    const LineId id = all[random.below(all.size())].id;
    if (one_.contains_line(id)) both([&](auto& m) { m.remove_line(id); });
  }
  // Both refuse in the same words, or both do it and are equal.
  bool update() {
    Change<D> change, expected;
    const std::string refused = said_by([&] { expected = one_.update(); });
    REQUIRE(said_by([&] { change = many_.update(); }) == refused);
    REQUIRE(many_.mesh() == one_.mesh());
    REQUIRE(is_same<D>(change, expected));
    REQUIRE(many_.stats().vertices == one_.stats().vertices);
    REQUIRE(many_.stats().simplices == one_.stats().simplices);
    if (many_.size() > 1 && !one_.mesh().vertices.empty() && is_always_tiled) {
      REQUIRE(is_tiled(many_));
    }
    return refused.empty();
  }
  void check() const {
    many_.check_invariants();
    REQUIRE(many_.points() == one_.points());
    REQUIRE(many_.lines() == one_.lines());
    REQUIRE(many_.options().box_limits == one_.options().box_limits);
  }
  bool is_always_tiled = true;

  BoxMesher<D>& many() { return many_; }
  BoxMesher<D>& one() { return one_; }

 private:
  BoxMesher<D> many_, one_;
  std::int64_t next_ = 1;
};

template <int D>
std::vector<Point<D>> points_of(PointKind kind, std::size_t n, std::uint64_t seed) {
  auto points = mesher::generate_points<D>(kind, n, seed);
  const Box<D> box = mesher::snapped_domain<D>(points);
  for (auto& p : points) {
    for (int i = 0; i < D; ++i) p[i] = (p[i] - box.lo[i]) / (box.hi[i] - box.lo[i]) * kSide;
  }
  return points;
}

template <int D>
void edit_points(Pair<D>& pair, SplitMix64& random) {
  for (std::uint64_t i = random.below(4); i > 0; --i) {
    switch (random.below(4)) {
      case 0:
        pair.remove_any(random);
        break;
      case 1:
        pair.move_any(random, random.below(2) == 0 ? 1e-4 : 1);
        break;
      default:
        pair.insert(any_place<D>(random));
    }
  }
}

void check_plane(PointKind kind, std::size_t n, int threads, int steps, std::uint64_t seed) {
  CAPTURE(static_cast<int>(kind), n, threads, seed);
  SplitMix64 random(seed);
  support::RandomLimits limits(seed);
  Pair<2> pair(threads, {.max_measure = 0.4375});
  pair.insert(points_of<2>(kind, n, seed));
  pair.update();
  pair.check();
  for (int step = 0; step < steps; ++step) {
    CAPTURE(step);
    edit_points(pair, random);
    if (limits.below(6) == 0) pair.limit(limits.limits());
    if (limits.below(2) == 0) pair.limit(limits.box(), limits.limits());
    pair.update();
    if (step % 4 == 3) pair.check();
  }
  pair.check();
}

constexpr PointKind kFamilies[] = {PointKind::uniform,     PointKind::gaussian, PointKind::clusters,
                                   PointKind::grid,        PointKind::spiral,   PointKind::sphere,
                                   PointKind::line_circle, PointKind::spread};

}  // namespace

TEST_CASE("with limits, on several threads every update is that of one, in the plane") {
  std::uint64_t seed = 1;
  for (const PointKind kind : kFamilies) {
    check_plane(kind, 40, seed % 2 == 0 ? 2 : 5, 8, seed);
    ++seed;
  }
  check_plane(PointKind::uniform, 3, 7, 12, seed);
  check_plane(PointKind::uniform, 400, 3, 8, seed);
}
TEST_CASE("soak: with limits, the same in the plane", "[.soak][soak]") {
  std::uint64_t seed = 100;
  for (const PointKind kind : kFamilies) {
    for (const int threads : {2, 3, 5, 7}) check_plane(kind, 60, threads, 16, seed++);
  }
}

TEST_CASE("a limit of size everywhere, on several threads, and more vertices than points") {
  for (const int threads : {2, 7}) {
    Pair<2> pair(threads);
    pair.insert(points_of<2>(PointKind::uniform, 30, 3));
    pair.update();
    for (const double area : {0.5, 0.03, 0.0}) {
      pair.limit({.max_measure = area});
      REQUIRE(pair.update());
      pair.check();
    }
    pair.limit({{3, 4}, {12, 9}}, {.max_measure = 0.02});  // across borders, and then none
    REQUIRE(pair.update());
    pair.check();
    pair.limit({{3, 4}, {12, 9}}, {});
    REQUIRE(pair.update());
    pair.check();
  }
}

// --- Space

namespace {

Box<3> any_box(SplitMix64& random) {
  Box<3> box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.lo[i] = std::floor(kSide * random.unit());
    box.hi[i] = box.lo[i] + 1 + 4 * random.unit();
  }
  return box;
}

void check_space(PointKind kind, std::size_t n, int threads, int steps, std::uint64_t seed) {
  CAPTURE(static_cast<int>(kind), n, threads, seed);
  SplitMix64 random(seed);
  const auto sloped = std::make_shared<mesher::SlopedSizes<3>>(
      [](const Point<3>& p) { return 1.5 + 0.3 * std::hypot(p[0] - 7, p[1] - 9); }, 0.3, 1.5);
  const SizeLimits<3> limits[] = {{.max_measure = 8}, {.max_measure = 3}, {}, {.sizes = sloped}};
  Pair<3> pair(threads, limits[seed % 2 == 0 ? 0 : 3]);
  pair.insert(points_of<3>(kind, n, seed));
  pair.update();
  pair.check();
  for (int step = 0; step < steps; ++step) {
    CAPTURE(step);
    edit_points(pair, random);
    if (random.below(2) == 0) pair.limit(any_box(random), limits[random.below(4)]);
    pair.update();
    if (step % 4 == 3) pair.check();
  }
  pair.check();
}

}  // namespace

TEST_CASE("with limits, on several threads every update is that of one, in space") {
  std::uint64_t seed = 1;
  for (const PointKind kind : {PointKind::uniform, PointKind::clusters, PointKind::grid}) {
    for (const int threads : {2, 5}) check_space(kind, 20, threads, 4, seed++);
  }
  check_space(PointKind::uniform, 150, 3, 4, seed);
}
TEST_CASE("soak: with limits, the same in space", "[.soak][soak]") {
  std::uint64_t seed = 100;
  for (const PointKind kind : kFamilies) {
    for (const int threads : {2, 3, 7}) check_space(kind, 30, threads, 12, seed++);
  }
}

// --- Lines

namespace {

void check_lines(PslgKind kind, std::size_t n, int threads, int steps, std::uint64_t seed) {
  CAPTURE(static_cast<int>(kind), n, threads, seed);
  SplitMix64 random(seed);
  support::RandomLimits limits(seed);
  Pair<2> pair(threads, {.max_measure = 0.4375});
  const Graph<2> graph = mesher::generate_pslg({kind, n, seed});
  pair.both([&](auto& m) {
    for (const auto& p : graph.points) m.insert(p.id, {kSide * p.at[0], kSide * p.at[1]});
    for (const auto& s : graph.segments) m.insert_segment(s.id, s.from, s.to);
    for (const auto& l : graph.polylines) m.insert_polyline(l.id, l.points);
  });
  pair.begin_ids_at(100000);
  pair.update();
  pair.check();
  int done = 0;
  for (int step = 0; step < steps; ++step) {
    CAPTURE(step);
    switch (random.below(4)) {
      case 0:
        pair.remove_any_line(random);
        break;
      case 1:
        pair.move_any(random, 0.1);
        break;
      case 2:
        edit_points(pair, random);
        break;
      default: {
        const Point<2> p = any_place<2>(random, 1, kSide - 1);
        pair.insert_line(p, {p[0] + random.unit() - 0.5, p[1] + random.unit() - 0.5});
      }
    }
    if (limits.below(6) == 0) pair.limit(limits.limits());
    if (limits.below(2) == 0) pair.limit(limits.box(), limits.limits());
    done += pair.update();
    if (step % 4 == 3) pair.check();
  }
  pair.check();
  CHECK((steps < 8 || done > 0));
}

}  // namespace

TEST_CASE("with lines and limits, on several threads every update is that of one") {
  std::uint64_t seed = 1;
  for (const PslgKind kind :
       {PslgKind::segments, PslgKind::lengths, PslgKind::polylines, PslgKind::trees,
        PslgKind::corridors, PslgKind::zigzag, PslgKind::fan, PslgKind::bundle}) {
    check_lines(kind, 10, seed % 2 == 0 ? 2 : 5, 8, seed);
    ++seed;
  }
}
TEST_CASE("soak: with lines and limits, the same", "[.soak][soak]") {
  std::uint64_t seed = 100;
  for (const PslgKind kind :
       {PslgKind::segments, PslgKind::lengths, PslgKind::polylines, PslgKind::trees,
        PslgKind::corridors, PslgKind::zigzag, PslgKind::fan, PslgKind::bundle}) {
    for (const int threads : {2, 3, 7}) check_lines(kind, 30, threads, 16, seed++);
  }
}

TEST_CASE("where the lattice has most of the vertices, tiles have as many of them each") {
  Options<2> options = options_for<2>(1);
  options.max_measure = 0.02;
  BoxMesher<2> m(options);
  const auto points = points_of<2>(PointKind::clusters, 40, 2);
  for (std::size_t i = 0; i < points.size(); ++i) m.insert(PointId(i + 1), points[i]);
  m.limit({{2, 3}, {6, 7}}, {.max_measure = 0.005});
  m.update();
  const auto box = mesher::detail::mesh_box(m.options());
  const mesher::detail::Limits<2> limits(m.options(), box);
  const mesher::detail::Territories<2> all(
      mesher::detail::places_of_work(points, limits, box, options.domain), 4);
  REQUIRE(all.size() == 4);
  std::vector<std::size_t> own(4);
  const Mesh<2> mesh = m.mesh();
  for (const Point<2>& p : mesh.vertices) ++own[all.owner(p)];
  for (const std::size_t count : own) {
    CHECK(count * 4 > mesh.vertices.size() * 3 / 4);
    CHECK(count * 4 < mesh.vertices.size() * 5 / 4);
  }
}

namespace {

// Two rooms with a wall between them, line 2, in a wide domain; regions with limits of their own.
template <class Target>
void announce_rooms(Target& m) {
  const std::vector<Point<2>> points{{4, 4}, {8, 4}, {12, 4}, {12, 8}, {8, 8}, {4, 8}};
  for (std::size_t i = 0; i < points.size(); ++i) m.insert(PointId(i + 1), points[i]);
  m.insert_polyline(LineId{1}, {PointId{1}, PointId{2}, PointId{3}, PointId{4}, PointId{5},
                                PointId{6}, PointId{1}});
  m.insert_segment(LineId{2}, PointId{2}, PointId{5});
  m.insert_seed(mesher::region_seed<2>(1, {5, 5}, 0, 0.02));
}

}  // namespace

TEST_CASE("on several threads limits count in what lines enclose, and regions have their own") {
  for (const int threads : {2, 5}) {
    Options<2> options = options_for<2>(threads);
    options.region_areas = mesher::RegionAreas::limits;
    Mesher<2> many(options);
    options.threads = 1;
    Mesher<2> one(options);
    const auto both = [&](auto&& edit) {
      edit(many), edit(one);
      const auto expected = one.update();
      const auto change = many.update();
      REQUIRE(many.box_mesh() == one.box_mesh());
      REQUIRE(is_same<2>(change, expected));
      REQUIRE(change.domain.kept_added == expected.domain.kept_added);
      REQUIRE(change.domain.kept_removed == expected.domain.kept_removed);
      REQUIRE(many.stats().vertices == one.stats().vertices);
      many.check_invariants();
    };
    both([](auto& m) {
      announce_rooms(m);
      m.limit({.max_measure = 0.05});
    });
    both([](auto& m) { m.remove_line(LineId{2}); });  // the rooms are one
    both([](auto& m) { m.insert_segment(LineId{3}, PointId{2}, PointId{5}); });
    both([](auto& m) { m.move(PointId{4}, {13, 9}); });
    both([](auto& m) { m.limit({{5, 5}, {10, 7}}, {.max_measure = 0.01}); });
    both([](auto& m) {
      m.insert(PointId{10}, {7, 6});
      m.insert(PointId{11}, {14, 14});
    });
    both([](auto& m) { m.remove_seed(mesher::region_id(1)); });
    both([](auto& m) { m.remove_line(LineId{1}); });  // nothing is enclosed: all counts
    both([](auto& m) { m.limit(SizeLimits<2>()); });
  }
}

// --- What fails

TEST_CASE("on several threads limits that cannot be kept are refused as on one") {
  const auto tiny = std::make_shared<mesher::SlopedSizes<2>>(
      [](const Point<2>& p) { return p[0] > 9 && p[1] > 9 ? 1e-15 : 2.0; }, 0, 1e-15);
  const auto none = std::make_shared<mesher::SlopedSizes<2>>(
      [](const Point<2>& p) { return p[0] > 9 && p[1] > 9 ? -1 : 1.0; }, 0.1, 0.1);
  for (const bool lines : {false, true}) {
    Pair<2> pair(3, {.max_measure = 0.4375});
    pair.insert(points_of<2>(PointKind::uniform, 30, 3));
    if (lines) pair.insert_line({1, 1}, {2, 3});
    REQUIRE(pair.update());
    for (const auto& sizes : {tiny, none}) {
      for (const bool everywhere : {false, true}) {
        CAPTURE(lines, everywhere, sizes == none);
        pair.insert(Point<2>{lines ? 3.5 : 4.5, everywhere ? 6.5 : 7.5});
        everywhere ? pair.limit({.sizes = sizes})
                   : pair.limit({{2, 2}, {14, 14}}, {.sizes = sizes});
        REQUIRE_FALSE(pair.update());
        pair.check();
      }
    }
    pair.insert(Point<2>{12, 3});
    REQUIRE(pair.update());
    pair.check();
  }
}

namespace {

// How many vertices are on a line so far is another number in an update than in a first run, which
// is what says that there are too many.
std::string without_counts(const std::string& text) {
  return text.substr(0, text.find("; so far"));
}

}  // namespace

TEST_CASE("with limits, on several threads the number of vertices is limited as on one") {
  const auto points = points_of<2>(PointKind::uniform, 40, 5);
  const auto run = [&](int threads, std::size_t most, bool lines, double then) {
    Options<2> options = options_for<2>(threads);
    options.max_vertices = most;
    options.max_measure = 0.4375;
    BoxMesher<2> m(options);
    for (std::size_t i = 0; i < points.size(); ++i) m.insert(PointId(i + 1), points[i]);
    if (lines) m.insert_segment(LineId{1}, PointId{1}, PointId{2});
    std::string refused = said_by([&] { m.update(); });
    if (refused.empty() && then != 0) {
      m.limit({{2, 2}, {14, 14}}, {.max_measure = then});
      refused = said_by([&] { m.update(); });
    }
    return std::pair(refused, m.mesh());
  };
  for (const bool lines : {false, true}) {
    const std::size_t most = run(1, 0, lines, 0).second.vertices.size();
    for (const std::size_t limit : {most, most - 1, most / 2}) {
      REQUIRE(run(3, limit, lines, 0) == run(1, limit, lines, 0));
    }
    for (const double area : {0.3, 0.1, 1e-6}) {  // 10^8 vertices are not made
      CAPTURE(lines, area);
      const auto by_many = run(3, 2 * most, lines, area), by_one = run(1, 2 * most, lines, area);
      REQUIRE(without_counts(by_many.first) == without_counts(by_one.first));
      REQUIRE(by_many.second == by_one.second);
    }
  }
}

TEST_CASE("with limits, an update on several threads that is stopped, anywhere, is taken back") {
  const auto points = points_of<2>(PointKind::uniform, 400, 2);
  const auto stop_after = [](int after) {
    return RunControl{.progress = [left = after](const Progress&) mutable { return left-- > 0; },
                      .stop = {}};
  };
  for (const bool lines : {false, true}) {
    Options<2> options = options_for<2>(3);
    options.max_measure = 0.05;
    BoxMesher<2> m(options);
    for (std::size_t i = 0; i < points.size(); ++i) m.insert(PointId(i + 1), points[i]);
    if (lines) m.insert_segment(LineId{1}, PointId{1}, PointId{2});
    for (const int after : {0, 1, 3}) {  // the first run; edits stay announced
      REQUIRE(said_by([&] { m.update(stop_after(after)); }).find("cancelled") == 0);
      REQUIRE(m.mesh().vertices.empty());
    }
    m.update();
    const Mesh<2> before = m.mesh();
    bool stopped = true;
    for (int after = 0; stopped && after < 60; after = 2 * after + 1) {
      CAPTURE(lines, after);
      for (std::size_t i = 2; i < points.size(); i += 3) m.remove(PointId(i + 1));
      m.limit({{2, 3}, {11, 12}}, {.max_measure = 0.02});
      m.limit({{12, 1}, {15, 14}}, {});
      stopped = support::is_stopped(m, stop_after(after), before);
    }
    struct Mine : std::runtime_error {
      Mine() : std::runtime_error("mine") {}
    };
    const Mesh<2> now = m.mesh();
    m.insert(PointId{1000}, {7.5, 7.25});
    m.limit({{6, 6}, {9, 9}}, {.max_measure = 0.3});
    REQUIRE_THROWS_AS(m.update({}, [](const Change<2>&) { throw Mine(); }), Mine);
    REQUIRE(m.mesh() == now);
    m.check_invariants();
    REQUIRE(is_tiled(m));
  }
}

namespace {

// Limits change where points move, in two tiles.
template <bool kLines>
struct LimitedWorld {
  std::vector<Point<2>> points = points_of<2>(PointKind::uniform, 8, 6);
  BoxMesher<2> m{options_for<2>(2)};
  Mesh<2> before;
  LimitedWorld() {
    for (std::size_t i = 0; i < points.size(); ++i) m.insert(PointId(i + 1), points[i]);
    if (kLines) m.insert_segment(LineId{1}, PointId{1}, PointId{2});
    m.limit({.max_measure = 8});
    m.update();
    before = m.mesh();
  }
  void announce() {
    m.move(PointId{3}, {points[3][1], points[3][0]});
    m.limit({{5, 5}, {11, 9}}, {.max_measure = 2});
  }
};

}  // namespace

TEST_CASE(
    "with limits, on several threads an update in which an allocation fails leaves the mesh") {
  support::check_failing_updates<LimitedWorld<false>>(support::SeeMesh{}, 7);
  support::check_failing_updates<LimitedWorld<true>>(support::SeeMesh{}, 11);
}
TEST_CASE("soak: with limits, the same for every allocation", "[.soak][soak]") {
  support::check_failing_updates<LimitedWorld<false>>();
  support::check_failing_updates<LimitedWorld<true>>();
}

// --- The certificate -------------------------------------------------------------------------

namespace {

using LimitedTile = mesher::detail::TileMesher<2>;

// Two tiles that exchange all messages but one. Returns what the certificate says.
std::string fault_without(std::size_t lost, std::size_t& messages) {
  Options<2> options = options_for<2>(2);
  options.max_measure = 2;
  const auto points = points_of<2>(PointKind::uniform, 20, 11);
  const auto box = mesher::detail::mesh_box(options);
  const mesher::detail::Territories<2> all(points, 2);
  mesher::detail::VertexPool<2> pool;
  mesher::detail::FeatureTree<2> features(box, pool);
  for (const auto& p : points) features.insert_only(pool.create(p));
  const mesher::detail::WholeInput<2> whole{nullptr, &features};
  LimitedTile a(options, box, all, 0, whole), b(options, box, all, 1, whole);
  std::vector<LimitedTile::Edit> edits[2];
  const mesher::detail::Limits<2> limits(options, box);
  pool.for_each([&](const mesher::detail::Vertex<2>& v) {
    const LimitedTile::Located located(features.crowded_level(v), limits.pitch(v.p));
    edits[all.owner(v.p)].push_back({v.p, std::nullopt, located});
  });
  a.edit(edits[0]), b.edit(edits[1]);
  return support::fault_without<2>(a, b, lost, messages, [](const auto&) {});
}

}  // namespace

TEST_CASE("with limits the certificate of two tiles sees each message that is lost") {
  std::size_t all = 0;
  REQUIRE(fault_without(~std::size_t{0}, all).empty());
  REQUIRE(all > 50);
  std::size_t messages = 0;
  CHECK(noticed(all, 2, [&](std::size_t lost) { return fault_without(lost, messages); }) > 0.7);
}
