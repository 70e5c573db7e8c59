// A field is carried through updates: what stays keeps its value, new vertices get values from the
// mesh before, which is exact for linear fields.
#include "mesher/transfer.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <set>

#include "feature_ids.hpp"
#include "mesher/extra/generate.hpp"

using support::id;

namespace {

template <int D>
double linear(const mesher::Point<D>& p) {
  double value = 0.5;
  for (std::size_t i = 0; i < D; ++i) value += static_cast<double>(i + 1) * p[i];
  return value;
}

template <int D>
class Field {
 public:
  explicit Field(mesher::Mesher<D>& m) : m_(m) {}

  void update() {
    const mesher::DomainUpdate<D> change = m_.update();
    const mesher::LiveMesh<D> live = m_.live();
    const std::vector<double> before = values_;
    values_.resize(live.vertex_slots(), std::nan(""));
    const auto all = mesher::Transfer<D>(change, live).interpolation();
    REQUIRE(all.size() == change.slots.vertices_added.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      REQUIRE(all[i].vertex == change.slots.vertices_added[i]);
      values_[all[i].vertex] =
          before.empty() ? linear<D>(live.points()[all[i].vertex]) : interpolated(all[i], before);
    }
    for (mesher::Slot v = 0; v < values_.size(); ++v) {
      if (live.is_vertex(v)) CHECK(values_[v] == Approx(linear<D>(live.points()[v])).margin(1e-9));
    }
  }

 private:
  static double interpolated(const mesher::Interpolated<D>& v, const std::vector<double>& before) {
    double value = 0, sum = 0;
    for (std::size_t i = 0; i <= D; ++i) {
      REQUIRE(v.from[i] < before.size());
      CHECK(v.weights[i] >= 0);
      value += v.weights[i] * before[v.from[i]];
      sum += v.weights[i];
    }
    CHECK(sum == Approx(1));
    return value;
  }

  mesher::Mesher<D>& m_;
  std::vector<double> values_;
};

template <int D>
void follow_edits(int points, int steps) {
  mesher::Box<D> unit;
  unit.hi.fill(1);
  mesher::Mesher<D> m({.domain = unit});
  m.keep_slots(true);
  Field<D> field(m);
  mesher::SplitMix64 random(7);
  const auto place = [&] {
    mesher::Point<D> p;
    for (double& x : p) x = 0.1 + 0.8 * random.unit();
    return p;
  };
  for (int i = 0; i < points; ++i) m.insert(id(i), place());
  field.update();
  for (int i = 0; i < steps; ++i) {
    m.remove(id(i));
    m.insert(id(1000 + i), place());
    for (int k = 1; k <= i % 3; ++k) m.move(id(steps + k), place());
    field.update();
  }
}

}  // namespace

TEST_CASE("a linear field is carried through edits of points in the plane") {
  follow_edits<2>(60, 25);
}
TEST_CASE("a linear field is carried through edits of points in space") { follow_edits<3>(40, 8); }

TEST_CASE("after the first update there is nothing to interpolate from") {
  mesher::Mesher<2> m({.domain = {{0, 0}, {1, 1}}});
  m.keep_slots(true);
  m.insert(id(1), {0.5, 0.5});
  const auto change = m.update();
  for (const auto& v : mesher::Transfer<2>(change, m.live()).interpolation()) {
    CHECK(v.from[0] == mesher::kNoSlot);
    CHECK(v.weights[0] == 0);
  }
}

TEST_CASE("features are found by id as of the last update, with their markers") {
  mesher::Mesher<3> m({.domain = {{0, 0, 0}, {4, 4, 4}}});
  m.insert(id(1), {1, 1, 1}, 5);
  m.insert(id(2), {2, 1, 1});
  m.insert(id(3), {2, 2, 1});
  m.insert_polyline(mesher::LineId{7}, {id(1), id(2), id(3)}, 9);
  m.insert_polygon({.id = mesher::PolygonId{4}, .loops = {{id(1), id(2), id(3)}}, .marker = 6});
  m.insert_region(8, {1.5, 1.2, 2}, 3.5);
  CHECK_FALSE(m.point(id(1)));
  m.update();
  m.move(id(1), {1, 1, 1.5});
  m.remove_line(mesher::LineId{7});
  CHECK(m.point(id(1)) == mesher::GraphPoint<3>{id(1), {1, 1, 1}, 5});
  CHECK_FALSE(m.point(id(4)));
  REQUIRE(m.line(mesher::LineId{7}));
  CHECK(m.line(mesher::LineId{7})->points == std::vector<mesher::PointId>{id(1), id(2), id(3)});
  CHECK(m.line(mesher::LineId{7})->marker == 9);
  REQUIRE(m.polygon(mesher::PolygonId{4}));
  CHECK(m.polygon(mesher::PolygonId{4})->marker == 6);
  REQUIRE(m.seed(mesher::region_id(8)));
  CHECK(m.seed(mesher::region_id(8))->attribute == 3.5);
  CHECK_FALSE(m.seed(mesher::hole_id(8)));
}
