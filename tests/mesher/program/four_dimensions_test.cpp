// The program of points at d = 4: what it makes is complete, by a judge that has its vertices
// alone, and after edits it is what a fresh run makes.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "brute_balls.hpp"
#include "program/world_impl.hpp"
#include "rules/mesh_box.hpp"
#include "sac/sac.hpp"

namespace {

using namespace mesher::detail;
using mesher::Options;
using mesher::Point;
// The side of the domain: an eighth of the box's, whose boundary then has the fewest vertices.
constexpr double kSide = 0.51;
using Simplex = std::array<Point<4>, 5>;

Options<4> options_for(mesher::Rule rule, double rho) {
  Options<4> options;
  options.rule = rule;
  options.rho = rho;
  options.domain.lo.fill(0);
  options.domain.hi.fill(kSide);
  return options;
}

// What a run makes: its vertices, and the corners of simplices; both ascending.
struct Result {
  std::vector<Point<4>> vertices;
  std::vector<Simplex> simplices;
  friend bool operator==(const Result&, const Result&) = default;
};

template <class World, class Simplices>
Result result_of(const World& world, const Simplices& simplices) {
  Result result;
  const auto& pool = world.vertices.pool();
  pool.for_each([&](const Vertex<4>& v) {
    if (v.alive) result.vertices.push_back(v.p);
  });
  for (const auto& s : simplices) {
    Simplex corners;
    for (std::size_t i = 0; i < 5; ++i) corners[i] = pool[s[i]].p;
    std::sort(corners.begin(), corners.end());
    result.simplices.push_back(corners);
  }
  std::sort(result.vertices.begin(), result.vertices.end());
  std::sort(result.simplices.begin(), result.simplices.end());
  return result;
}

Result fresh(const std::vector<Point<4>>& points, const Options<4>& options) {
  const MeshBox<4> box = mesh_box(options);
  sac::PlainScope s;
  World<sac::PlainScope, 4> world(options, box, s);
  for (const Point<4>& p : points) {
    Vertex<4>& v = world.vertices.add_input(p, true);
    world.features.tree().insert_only(v);
    world.quadtree.post_from_outside<locate>(locate_key(box.fixed(p)), VertexRef<4>{&v});
  }
  s.run<refine<4>>();
  return result_of(world, world.plain.simplices);
}

std::size_t boundary_vertices(const Options<4>& options) {
  std::size_t count = 0;
  mesh_box(options).for_each_boundary_point([&](const Point<4>&) { ++count; });
  return count;
}

// The program on an engine.
class Traced {
 public:
  explicit Traced(const Options<4>& options)
      : box_(mesh_box(options)),
        world_(std::make_unique<World<sac::Scope, 4>>(options, box_, *engine_)) {
    engine_->set_audit(true);
    engine_->run<refine<4>>();
    world_->vertices.commit();
  }
  Traced(const Traced&) = delete;
  Traced& operator=(const Traced&) = delete;
  ~Traced() { engine_.reset(); }  // before what its calls refer to

  Vertex<4>& insert(const Point<4>& p) {
    Vertex<4>& v = world_->vertices.add_input(p, false);
    world_->vertices.touch(v);
    world_->features.insert(v);
    world_->quadtree.post_from_outside<locate>(locate_key(box_.fixed(p)), VertexRef<4>{&v});
    return v;
  }
  void erase(Vertex<4>& v) {
    world_->vertices.touch(v);
    v.input = false;
    world_->features.erase(v);
    world_->quadtree.retract_from_outside<locate>(VertexRef<4>{&v});
  }
  sac::Counts update() {
    const sac::Counts counts = engine_->propagate();
    world_->vertices.commit();
    return counts;
  }
  [[nodiscard]] Result result() const {
    std::vector<std::array<VertexHandle, 5>> simplices;
    const auto& vertices = world_->vertices;
    vertices.pool().for_each([&](const Vertex<4>& v) {
      if (!v.alive) return;
      for_each_own_simplex(vertices.pool(), v, vertices.ring(v),
                           [&](const auto& s) { simplices.push_back(s); });
    });
    return result_of(*world_, simplices);
  }
  [[nodiscard]] sac::Engine& engine() { return *engine_; }
  [[nodiscard]] const World<sac::Scope, 4>& world() const { return *world_; }

