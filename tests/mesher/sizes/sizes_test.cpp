// Limits of size: how many vertices they take, and that nothing is larger.
#include "mesher/sizes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <set>

#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "geometry/centroid.hpp"
#include "geometry/plane_vectors.hpp"
#include "mesher/error.hpp"
#include "mesher/extra/generate.hpp"
#include "sized_square.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using support::SizedSquare;
using support::SizesInSquare;

Options<2> limited(double max_measure) {
  Options<2> options{.domain = SizedSquare::domain()};
  options.max_measure = max_measure;
  return options;
}
Options<2> sized(SizesInSquare sizes) {
  Options<2> options{.domain = SizedSquare::domain()};
  options.sizes = std::make_shared<SizesInSquare>(std::move(sizes));
  return options;
}

Mesh<2> square(const Options<2>& options) {
  return mesh_statically(SizedSquare::points(), SizedSquare::segments(), options);
}

long inside(const Mesh<2>& mesh) {
  return std::count_if(mesh.vertices.begin(), mesh.vertices.end(), SizedSquare::contains);
}

// Of triangles with their centroids where there is a limit: area over limit.
template <class Limit>
double largest(const Mesh<2>& mesh, Limit&& limit) {
  double most = 0;
  for (const auto& t : mesh.simplices) {
    const Point<2>&p = mesh.vertices[t[0]], &q = mesh.vertices[t[1]], &r = mesh.vertices[t[2]];
    const double area = ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2;
    most = std::max(most,
                    area / limit(mesher::detail::centroid(mesher::detail::CornersOf<2>{p, q, r})));
  }
  return most;
}
double area_of(double h) { return std::sqrt(3.0) / 4 * h * h; }

}  // namespace

TEST_CASE("A largest area takes no more vertices than the model, by 1.03 [rules A7]") {
  for (const auto& [area, model] :
       {std::pair(1e-4, 2732), std::pair(1e-4 / 4, 10352), std::pair(1e-4 / 16, 40282)}) {
    const Mesh<2> mesh = square(limited(area));
    INFO(area << ": " << inside(mesh) << " vertices, the model " << model);
    CHECK(static_cast<double>(inside(mesh)) <= 1.03 * model);
    CHECK(largest(mesh, [&, area = area](const Point<2>& p) {
            const bool counts = p[0] >= 0 && p[0] <= 1 && p[1] >= 0 && p[1] <= 1;
            return counts ? area : 1e300;
          }) <= 1);
  }
}

TEST_CASE("Sizes that vary take no more vertices than the model, by 1.03 [rules A7]") {
  const struct {
    Options<2> options;
    int model;
  } cases[] = {{sized(SizesInSquare::linear(1e-5, 0.05)), 3249},
               {sized(SizesInSquare::linear(1e-5 / 16, 0.05 / 4)), 46821},
               {sized(SizesInSquare::step(1e-5)), 4350},
               {sized(SizesInSquare::step(1e-5 / 16)), 66404}};
  for (const auto& c : cases) {
    const Mesh<2> mesh = square(c.options);
    INFO(inside(mesh) << " vertices, the model " << c.model);
    CHECK(static_cast<double>(inside(mesh)) <= 1.03 * c.model);
    CHECK(largest(mesh, [&](const Point<2>& p) { return area_of(c.options.sizes->at(p)); }) <= 1);
  }
}

TEST_CASE("Of two limits the smaller one counts") {
  Options<2> options = sized(SizesInSquare::linear(1e-4, 0.2));
  options.max_measure = 4e-4;
  const Mesh<2> mesh = square(options);
  CHECK(largest(mesh, [&](const Point<2>& p) {
          const bool counts = p[0] >= 0 && p[0] <= 1 && p[1] >= 0 && p[1] <= 1;
          return counts ? std::min(4e-4, area_of(options.sizes->at(p))) : 1e300;
        }) <= 1);
}

