// Meshers of points and lines in the plane on several threads: at every step the mesh, the change
// and the errors are those of one thread, whatever happens on the way.
#include <algorithm>
#include <catch2/catch.hpp>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "by_threads.hpp"
#include "facade/box_mesher.hpp"
#include "facade/tiled_plane_state.hpp"
#include "failing_update.hpp"
#include "mesher/extra/generate.hpp"
#include "program/plane_input.hpp"
#include "program/world_impl.hpp"
#include "rules/mesh_box.hpp"

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
using mesher::Progress;
using mesher::PslgFamily;
using mesher::PslgKind;
using mesher::RunControl;
using mesher::SplitMix64;
using support::is_same;
using support::is_tiled;
using support::noticed;
using support::said;

Options<2> options_for(int threads, double rho = Options<2>().rho) {
  return {.domain = {{0, 0}, {1, 1}}, .rho = rho, .threads = threads};
}

// The same edits of two meshers, one of which has several threads.
class Pair {
 public:
  Pair(const Graph<2>& graph, int threads, double rho = Options<2>().rho)
      : many_(options_for(threads, rho)), one_(options_for(1, rho)) {
    for (const auto& p : graph.points) insert(p.id, p.at);
    for (const auto& s : graph.segments) insert_line(s.id, {s.from, s.to});
    for (const auto& l : graph.polylines) insert_line(l.id, l.points);
    update();
  }

  bool insert(PointId id, const Point<2>& p) {
    next_ = std::max(next_, static_cast<std::int64_t>(id) + 1);
    try {
      many_.insert(id, p);
    } catch (const mesher::Error&) {
      return false;  // the place is taken
    }
    one_.insert(id, p);
    return true;
  }
  void insert_line(LineId id, const std::vector<PointId>& points) {
    next_line_ = std::max(next_line_, static_cast<std::int64_t>(id) + 1);
    many_.insert_polyline(id, points);
    one_.insert_polyline(id, points);
  }
  std::optional<PointId> any_point(SplitMix64& random) const {
    const auto all = one_.points();
    if (all.empty()) return std::nullopt;
    return all[random.below(all.size())].id;
  }
  std::optional<LineId> any_line(SplitMix64& random) const {
    const auto all = one_.lines();
    if (all.empty()) return std::nullopt;
    return all[random.below(all.size())].id;
  }
  // One announcement at random; what is refused at once is refused by both.
  void announce(SplitMix64& random) {
    const auto both = [&](auto&& edit) {
      std::string a, b;
      try {
        edit(many_);
      } catch (const mesher::Error& e) {
        a = said(e);
      }
      try {
        edit(one_);
      } catch (const mesher::Error& e) {
        b = said(e);
      }
      REQUIRE(a == b);
    };
    const Point<2> p{random.unit(), random.unit()};
    const double step = random.below(2) == 0 ? 0.02 : 0.2;
    switch (random.below(8)) {
      case 0:
        if (const auto id = any_point(random)) both([&](auto& m) { m.remove(*id); });
        break;
      case 1:
      case 2:
        if (const auto id = any_line(random)) both([&](auto& m) { m.remove_line(*id); });
        break;
      case 3:
        if (const auto id = any_point(random)) {
          Point<2> to = one_.point(*id)->at;
          for (double& x : to) x = std::clamp(x + step * (random.unit() - 0.5), 0.0, 1.0);
          both([&](auto& m) { m.move(*id, to); });
        }
        break;
      case 4:
        insert(PointId{next_}, p);
        break;
      case 5: {  // between points that are there
        const auto a = any_point(random), b = any_point(random);
        if (a && b && *a != *b) {
          const LineId id{next_line_++};
          both([&](auto& m) { m.insert_segment(id, *a, *b); });
        }
        break;
      }
      default: {  // short, and new
        const PointId a{next_}, b{next_ + 1};
        const Point<2> q{std::clamp(p[0] + step * (random.unit() - 0.5), 0.0, 1.0),
                         std::clamp(p[1] + step * (random.unit() - 0.5), 0.0, 1.0)};
        if (!insert(a, p) || !insert(b, q)) break;
        insert_line(LineId{next_line_}, {a, b});
      }
    }
  }
  // Both refuse in the same words, or both do it and are equal.
  bool update() {
    std::string refused, refused_by_one;
    Change<2> change, expected;
    try {
      expected = one_.update();
    } catch (const mesher::Error& e) {
      refused_by_one = said(e);
    }
    try {
      change = many_.update();
    } catch (const mesher::Error& e) {
      refused = said(e);
    }
    REQUIRE(refused == refused_by_one);
    REQUIRE(many_.mesh() == one_.mesh());
    REQUIRE(is_same(change, expected));
    REQUIRE(many_.stats().vertices == one_.stats().vertices);
    REQUIRE(many_.stats().simplices == one_.stats().simplices);
    if (is_always_tiled && many_.size() > 1) REQUIRE(is_tiled(many_));
    return refused.empty();
  }
  void check() const {
    many_.check_invariants();
    REQUIRE(many_.points() == one_.points());
    REQUIRE(many_.lines() == one_.lines());
  }
  bool is_always_tiled = true;

