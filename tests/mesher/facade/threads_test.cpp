// Meshers of points on several threads: at every step the mesh, and the change, are those of one
// thread, whatever happens on the way.
#include <catch2/catch.hpp>
#include <map>
#include <stdexcept>
#include <vector>

#include "by_threads.hpp"
#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "failing_new.hpp"
#include "failing_update.hpp"
#include "mesher/extra/generate.hpp"
#include "rules/mesh_box.hpp"
#include "scratch_file.hpp"
#include "tiles/tiled_mesher.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Change;
using mesher::ErrorCode;
using mesher::Graph;
using mesher::LineId;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using mesher::PointId;
using mesher::PointKind;
using mesher::Progress;
using mesher::RunControl;
using mesher::SplitMix64;
using support::error_of;
using support::is_same;
using support::noticed;

template <int D>
Options<D> options_for(const std::vector<Point<D>>& points, int threads,
                       double rho = Options<D>().rho) {
  Options<D> options;
  options.rho = rho;
  options.threads = threads;
  options.domain = mesher::snapped_domain<D>(points);
  return options;
}

// The same edits of two meshers, one of which has several threads.
template <int D>
class Pair {
 public:
  Pair(const std::vector<Point<D>>& points, int threads, double rho = Options<D>().rho)
      : options_(options_for<D>(points, threads, rho)),
        many_(options_),
        one_(options_for<D>(points, 1, rho)) {
    for (const Point<D>& p : points) insert(p);
    update();
  }

  void insert(const Point<D>& p) {
    const PointId id{next_++};
    try {
      many_.insert(id, p);
    } catch (const mesher::Error&) {
      return;  // the place is taken
    }
    one_.insert(id, p);
    points_[id] = p;
  }
  void remove_any(SplitMix64& random) {
    if (points_.empty()) return;
    const auto it =
        std::next(points_.begin(), static_cast<std::ptrdiff_t>(random.below(points_.size())));
    many_.remove(it->first);
    one_.remove(it->first);
    points_.erase(it);
  }
  void move_any(SplitMix64& random, double by) {
    if (points_.empty()) return;
    const auto it =
        std::next(points_.begin(), static_cast<std::ptrdiff_t>(random.below(points_.size())));
    Point<D> to = it->second;
    for (int i = 0; i < D; ++i) {
      to[i] += by * (2 * random.unit() - 1);
      to[i] = std::clamp(to[i], options_.domain.lo[i], options_.domain.hi[i]);
    }
    if (one_.contains(it->first)) many_.move(it->first, to), one_.move(it->first, to);
    it->second = to;
  }
  [[nodiscard]] Point<D> any_place(SplitMix64& random) const {
    Point<D> p;
    for (int i = 0; i < D; ++i) {
      p[i] =
          options_.domain.lo[i] + random.unit() * (options_.domain.hi[i] - options_.domain.lo[i]);
    }
    return p;
  }
  // Both refuse, or both do it and are equal.
  void update() {
    std::string refused, refused_by_one;
    Change<D> change, expected;
    try {
      expected = one_.update();
    } catch (const mesher::Error& e) {
      refused_by_one = mesher::code_name(e.code());
    }
    try {
      change = many_.update();
    } catch (const mesher::Error& e) {
      refused = mesher::code_name(e.code());
    }
    REQUIRE(refused == refused_by_one);
    REQUIRE(is_same<D>(change, expected));
    REQUIRE(many_.mesh() == one_.mesh());
    REQUIRE(many_.stats().vertices == one_.stats().vertices);
    REQUIRE(many_.stats().simplices == one_.stats().simplices);
  }
  void check() const {
    many_.check_invariants();
    Graph<D> graph;
    for (const auto& p : many_.points()) graph.points.push_back(p);
    REQUIRE(many_.points() == one_.points());
    Options<D> options = options_;
    options.extent = mesher::Extent::box;
    REQUIRE(many_.mesh() == mesher::mesh_statically(graph, options));
  }
  [[nodiscard]] BoxMesher<D>& many() { return many_; }
  [[nodiscard]] std::size_t size() const { return points_.size(); }

 private:
  Options<D> options_;
  BoxMesher<D> many_, one_;
  std::int64_t next_ = 1;
  std::map<PointId, Point<D>> points_;
};