 private:
  MeshBox<4> box_;
  std::unique_ptr<sac::Engine> engine_ = std::make_unique<sac::Engine>();
  std::unique_ptr<World<sac::Scope, 4>> world_;
};

// Points of which some are near each other.
std::vector<Point<4>> random_points(std::mt19937_64& random, int count) {
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<Point<4>> points;
  for (int i = 0; i < count; ++i) {
    Point<4> p;
    const bool near = i % 4 == 3;
    for (std::size_t k = 0; k < 4; ++k) {
      p[k] =
          near ? points.back()[k] + 0.01 * kSide * (unit() - 0.5) : kSide * (0.05 + 0.9 * unit());
    }
    points.push_back(p);
  }
  return points;
}

// 24 times the volume.
long double volume24(const Simplex& s) {
  std::array<std::array<long double, 4>, 4> m;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 4; ++k) m[i][k] = static_cast<long double>(s[i + 1][k]) - s[0][k];
  }
  return std::abs(determinant(m));
}

// The simplices fill the box, their balls are empty, and none is poor by `rho`.
void judge(const Result& result, const Options<4>& options) {
  const MeshBox<4> box = mesh_box(options);
  long double volume = 0;
  for (const Simplex& s : result.simplices) {
    volume += volume24(s);
    const auto ball = support::ball_of<4>(s);
    const auto is_outside = [&](const Point<4>& p) { return support::is_outside<4>(ball, p); };
    REQUIRE(std::all_of(result.vertices.begin(), result.vertices.end(), is_outside));
    long double shortest2 = INFINITY;
    for (std::size_t i = 0; i < 5; ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        long double length2 = 0;
        for (std::size_t j = 0; j < 4; ++j) {
          length2 += (static_cast<long double>(s[i][j]) - s[k][j]) *
                     (static_cast<long double>(s[i][j]) - s[k][j]);
        }
        shortest2 = std::min(shortest2, length2);
      }
    }
    REQUIRE(ball.radius2 <= shortest2 * options.rho * options.rho * (1 + 1e-9L));
  }
  const long double all = 24 * std::pow(static_cast<long double>(box.side), 4);
  REQUIRE(std::abs(volume - all) <= 1e-9L * all);
}

}  // namespace

TEST_CASE("in four dimensions every simplex is Delaunay and not poor, and they fill the box") {
  for (const auto& [rule, rho] :
       {std::pair(mesher::Rule::radius_edge, 4.0), std::pair(mesher::Rule::voronoi_aspect, 8.0)}) {
    std::mt19937_64 random(1);
    const auto options = options_for(rule, rho);
    const auto points = random_points(random, 40);
    const Result result = fresh(points, options);
    for (const Point<4>& p : points) {
      CHECK(std::binary_search(result.vertices.begin(), result.vertices.end(), p));
    }
    CHECK(result.vertices.size() > boundary_vertices(options) + points.size());
    judge(result, options);
  }
}

TEST_CASE("in four dimensions the mesh after random edits is a fresh run's") {
  const auto options = options_for(mesher::Rule::radius_edge, 16);
  std::mt19937_64 random(2);
  std::vector<Point<4>> points = random_points(random, 50);
  Traced traced(options);
  std::vector<std::pair<Point<4>, Vertex<4>*>> there;
  for (int update = 0; update < 3; ++update) {
    INFO("update " << update);
    for (int n = update == 0 ? 30 : 4; n > 0; --n) {
      if (update > 0 && n % 2 == 0) {
        const std::size_t i = random() % there.size();
        traced.erase(*there[i].second);
        there.erase(there.begin() + static_cast<std::ptrdiff_t>(i));
      } else {
        there.emplace_back(points.back(), &traced.insert(points.back()));
        points.pop_back();
      }
    }
    traced.update();
    std::vector<Point<4>> places;
    for (const auto& item : there) places.push_back(item.first);
    REQUIRE(traced.result() == fresh(places, options));
  }
  CHECK(traced.result().vertices.size() > boundary_vertices(options) + there.size());
  traced.world().vertices.check_invariants();
  CHECK(traced.engine().audit().first_duplicate == "");
  CHECK(traced.engine().audit().first_reordered == "");
}