  BoxMesher<2>& many() { return many_; }
  BoxMesher<2>& one() { return one_; }

 private:
  BoxMesher<2> many_, one_;
  std::int64_t next_ = 1, next_line_ = 1;
};

void check_edits(const PslgFamily& family, int threads, int steps, double rho = Options<2>().rho) {
  CAPTURE(static_cast<int>(family.kind), family.n, family.seed, threads, rho);
  SplitMix64 random(family.seed + 77);
  Pair pair(mesher::generate_pslg(family), threads, rho);
  pair.check();
  int done = 0;
  for (int step = 0; step < steps; ++step) {
    CAPTURE(step);
    for (std::uint64_t i = 1 + random.below(3); i > 0; --i) pair.announce(random);
    done += pair.update();
    if (step % 8 == 7) pair.check();
  }
  pair.check();
  CHECK((steps < 8 || done > 0));
}

constexpr PslgKind kFamilies[] = {PslgKind::segments, PslgKind::lengths,   PslgKind::polylines,
                                  PslgKind::trees,    PslgKind::corridors, PslgKind::zigzag,
                                  PslgKind::fan,      PslgKind::bundle};

}  // namespace

TEST_CASE("with lines, on several threads every update is that of one") {
  std::uint64_t seed = 1;
  for (const PslgKind kind : kFamilies) {
    const std::size_t n = kind == PslgKind::fan || kind == PslgKind::bundle ? 12 : 40;
    check_edits({kind, n, seed}, seed % 2 == 0 ? 2 : 5, 16);
    ++seed;
  }
}
TEST_CASE("soak: with lines, on several threads every update is that of one", "[.soak][soak]") {
  std::uint64_t seed = 20;
  for (const PslgKind kind : kFamilies) {
    for (const int threads : {2, 3, 5, 8}) {
      const std::size_t n = kind == PslgKind::fan || kind == PslgKind::bundle ? 12 : 40;
      check_edits({kind, n, seed++}, threads, 16);
    }
  }
}

TEST_CASE("with lines, on several threads every update is that of one, whatever rho is") {
  std::uint64_t seed = 100;
  for (const double rho : {1.05, 1.2, 3.0, 10.0}) {
    for (const PslgKind kind : {PslgKind::segments, PslgKind::trees, PslgKind::fan}) {
      check_edits({kind, 14, seed++}, 3, 8, rho);
    }
  }
}