template <int D>
void check_edits(PointKind kind, std::size_t n, int threads, int steps, std::uint64_t seed,
                 double rho = Options<D>().rho) {
  CAPTURE(D, static_cast<int>(kind), n, threads, seed, rho);
  SplitMix64 random(seed);
  Pair<D> pair(mesher::generate_points<D>(kind, n, seed), threads, rho);
  pair.check();
  for (int step = 0; step < steps; ++step) {
    CAPTURE(step);
    const std::uint64_t edits = 1 + random.below(4);
    for (std::uint64_t i = 0; i < edits; ++i) {
      switch (random.below(4)) {
        case 0:
          pair.remove_any(random);
          break;
        case 1:
          pair.move_any(random, random.below(2) == 0 ? 1e-6 : 0.1);
          break;
        default:
          pair.insert(pair.any_place(random));
      }
    }
    pair.update();
    if (step % 8 == 7) pair.check();
  }
  pair.check();
}

constexpr PointKind kFamilies[] = {PointKind::uniform,     PointKind::gaussian, PointKind::clusters,
                                   PointKind::grid,        PointKind::spiral,   PointKind::sphere,
                                   PointKind::line_circle, PointKind::spread};

}  // namespace

TEST_CASE("on several threads every update is that of one, in the plane") {
  std::uint64_t seed = 1;
  for (const PointKind kind : kFamilies) {
    for (const int threads : {2, 3, 7}) check_edits<2>(kind, 150, threads, 16, seed++);
  }
  check_edits<2>(PointKind::uniform, 1500, 4, 24, seed);
}

TEST_CASE("on several threads every update is that of one, in space") {
  std::uint64_t seed = 100;
  for (const PointKind kind : kFamilies) {
    for (const int threads : {2, 5}) check_edits<3>(kind, 30, threads, 4, seed++);
  }
  check_edits<3>(PointKind::uniform, 300, 3, 4, seed);
}

TEST_CASE("on several threads every update is that of one, whatever rho is") {
  std::uint64_t seed = 200;
  for (const double rho : {1.05, 1.2, 3.0, 5.0, 100.0}) {
    for (const PointKind kind : {PointKind::uniform, PointKind::clusters, PointKind::spread}) {
      check_edits<2>(kind, 60, 3, 8, seed++, rho);
    }
    if (rho < 2) continue;  // in space that takes many vertices
    check_edits<3>(PointKind::uniform, 30, 2, 4, seed++, rho);
    check_edits<3>(PointKind::grid, 30, 4, 4, seed++, rho);
  }
}

TEST_CASE("few points, points on one plane, and more threads than points") {
  for (const std::size_t n : {1, 2, 3, 5}) check_edits<2>(PointKind::uniform, n, 8, 12, n);
  std::vector<Point<2>> column, row;
  for (int i = 0; i < 40; ++i) {
    column.push_back({0.5, i / 64.0});
    row.push_back({i / 64.0, 0.25});
  }
  for (const auto& points : {column, row}) Pair<2>(points, 4).check();
  std::vector<Point<3>> sheet;
  for (int i = 0; i < 64; ++i) sheet.push_back({0.5, i % 8 / 8.0, i / 8 / 8.0});
  Pair<3>(sheet, 6).check();
}

TEST_CASE("a tile may lose all its points, and get many") {
  SplitMix64 random(5);
  Pair<2> pair(mesher::generate_points<2>(PointKind::uniform, 300, 5), 4);
  while (pair.size() > 3) {
    for (int i = 0; i < 40; ++i) pair.remove_any(random);
    pair.update();
    pair.check();
  }
  for (int i = 0; i < 300; ++i) {
    const Point<2> p = pair.any_place(random);
    pair.insert({p[0] / 16, p[1] / 16});
  }
  pair.update();
  pair.check();
}

TEST_CASE("the regions and slots of a mesher on several threads") {
  const auto points = mesher::generate_points<2>(PointKind::clusters, 200, 8);
  Options<2> options = options_for<2>(points, 3);
  mesher::Mesher<2> m(options);
  options.threads = 1;
  mesher::Mesher<2> one(options);
  for (std::size_t i = 0; i < points.size(); ++i) {
    m.insert(PointId(i + 1), points[i]);
    one.insert(PointId(i + 1), points[i]);
  }
  static_cast<void>(m.live());
  m.update(), one.update();
  REQUIRE(m.mesh() == one.mesh());
  for (std::size_t i = 0; i < 20; ++i) {
    m.remove(PointId(i + 1)), one.remove(PointId(i + 1));
    m.update(), one.update();
  }
  REQUIRE(m.mesh() == one.mesh());
  m.check_invariants();
}