TEST_CASE("Plateaus of one size, and of sizes that round to one pitch, have one lattice") {
  class Halves final : public mesher::SizeField<2> {
   public:
    [[nodiscard]] double at(const Point<2>& p) const override {
      return p[0] < 0.5 ? 0.05 : 0.05 * (1 + 0x1p-40);
    }
    [[nodiscard]] mesher::SizeRange range(const mesher::Box<2>&) const override {
      return {0.05, 0.05 * (1 + 0x1p-40)};
    }
    [[nodiscard]] std::vector<double> plateaus() const override {
      return {0.05, 0.05 * (1 + 0x1p-40), 0.05};
    }
  };
  Options<2> options{.domain = SizedSquare::domain()};
  options.sizes = std::make_shared<Halves>();
  const Mesh<2> mesh = square(options);
  CHECK(largest(mesh, [&](const Point<2>& p) {
          const bool counts = p[0] >= 0 && p[0] <= 1 && p[1] >= 0 && p[1] <= 1;
          return counts ? area_of(options.sizes->at(p)) : 1e300;
        }) <= 1);
}

TEST_CASE("A limit that every triangle keeps changes nothing") {
  CHECK(square(limited(1e3)) == square({.domain = SizedSquare::domain()}));
}

TEST_CASE("A limit that makes no sense is refused") {
  const auto code = [](const Options<2>& options) {
    try {
      static_cast<void>(square(options));
    } catch (const mesher::Error& error) {
      return error.code();
    }
    return mesher::ErrorCode::cannot_read;
  };
  CHECK(code(limited(-1)) == mesher::ErrorCode::bad_option);
  CHECK(code(limited(std::nan(""))) == mesher::ErrorCode::bad_option);
  CHECK(code(limited(1e-30)) == mesher::ErrorCode::bad_option);
  CHECK(code(sized(SizesInSquare([](double) { return -1.0; }))) == mesher::ErrorCode::bad_option);
  CHECK(code(sized(SizesInSquare([](double) { return 1e-20; }))) == mesher::ErrorCode::bad_option);
  Options<2> few = limited(1e-9);
  few.max_vertices = 10000;
  CHECK(code(few) == mesher::ErrorCode::too_many);
}

TEST_CASE("A point or a segment changes as few vertices where 16 times as many are filled") {
  for (const char kind : {'p', 's'}) {
    for (const double area : {1e-4, 1e-4 / 16}) {
      BoxMesher<2> m(limited(area));
      std::int64_t next = 1;
      for (const auto& p : SizedSquare::points()) m.insert(mesher::PointId{next++}, p);
      for (const auto& s : SizedSquare::segments()) m.insert_segment(s.id, s.from, s.to);
      m.update();
      mesher::SplitMix64 random(5);
      std::vector<std::size_t> changed;
      while (changed.size() < 25) {
        const Point<2> p{random.unit(), random.unit()};
        const double length = kind == 'p' ? 0 : 3 * SizesInSquare::size(area);
        const double angle = 7 * random.unit();
        const Point<2> q{p[0] + length * std::cos(angle), p[1] + length * std::sin(angle)};
        if (SizedSquare::beyond(p) > -0.05 || SizedSquare::beyond(q) > -0.05) continue;
        m.insert(mesher::PointId{1000}, p);
        if (kind == 's') m.insert(mesher::PointId{1001}, q);
        if (kind == 's')
          m.insert_segment(mesher::LineId{1000}, mesher::PointId{1000}, mesher::PointId{1001});
        try {
          const auto change = m.update();
          changed.push_back(change.vertices_added.size() + change.vertices_removed.size());
        } catch (const mesher::Error&) {
          continue;  // it meets a segment
        }
        m.remove(mesher::PointId{1000});
        if (kind == 's') m.remove(mesher::PointId{1001});
        if (kind == 's') m.remove_line(mesher::LineId{1000});
        m.update();
      }
      std::nth_element(changed.begin(), changed.begin() + 12, changed.end());
      INFO(kind << " at area " << area << ": " << changed[12]);
      CHECK(changed[12] <= (kind == 'p' ? 6 : 20));
    }
  }
}