TEST_CASE("many lines, and small angles, on several threads") {
  for (const PslgKind kind : {PslgKind::segments, PslgKind::polylines, PslgKind::trees}) {
    check_edits({kind, 500, 7}, 4, 24);
  }
  for (const double angle : {0.001, 0.5, 5.0}) {
    check_edits({PslgKind::bundle, 6, 3, angle}, 3, 8);
    check_edits({PslgKind::fan, 6, 3, angle}, 2, 8);
  }
}

TEST_CASE("lines come to a mesher of points on several threads, and all go again") {
  for (const int threads : {2, 5}) {
    SplitMix64 random(5);
    Graph<2> points;
    for (int i = 1; i <= 80; ++i) {
      points.points.push_back({PointId{i}, {random.unit(), random.unit()}});
    }
    Pair pair(points, threads);
    pair.insert_line(LineId{1}, {PointId{1}, PointId{2}});
    pair.update();
    for (int i = 0; i < 60; ++i) pair.announce(random);
    pair.update();
    pair.check();
    for (const auto& line : pair.one().lines()) {
      pair.many().remove_line(line.id), pair.one().remove_line(line.id);
    }
    REQUIRE(pair.update());
    pair.check();
    for (const auto& p : pair.one().points()) pair.many().remove(p.id), pair.one().remove(p.id);
    REQUIRE(pair.update());
    pair.check();
  }
}

TEST_CASE("what is near lines is known again after an update that is refused") {
  Pair pair(mesher::generate_pslg({PslgKind::fan, 12, 47}), 2);
  for (auto* m : {&pair.many(), &pair.one()}) m->remove_line(LineId{3}), m->remove(PointId{1});
  REQUIRE_FALSE(pair.update());  // the point is an end of others
  pair.check();
  for (auto* m : {&pair.many(), &pair.one()}) m->insert(PointId{50}, {0.4018, 0.712});
  REQUIRE(pair.update());
  pair.check();
}

TEST_CASE("lines that get another id, in the place where they were") {
  Pair pair(mesher::generate_pslg({PslgKind::segments, 30, 9}), 3);
  SplitMix64 random(9);
  for (int step = 0; step < 8; ++step) {
    const auto line = *pair.any_line(random);
    const std::vector<PointId> points = pair.one().line(line)->points;
    pair.many().remove_line(line), pair.one().remove_line(line);
    pair.insert_line(LineId{1000 + step}, {points.rbegin(), points.rend()});
    if (step % 2 == 0) pair.insert(PointId{5000 + step}, {random.unit(), random.unit()});
    pair.update();
    pair.check();
  }
}

TEST_CASE("many lines that go and come in one update, on several threads") {
  const Graph<2> graph = mesher::generate_pslg({PslgKind::segments, 300, 21});
  for (const int threads : {2, 4}) {
    Pair pair(graph, threads);
    for (const std::size_t step : {3, 2, 1}) {
      for (std::size_t i = 0; i < graph.segments.size(); i += step) {
        const LineId id = graph.segments[i].id;
        pair.many().remove_line(id), pair.one().remove_line(id);
      }
      REQUIRE(pair.update());
      pair.check();
      for (std::size_t i = 0; i < graph.segments.size(); i += step) {
        const auto& s = graph.segments[i];
        pair.insert_line(s.id, {s.from, s.to});
      }
      REQUIRE(pair.update());
      pair.check();
    }
  }
}

TEST_CASE(
    "small angles of a line with itself that are equal, at one point, are told in one order") {
  Graph<2> star;
  const PointId hub{1};
  star.points.push_back({hub, {0.5, 0.5}});
  std::vector<PointId> line;
  for (int k = 0; k < 12; ++k) {  // three legs beside each half-axis, which is as long as none else
    const double length = 0.25 / (1 << k / 3), side = length / 8 * (k % 3 - 1);
    const double x[] = {length, -side, -length, side}, y[] = {side, length, -side, -length};
    const PointId end{2 + k};
    star.points.push_back({end, {0.5 + x[k / 3], 0.5 + y[k / 3]}});
    if (k % 2 == 0) line.push_back(hub);
    line.push_back(end);
  }
  line.push_back(hub);
  star.polylines.push_back({LineId{1}, line});
  for (const int threads : {2, 3}) {
    Pair pair(star, threads);
    SplitMix64 random(4);
    for (int step = 2; step < 8; ++step) {
      pair.many().remove_line(LineId{step - 1}), pair.one().remove_line(LineId{step - 1});
      pair.insert(PointId{100 + step}, {random.unit(), random.unit()});
      if (step % 2 == 0) REQUIRE(pair.update());
      pair.insert_line(LineId{step}, line);
      REQUIRE(pair.update());
      pair.check();
    }
  }
}