TEST_CASE("an update on several threads that is stopped, anywhere, is taken back") {
  const auto points = mesher::generate_points<2>(PointKind::uniform, 3000, 2);
  BoxMesher<2> m(options_for<2>(points, 3));
  const auto announce_all = [&] {
    for (std::size_t i = 0; i < points.size(); ++i) m.insert(PointId(i + 1), points[i]);
  };
  announce_all();
  for (const int after : {0, 1, 5}) {  // the first run
    int asked = 0;
    const RunControl control{.progress = [&](const Progress&) { return asked++ < after; },
                             .stop = {}};
    REQUIRE(error_of([&] { m.update(control); }).code() == ErrorCode::cancelled);
    REQUIRE(m.mesh().vertices.empty());
  }
  m.update();
  const Mesh<2> before = m.mesh();
  bool stopped = true;
  for (int after = 0; stopped && after < 40; after = 2 * after + 1) {
    CAPTURE(after);
    for (std::size_t i = 0; i < points.size(); i += 3) {
      m.move(PointId(i + 1), {points[i][0] * 0.99, points[i][1]});
    }
    int asked = 0;
    const RunControl control{.progress = [&](const Progress&) { return asked++ < after; },
                             .stop = {}};
    stopped = support::is_stopped(m, control, before);
  }
  struct Mine : std::runtime_error {
    Mine() : std::runtime_error("mine") {}
  };
  const Mesh<2> now = m.mesh();
  for (std::size_t i = 0; i < points.size(); i += 5) m.remove(PointId(i + 1));
  const RunControl throwing{.progress = [](const Progress&) -> bool { throw Mine(); }, .stop = {}};
  REQUIRE_THROWS_AS(m.update(throwing), Mine);
  REQUIRE(m.mesh() == now);
  m.remove(PointId{1});
  REQUIRE_THROWS_AS(m.update({}, [](const Change<2>&) { throw Mine(); }), Mine);
  REQUIRE(m.mesh() == now);
  m.check_invariants();
}

TEST_CASE("on several threads the number of vertices is limited as on one") {
  const auto points = mesher::generate_points<2>(PointKind::uniform, 200, 4);
  Options<2> options = options_for<2>(points, 3);
  BoxMesher<2> whole(options);
  for (std::size_t i = 0; i < points.size(); ++i) whole.insert(PointId(i + 1), points[i]);
  whole.update();
  const std::size_t most = whole.mesh().vertices.size();
  for (const std::size_t limit : {most, most - 1}) {
    options.max_vertices = limit;
    BoxMesher<2> m(options);
    for (std::size_t i = 0; i < points.size(); ++i) m.insert(PointId(i + 1), points[i]);
    if (limit < most) {
      REQUIRE(error_of([&] { m.update(); }).code() == ErrorCode::too_many);
      continue;
    }
    m.update();
    const Mesh<2> before = m.mesh();
    m.insert(PointId{1000}, {points[0][0] + 1e-5, points[0][1]});
    REQUIRE(error_of([&] { m.update(); }).code() == ErrorCode::too_many);
    REQUIRE(m.mesh() == before);
    m.check_invariants();
  }
}

TEST_CASE("how many threads there may be, and lines from the first update on") {
  Options<2> options{.domain = {{0, 0}, {1, 1}}, .threads = 2};
  const auto code = [](auto&& run) { return error_of(run).code(); };
  for (const int threads : {0, -1, mesher::kMostThreads + 1}) {
    options.threads = threads;
    REQUIRE(code([&] { BoxMesher<2> m(options); }) == ErrorCode::bad_option);
  }
  options.threads = 2;
  BoxMesher<2> with_lines(options);  // from the first update on
  with_lines.insert(PointId{1}, {0.25, 0.25});
  with_lines.insert(PointId{2}, {0.75, 0.25});
  with_lines.insert_segment(LineId{1}, PointId{1}, PointId{2});
  with_lines.update();
  REQUIRE(with_lines.mesh().edges.size() > 0);
}

