// The Great Lakes: a harbour wall on the shore of Lake Michigan goes out into the lake step by
// step; in the end it is closed, and the harbour is a region of its own.
//
// Each step moves the wall's seven free corners and is one update. At the end the mesh is compared,
// bit for bit, with one made from scratch.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "demo.hpp"
#include "mesher/extra/edit_script.hpp"
#include "mesher/mesher.hpp"
#include "mesher/meshing.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"

namespace demo {
namespace {

using mesher::LineId;
using mesher::Point;
using mesher::PointId;

constexpr int kSteps = 200;
constexpr Point<2> kStep{0.001, 0.0002};  // degrees

// Points of the shore that the wall begins at, and is to end at; corners between them.
constexpr PointId kBegin{2464}, kEnd{2466};
const std::vector<Point<2>> kCorners{{-87.572, 41.826}, {-87.553, 41.838}, {-87.541, 41.855},
                                     {-87.537, 41.875}, {-87.541, 41.895}, {-87.55, 41.913},
                                     {-87.563, 41.927}};

// A place in each lake: Superior, Michigan, Huron, Erie, Ontario; and in the closed harbour.
const std::vector<Point<2>> kLakes{{-87, 47.8}, {-87, 43}, {-82.3, 44.5}, {-81, 42.2}, {-78, 43.6}};
constexpr Point<2> kHarbour{-87.5, 41.89};
const mesher::Box<2> kWindow{{-87.85, 41.6}, {-86.85, 42.2}};

/// The lakes with the wall.
class Harbour {
 public:
  explicit Harbour(const mesher::Graph<2>& graph)
      : lakes_({.domain = mesher::snapped_domain<2>(mesher::places_of(graph))}) {
    lakes_.insert(graph);
    for (const Point<2>& lake : kLakes) add_region(lake);
    for (const auto& p : graph.points) next_point_ = std::max(next_point_, to_integer(p.id) + 1);
    for (const auto& s : graph.segments) next_line_ = std::max(next_line_, to_integer(s.id) + 1);
    lakes_.update();
  }

  void build() {
    std::vector<PointId> along{kBegin};
    for (const Point<2>& corner : kCorners) {
      along.push_back(PointId{next_point_++});
      corners_.push_back({along.back(), corner});
      lakes_.insert(along.back(), corner);
    }
    lakes_.insert_polyline(LineId{next_line_++}, along);
    lakes_.update();
  }
  mesher::DomainUpdate<2> step() {
    for (auto& corner : corners_) {
      corner.at = {corner.at[0] + kStep[0], corner.at[1] + kStep[1]};
      lakes_.move(corner.id, corner.at);
    }
    return lakes_.update();
  }
  void close() {
    lakes_.insert_segment(LineId{next_line_++}, corners_.back().id, kEnd);
    add_region(kHarbour);
    lakes_.update();
  }

  [[nodiscard]] mesher::DomainMesh<2> mesh() const { return lakes_.domain_mesh(); }
  [[nodiscard]] mesher::DomainMesh<2> from_scratch() const {
    return mesher::mesh(lakes_.input(), lakes_.options());
  }

 private:
  // Its attribute is its number.
  void add_region(const Point<2>& at) {
    ++regions_;
    lakes_.insert_region(regions_, at, static_cast<double>(regions_));
  }
  static std::int64_t to_integer(auto id) { return static_cast<std::int64_t>(id); }

  mesher::Mesher<2> lakes_;
  std::vector<mesher::GraphPoint<2>> corners_;
  std::int64_t next_point_ = 0, next_line_ = 0, regions_ = 0;
};

void draw(mesher::OutputFiles& files, const std::string& path, const mesher::DomainMesh<2>& mesh,
          const mesher::SvgView<2>& view) {
  mesher::write_svg(mesh.mesh, mesh.mesh.features, view, files.open(path));
}

void print_mesh(const mesher::DomainMesh<2>& mesh) {
  std::printf("  vertices                  %10zu\n", mesh.mesh.vertices.size());
  std::printf("  triangles                 %10zu\n", mesh.mesh.simplices.size());
}

// Seconds of each step.
std::vector<double> move(Harbour& harbour) {
  std::vector<double> seconds;
  for (int i = 0; i < kSteps; ++i) {
    const double start = mesher::now();
    harbour.step();
    seconds.push_back(mesher::now() - start);
  }
  return seconds;
}

void require_that_from_scratch(const Harbour& harbour) {
  const mesher::DomainMesh<2> now = harbour.mesh(), scratch = harbour.from_scratch();
  const mesher::Mesh<2>&a = now.mesh, &b = scratch.mesh;
  if (a == b && now.mesh.features == scratch.mesh.features) return;
  throw std::logic_error("the mesh differs from scratch");
}

}  // namespace

void show_lakes(const std::string& path, const std::string& folder, mesher::OutputFiles& files) {
  const mesher::GraphFile<2> file = mesher::read<2>(path);
  Harbour harbour(file.graph);
  const mesher::DomainMesh<2> lakes = harbour.mesh();
  std::printf("%s: %zu points, %zu lines\n", path.c_str(), file.graph.points.size(),
              file.graph.segments.size());
  print_mesh(lakes);
  draw(files, folder + "/great_lakes.svg", lakes, mesher::svg_view(lakes.mesh));

  harbour.build();
  draw(files, folder + "/harbour_before.svg", harbour.mesh(), {kWindow, {}});
  const double scratch = seconds_of([&] { (void)harbour.from_scratch(); });
  std::printf("  a harbour wall moves in %d steps\n", kSteps);
  print_seconds(scratch, move(harbour));
  const mesher::DomainUpdate<2> last = harbour.step();
  draw(files, folder + "/harbour_after.svg", harbour.mesh(), {kWindow, last.domain.kept_added});
  harbour.close();
  draw(files, folder + "/harbour_closed.svg", harbour.mesh(), {kWindow, {}});
  require_that_from_scratch(harbour);
  std::printf("  after all updates the mesh is that from scratch, bit for bit\n");
}

}  // namespace demo