TEST_CASE("on several threads what is wrong with lines is said as on one") {
  Pair pair(mesher::generate_pslg({PslgKind::segments, 40, 4}), 3);
  const auto both = [&](auto&& edit) { edit(pair.many()), edit(pair.one()); };
  const auto refused = [&] {
    REQUIRE_FALSE(pair.update());
    pair.check();
  };
  const auto corners = [](auto& m) {
    m.insert(PointId{901}, {0.001, 0.001}), m.insert(PointId{902}, {0.999, 0.998});
    m.insert(PointId{903}, {0.002, 0.997}), m.insert(PointId{904}, {0.998, 0.003});
  };
  both([&](auto& m) {  // they cross
    corners(m);
    m.insert_segment(LineId{901}, PointId{901}, PointId{902});
    m.insert_segment(LineId{902}, PointId{903}, PointId{904});
  });
  refused();
  both([](auto& m) { m.remove(PointId{1}); });  // an end
  refused();
  both([](auto& m) { m.insert_segment(LineId{905}, PointId{1}, PointId{12345}); });
  refused();
  both([](auto& m) {  // a point on a segment
    m.insert(PointId{906}, {0.001, 0.5}), m.insert(PointId{907}, {0.001, 0.501});
    m.insert(PointId{908}, {0.001, 0.5005});
    m.insert_segment(LineId{906}, PointId{906}, PointId{907});
  });
  refused();
  both([](auto& m) {  // a point too near to a segment
    m.insert(PointId{909}, {0.001, 0.5}), m.insert(PointId{910}, {0.001, 0.501});
    m.insert(PointId{911}, {0.001 + 0x1p-46, 0.50052});
    m.insert_segment(LineId{907}, PointId{909}, PointId{910});
  });
  refused();
}

TEST_CASE("a first run with lines that is refused on several threads") {
  int refused = 0;
  for (const double gap : {0x1p-20, 0x1p-40, 0x1p-44, 0x1p-45, 0x1p-46, 0x1p-47, 0x1p-48}) {
    CAPTURE(gap);
    const auto run = [&](int threads) {
      BoxMesher<2> m(options_for(threads));
      m.insert(PointId{1}, {0.25, 0.25}), m.insert(PointId{2}, {0.75, 0.25});
      m.insert(PointId{3}, {0.503, 0.25 + gap}), m.insert(PointId{4}, {0.5, 0.75});
      m.insert_segment(LineId{1}, PointId{1}, PointId{2});
      try {
        m.update();
      } catch (const mesher::Error& e) {
        return std::pair(said(e), m.mesh());
      }
      return std::pair(std::string(), m.mesh());
    };
    const auto expected = run(1);
    REQUIRE(run(3) == expected);
    refused += !expected.first.empty();
  }
  CHECK(refused > 0);
}