TEST_CASE("a mesher on several threads goes on with one when more than points come") {
  const auto points = mesher::generate_points<2>(PointKind::uniform, 60, 12);
  for (const bool limits : {false, true}) {
    Options<2> options = options_for<2>(points, 3);
    BoxMesher<2> m(options);
    options.threads = 1;
    BoxMesher<2> one(options);
    const auto both = [&](auto&& edit) { edit(m), edit(one); };
    both([&](BoxMesher<2>& some) {
      for (std::size_t i = 0; i < points.size(); ++i) some.insert(PointId(i + 1), points[i]);
      some.update();
    });
    both([](BoxMesher<2>& some) { static_cast<void>(some.live()); });
    const Mesh<2> before = m.mesh();
    const auto announce = [&](BoxMesher<2>& some) {
      some.remove(PointId{1});
      some.move(PointId{2}, {0.5, 0.5});
      some.insert(PointId{100}, {0.25, 0.75});
      if (limits) {
        some.limit({.max_measure = 0.004});
      } else {
        some.insert_segment(LineId{1}, PointId{2}, PointId{100});
      }
    };
    announce(m);  // stopped, and taken back
    const RunControl control{.progress = [](const Progress&) { return false; }, .stop = {}};
    REQUIRE(error_of([&] { m.update(control); }).code() == ErrorCode::cancelled);
    REQUIRE(m.mesh() == before);
    m.check_invariants();
    m.discard_edits();
    both(announce);
    const Change<2> change = m.update();
    REQUIRE(is_same(change, one.update()));
    REQUIRE(m.mesh() == one.mesh());
    REQUIRE(m.points() == one.points());
    m.check_invariants();
    both([](BoxMesher<2>& some) { some.remove(PointId{3}); });
    REQUIRE(is_same(m.update(), one.update()));
    REQUIRE(m.mesh() == one.mesh());
    m.check_invariants();
  }
}

namespace {

// Four points move in the plane, in two tiles.
struct World {
  std::vector<Point<2>> points = mesher::generate_points<2>(PointKind::uniform, 12, 6);
  BoxMesher<2> m{options_for<2>(points, 2)};
  Mesh<2> before;
  World() {
    for (std::size_t i = 0; i < points.size(); ++i) m.insert(PointId(i + 1), points[i]);
    m.update();
    before = m.mesh();
  }
  void announce() {
    for (std::size_t i = 0; i < 4; ++i) m.move(PointId(i + 1), {points[i][1], points[i][0]});
  }
};

}  // namespace

TEST_CASE("on several threads an update in which an allocation fails leaves the mesh") {
  support::check_failing_updates<World>();
}

// --- The certificate -------------------------------------------------------------------------

namespace {

using Tile = mesher::detail::TileMesher<2>;

// Two tiles that exchange all messages but one. Returns what the certificate says.
std::string fault_without(std::size_t lost, std::size_t& messages) {
  const auto points = mesher::generate_points<2>(PointKind::uniform, 60, 11);
  const Options<2> options = options_for<2>(points, 2);
  const auto box = mesher::detail::mesh_box(options);
  const mesher::detail::Territories<2> all(points, 2);
  Tile a(options, box, all, 0), b(options, box, all, 1);
  mesher::detail::VertexPool<2> pool;
  mesher::detail::FeatureTree<2> features(box, pool);
  for (const auto& p : points) features.insert_only(pool.create(p));
  std::vector<Tile::Edit> edits[2];
  pool.for_each([&](const mesher::detail::Vertex<2>& v) {
    edits[all.owner(v.p)].push_back({v.p, std::nullopt, Tile::Located(features.crowded_level(v))});
  });
  a.edit(edits[0]), b.edit(edits[1]);
  return support::fault_without<2>(a, b, lost, messages, [](const auto&) {});
}

}  // namespace

TEST_CASE("the certificate of two tiles sees each message that is lost") {
  std::size_t all = 0;
  REQUIRE(fault_without(~std::size_t{0}, all).empty());
  REQUIRE(all > 100);
  std::size_t messages = 0;
  CHECK(noticed(all, 7, [&](std::size_t lost) { return fault_without(lost, messages); }) > 0.7);
}

TEST_CASE("an update of many times the calls that there are is given up, and done anew in tiles") {
  const auto points = mesher::generate_points<2>(PointKind::uniform, 24000, 3);
  BoxMesher<2> many(options_for<2>(points, 2)), one(options_for<2>(points, 1));
  const auto insert = [&](std::size_t from, std::size_t to) {
    for (auto* m : {&many, &one}) {
      for (std::size_t i = from; i < to; ++i) m->insert(PointId(i + 1), points[i]);
    }
  };
  insert(0, 100);
  many.update(), one.update();
  insert(100, points.size());
  std::vector<mesher::Phase> phases;
  RunControl control;
  control.progress = [&](const Progress& p) {
    if (phases.empty() || phases.back() != p.phase) phases.push_back(p.phase);
    return true;
  };
  const Change<2> change = many.update(control), expected = one.update();
  CHECK(is_same(change, expected));
  CHECK(many.mesh() == one.mesh());
  CHECK(support::is_tiled(many));
  REQUIRE(phases.size() > 2);
  CHECK(phases.front() == mesher::Phase::update);
  CHECK(phases.back() != mesher::Phase::update);
  many.check_invariants();
}
