// The cities of the world: points are removed, put back, added and moved, each one update. At the
// end the mesh is compared, bit for bit, with one made from scratch.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "demo.hpp"
#include "mesher/check.hpp"
#include "mesher/extra/edit_script.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/mesher.hpp"
#include "mesher/meshing.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"

namespace demo {
namespace {

using mesher::Mesh;
using mesher::Point;
using mesher::PointId;

constexpr int kUpdates = 1000;
constexpr std::uint64_t kSeed = 2026;

/// The points that are in the mesh, and the edits that change both.
class World {
 public:
  World(const mesher::Graph<2>& cities, const mesher::Options<2>& options)
      : points_(mesher::places_of(cities)), mesher_(options), random_(kSeed) {
    for (const auto& city : cities.points) ids_.push_back(city.id);
    mesher_.insert(cities);
    mesher_.update();
    next_id_ = static_cast<std::int64_t>(*std::max_element(ids_.begin(), ids_.end())) + 1;
  }

  /// Makes edit number i of the script; its seconds.
  double edit(int i) {
    const double start = mesher::now();
    switch (i % 4) {
      case 0:
        remove(random_.below(ids_.size()));
        break;
      case 1:
        insert(removed_id_, removed_);
        break;
      case 2:
        insert(PointId{next_id_++}, anywhere());
        break;
      case 3:
        move(random_.below(ids_.size()));
        break;
    }
    mesher_.update();
    return mesher::now() - start;
  }

  /// Adds a point a third of the way from a point to its nearest neighbour.
  mesher::Change<2> add_between_neighbours() {
    const Point<2> p = points_[random_.below(points_.size())];
    const auto distance = [&](const Point<2>& q) {
      const double x = q[0] - p[0], y = q[1] - p[1];
      return p == q ? 1e300 : x * x + y * y;
    };
    const Point<2> q = *std::min_element(
        points_.begin(), points_.end(),
        [&](const Point<2>& a, const Point<2>& b) { return distance(a) < distance(b); });
    insert(PointId{next_id_++}, {p[0] + (q[0] - p[0]) / 3, p[1] + (q[1] - p[1]) / 3});
    return mesher_.update();
  }

  [[nodiscard]] Mesh<2> mesh() const { return mesher_.mesh(); }
  [[nodiscard]] Mesh<2> mesh_from_scratch() const {
    return mesher::mesh(mesher_.input(), mesher_.options()).mesh;
  }

 private:
  void insert(PointId id, const Point<2>& p) {
    mesher_.insert(id, p);
    ids_.push_back(id);
    points_.push_back(p);
  }
  void remove(std::size_t i) {
    removed_id_ = ids_[i];
    removed_ = points_[i];
    mesher_.remove(ids_[i]);
    ids_.erase(ids_.begin() + static_cast<std::ptrdiff_t>(i));
    points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  // A thousandth of the way to some place in the domain.
  void move(std::size_t i) {
    const Point<2> towards = anywhere();
    for (int k = 0; k < 2; ++k) points_[i][k] += (towards[k] - points_[i][k]) / 1000;
    mesher_.move(ids_[i], points_[i]);
  }
  Point<2> anywhere() {
    const auto& box = mesher_.options().domain;
    Point<2> p;
    for (int k = 0; k < 2; ++k) p[k] = box.lo[k] + (box.hi[k] - box.lo[k]) * random_.unit();
    return p;
  }

  std::vector<PointId> ids_;
  std::vector<Point<2>> points_;
  mesher::Mesher<2> mesher_;
  mesher::SplitMix64 random_;
  std::int64_t next_id_ = 0;
  PointId removed_id_{};
  Point<2> removed_{};
};

// The triangles that came or went, with as much again around them.
mesher::SvgView<2> view_of(const mesher::Change<2>& change) {
  mesher::SvgView<2> view{{change.vertices_added.front(), change.vertices_added.front()}, {}};
  auto& [lo, hi] = view.window;
  for (const auto* triangles : {&change.simplices_added, &change.simplices_removed}) {
    for (const auto& triangle : *triangles) {
      for (const auto& p : triangle) {
        lo = {std::min(lo[0], p[0]), std::min(lo[1], p[1])};
        hi = {std::max(hi[0], p[0]), std::max(hi[1], p[1])};
      }
    }
  }
  const double margin = std::max(hi[0] - lo[0], hi[1] - lo[1]) / 2;
  lo = {lo[0] - margin, lo[1] - margin};
  hi = {hi[0] + margin, hi[1] + margin};
  return view;
}

void draw(mesher::OutputFiles& files, const std::string& path, const Mesh<2>& mesh,
          mesher::SvgView<2> view, const std::vector<std::array<Point<2>, 3>>& coloured) {
  view.coloured = coloured;
  mesher::write_svg(mesh, view, files.open(path));
}

void print_mesh(const Mesh<2>& mesh) {
  std::printf("  vertices                  %10zu\n", mesh.vertices.size());
  std::printf("  triangles                 %10zu\n", mesh.simplices.size());
  std::printf("  smallest angle            %10.2f degrees\n", mesher::quality(mesh).min_angle_deg);
}

}  // namespace

void show_cities(const std::string& path, const std::string& folder, mesher::OutputFiles& files) {
  const mesher::Graph<2> cities = mesher::read<2>(path).graph;
  if (cities.points.empty())
    throw mesher::Error(mesher::ErrorCode::bad_option, "no points", {path});
  mesher::Options<2> options;
  options.domain = mesher::snapped_domain<2>(places_of(cities));
  World world(cities, options);
  const Mesh<2> first = world.mesh();
  std::printf("%s: %zu points\n", path.c_str(), cities.points.size());
  print_mesh(first);
  const double scratch = seconds_of([&] { (void)world.mesh_from_scratch(); });
  std::vector<double> seconds;
  for (int i = 0; i < kUpdates; ++i) seconds.push_back(world.edit(i));
  print_seconds(scratch, std::move(seconds));

  const Mesh<2> before = world.mesh();
  const mesher::Change<2> change = world.add_between_neighbours();
  const Mesh<2> after = world.mesh();
  if (after != world.mesh_from_scratch()) throw std::logic_error("the mesh differs from scratch");
  std::printf("  after all updates the mesh is that from scratch, bit for bit\n");
  mesher::open_mesh<2>(files, folder + "/cities.svg")(first);
  draw(files, folder + "/city_before.svg", before, view_of(change), change.simplices_removed);
  draw(files, folder + "/city_after.svg", after, view_of(change), change.simplices_added);
}

}  // namespace demo