namespace {

// Lines move in two tiles.
struct LineWorld {
  BoxMesher<2> m{options_for(2)};
  Mesh<2> before;
  LineWorld() {
    const Graph<2> graph = mesher::generate_pslg({PslgKind::segments, 4, 6});
    for (const auto& p : graph.points) m.insert(p.id, p.at);
    for (const auto& s : graph.segments) m.insert_segment(s.id, s.from, s.to);
    m.update();
    before = m.mesh();
  }
  void announce() {
    const auto lines = m.lines();
    m.remove_line(lines[0].id);
    const Point<2> p = m.point(lines[1].points[0])->at;
    m.move(lines[1].points[0], {p[0] + 0.01, p[1]});
    m.insert(PointId{101}, {0.02, 0.97}), m.insert(PointId{102}, {0.98, 0.96});
    m.insert_segment(LineId{101}, PointId{101}, PointId{102});
  }
};

}  // namespace

TEST_CASE("with lines, on several threads an update in which an allocation fails leaves the mesh") {
  support::check_failing_updates<LineWorld>(support::SeeMesh{}, 7);
}
TEST_CASE("soak: with lines, the same for every allocation", "[.soak][soak]") {
  support::check_failing_updates<LineWorld>();
}

TEST_CASE("with lines, an update on several threads that is stopped, anywhere, is taken back") {
  const Graph<2> graph = mesher::generate_pslg({PslgKind::polylines, 400, 2});
  BoxMesher<2> m(options_for(3));
  const auto announce_all = [&] {
    for (const auto& p : graph.points) m.insert(p.id, p.at);
    for (const auto& s : graph.segments) m.insert_segment(s.id, s.from, s.to);
    for (const auto& l : graph.polylines) m.insert_polyline(l.id, l.points);
  };
  const auto stop_after = [](int after) {
    return RunControl{.progress = [left = after](const Progress&) mutable { return left-- > 0; },
                      .stop = {}};
  };
  announce_all();
  for (const int after : {0, 1, 3}) {  // the first run; edits stay announced
    try {
      m.update(stop_after(after));
      FAIL("it was not stopped");
    } catch (const mesher::Error& e) {
      REQUIRE(e.code() == ErrorCode::cancelled);
    }
    REQUIRE(m.mesh().vertices.empty());
  }
  m.update();
  const Mesh<2> before = m.mesh();
  bool stopped = true;
  for (int after = 0; stopped && after < 60; after = 2 * after + 1) {
    CAPTURE(after);
    for (std::size_t i = 0; i < graph.polylines.size(); i += 2) {
      m.remove_line(graph.polylines[i].id);
    }
    for (std::size_t i = 0; i < graph.segments.size(); i += 2) {
      m.remove_line(graph.segments[i].id);
    }
    stopped = support::is_stopped(m, stop_after(after), before);
  }
  struct Mine : std::runtime_error {
    Mine() : std::runtime_error("mine") {}
  };
  const Mesh<2> now = m.mesh();
  m.insert(PointId{100000}, {0.123, 0.456});
  REQUIRE_THROWS_AS(m.update({}, [](const Change<2>&) { throw Mine(); }), Mine);
  REQUIRE(m.mesh() == now);
  m.check_invariants();
}

TEST_CASE("with lines, on several threads the number of vertices is limited as on one") {
  const Graph<2> graph = mesher::generate_pslg({PslgKind::trees, 60, 4});
  const auto run = [&](int threads, std::size_t most) {
    Options<2> options = options_for(threads);
    options.max_vertices = most;
    BoxMesher<2> m(options);
    for (const auto& p : graph.points) m.insert(p.id, p.at);
    for (const auto& s : graph.segments) m.insert_segment(s.id, s.from, s.to);
    for (const auto& l : graph.polylines) m.insert_polyline(l.id, l.points);
    try {
      m.update();
    } catch (const mesher::Error& e) {
      return std::pair(std::size_t{0}, said(e));
    }
    return std::pair(m.mesh().vertices.size(), std::string());
  };
  const std::size_t most = run(1, 0).first;
  for (const std::size_t limit : {most, most - 1, most / 2}) {
    REQUIRE(run(3, limit) == run(1, limit));
  }
}

// --- The certificate -------------------------------------------------------------------------

namespace {

using Tile = mesher::detail::TileMesher<2>;
using Message = mesher::detail::Message<2>;

struct SplitAll {
  static constexpr std::string_view kName = "split";
  void operator()(sac::Scope& s) const {
    s.environment<mesher::detail::World<sac::Scope, 2>>().splits.drain(s);
  }
};
inline constexpr SplitAll split_all{};

// Points and segments, split; and what two tiles are told of them.
struct SplitInput : mesher::detail::Names {
  Options<2> options = options_for(2);
  mesher::detail::MeshBox<2> box = mesher::detail::mesh_box(options);
  sac::Engine engine;
  mesher::detail::World<sac::Scope, 2> world{options, box, engine};
  std::vector<Point<2>> places;

  explicit SplitInput(const Graph<2>& graph) {
    world.locates = false;
    std::map<PointId, mesher::detail::VertexHandle> handles;
    for (const auto& p : graph.points) {
      auto& v = world.vertices.add_input(p.at, true);
      world.features.insert_first(v);
      handles[p.id] = v.self;
    }
    for (const auto& s : graph.segments) {
      static_cast<void>(
          mesher::detail::add_segment(world, s.id, handles.at(s.from), handles.at(s.to), *this));
    }
    engine.run<split_all>();
    for_each_feature([&](const auto& v) { places.push_back(v.p); });
  }
  template <class Visit>
  void for_each_feature(Visit&& visit) {
    world.vertices.pool().for_each([&](auto& v) {
      if (!v.boundary && world.features.has(v)) visit(v);
    });
  }
  [[nodiscard]] PointId point(mesher::detail::VertexHandle) const override { return {}; }
  [[nodiscard]] LineId line(mesher::detail::SegmentHandle) const override { return {}; }

  void tell(Tile& tile, const mesher::detail::Territories<2>& all, std::size_t self) {
    std::vector<Tile::Edit> edits;
    mesher::detail::FeatureTree<2>::Path path;
    for_each_feature([&](auto& v) {
      world.features.find_level(v, path);
      if (!all.owns(self, v.p)) return;
      edits.push_back({v.p, std::nullopt,
                       Tile::Located(v.level, world.limits.pitch(v.p), world.vertices.role(v))});
    });
    const auto common = std::make_shared<mesher::detail::CommonOrders<2>>();
    auto& lines = common->lines;
    world.segments.pool().for_each([&](const auto& s) {
      lines.segments.push_back({s.self, s.a, s.b, std::nullopt, world.segments.zones(s)});
    });
    world.leaves.for_each([&](const auto& leaf) { lines.leaves.push_back({leaf.piece, true}); });
    tile.edit_common(common);
    tile.edit(edits);
  }
};

// Two tiles that exchange all messages but one. Returns what the certificate says.
std::string fault_without(std::size_t lost, std::size_t& messages, std::size_t& cuts) {
  SplitInput input(mesher::generate_pslg({PslgKind::segments, 20, 3}));
  const mesher::detail::Territories<2> all(input.places, 2);
  const mesher::detail::WholeInput<2> whole{&input.world.vertices.pool(), nullptr};
  Tile a(input.options, input.box, all, 0, whole), b(input.options, input.box, all, 1, whole);
  input.tell(a, all, 0), input.tell(b, all, 1);
  cuts = 0;
  return support::fault_without<2>(a, b, lost, messages, [&](const Message& message) {
    cuts += message.kind >= Message::Kind::cut;
  });
}

}  // namespace

TEST_CASE("with lines the certificate of two tiles sees each message that is lost") {
  std::size_t all = 0, cuts = 0;
  REQUIRE(fault_without(~std::size_t{0}, all, cuts).empty());
  REQUIRE(all > 100);
  REQUIRE(cuts > 3);
  std::size_t messages = 0;
  CHECK(noticed(all, 3, [&](std::size_t lost) { return fault_without(lost, messages, cuts); }) >
        0.6);
}
