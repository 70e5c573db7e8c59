// Pictures of meshes of tetrahedra: what is shown, in which order, in which colour.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "facade/graph_runs.hpp"
#include "geometry/box.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/mesher.hpp"
#include "mesher/write.hpp"
#include "scratch_file.hpp"
#include "space_points.hpp"

namespace {

using mesher::Mesh;
using mesher::Point;

Mesh<3> mesh_of(support::SpaceFamily family, std::size_t n) {
  const auto points = support::space_points(family, n, 5);
  return mesher::mesh_statically<3>(points, {.domain = mesher::snapped_domain<3>(points)});
}

std::string picture(const Mesh<3>& mesh, const mesher::SvgView<3>& view) {
  const support::ScratchFolder folder;
  mesher::OutputFiles files;
  mesher::write_svg(mesh, view, files.open(folder.path("a.svg")));
  files.commit();
  return folder.read("a.svg");
}

using Triangle = std::array<Point<2>, 3>;  // on the picture

std::vector<Triangle> triangles_of(const std::string& svg) {
  static const std::regex kFace("d=\"M(\\S+) (\\S+)L(\\S+) (\\S+)L(\\S+) (\\S+)Z\"");
  std::vector<Triangle> all;
  for (std::sregex_iterator i(svg.begin(), svg.end(), kFace), end; i != end; ++i) {
    Triangle t;
    for (std::size_t k = 0; k < 6; ++k) t[k / 2][k % 2] = std::stod((*i)[k + 1]);
    all.push_back(t);
  }
  return all;
}

double area(const Triangle& t) {
  return ((t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[2][0] - t[0][0]) * (t[1][1] - t[0][1])) /
         2;
}

bool covers(const Triangle& t, const Point<2>& p) {
  const auto side = [&](std::size_t i) { return area({t[i], t[(i + 1) % 3], p}); };
  return side(0) < 0 && side(1) < 0 && side(2) < 0;
}

// How the picture is said to be taken: from the front, above and left, of tetrahedra with their
// middle in the window and behind its middle in y.
class Viewer {
 public:
  Viewer(const Mesh<3>& mesh, const mesher::Box<3>& window) {
    for (const auto& s : mesh.simplices) {
      std::array<Point<3>, 4> corners;
      Point<3> middle{};
      for (std::size_t k = 0; k < 4; ++k) {
        corners[k] = seen(mesh.vertices[s[k]]);
        for (std::size_t i = 0; i < 3; ++i) middle[i] += mesh.vertices[s[k]][i] / 4;
      }
      bool shown = middle[1] > (window.lo[1] + window.hi[1]) / 2;
      for (std::size_t i = 0; i < 3; ++i) {
        shown = shown && middle[i] >= window.lo[i] && middle[i] <= window.hi[i];
      }
      if (shown) shown_.push_back(corners);
    }
  }

  // The places of the picture's plane with y downward, and as wide as the triangles drawn.
  void fit(const std::vector<Triangle>& drawn) {
    std::vector<Point<2>> on_picture, here;
    for (const Triangle& t : drawn) on_picture.insert(on_picture.end(), t.begin(), t.end());
    for (const auto& corners : shown_) {
      for (const Point<3>& p : corners) here.push_back({p[0], -p[1]});
    }
    const auto [lo, hi] = mesher::detail::bounding_box<2>(on_picture);
    const auto [from, to] = mesher::detail::bounding_box<2>(here);
    const double scale = (hi[0] - lo[0]) / (to[0] - from[0]);
    for (auto& corners : shown_) {
      for (Point<3>& p : corners) {
        p = {lo[0] + (p[0] - from[0]) * scale, lo[1] + (-p[1] - from[1]) * scale, p[2] * scale};
      }
    }
  }

  // The face that is nearest to the viewer there; corners at 0 if there is none.
  [[nodiscard]] Triangle nearest_at(const Point<2>& at) const {
    double nearest = -INFINITY;
    Triangle found{};
    for (const auto& corners : shown_) {
      for (std::size_t left_out = 0; left_out < 4; ++left_out) {
        std::array<Point<3>, 3> f;
        for (std::size_t i = 0; i < 3; ++i) f[i] = corners[(left_out + 1 + i) % 4];
        Triangle t{Point<2>{f[0][0], f[0][1]}, {f[1][0], f[1][1]}, {f[2][0], f[2][1]}};
        if (area(t) > 0) {
          std::swap(t[0], t[1]);
          std::swap(f[0], f[1]);
        }
        if (!covers(t, at)) continue;
        double depth = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          depth += f[i][2] * area({at, t[(i + 1) % 3], t[(i + 2) % 3]}) / area(t);
        }
        if (depth > nearest) found = t, nearest = depth;
      }
    }
    return found;
  }

 private:
  static Point<3> seen(const Point<3>& p) {
    const double r = std::sqrt(0.7696);  // of 0.8^2 + 0.36^2
    return {(0.8 * p[0] - 0.36 * p[1]) / r, (0.48 * 0.36 * p[0] + 0.48 * 0.8 * p[1]) / r + r * p[2],
            -0.36 * p[0] - 0.8 * p[1] + 0.48 * p[2]};
  }
  std::vector<std::array<Point<3>, 4>> shown_;  // to the right, up, to the viewer
};

Triangle last_at(const std::vector<Triangle>& drawn, const Point<2>& at) {
  const auto found =
      std::find_if(drawn.rbegin(), drawn.rend(), [&](const Triangle& t) { return covers(t, at); });
  return found == drawn.rend() ? Triangle{} : *found;
}

// But for rounding and the order of corners.
bool same(Triangle a, Triangle b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(a[i][0] - b[i][0]) > 0.01 || std::abs(a[i][1] - b[i][1]) > 0.01) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("what is drawn last at a place of a picture in space is what is nearest there") {
  for (const auto family :
       {support::SpaceFamily::uniform, support::SpaceFamily::sphere,
        support::SpaceFamily::line_and_circle, support::SpaceFamily::clusters}) {
    INFO(support::name(family));
    const Mesh<3> mesh = mesh_of(family, 300);
    auto view = mesher::svg_view(mesh);
    for (std::size_t i = 0; i < 3; ++i) {  // with large tetrahedra around small ones
      view.window.lo[i] -= 1;
      view.window.hi[i] += 1;
    }
    const auto drawn = triangles_of(picture(mesh, view));
    Viewer viewer(mesh, view.window);
    viewer.fit(drawn);
    mesher::SplitMix64 random(7);
    int looked_at = 0, covered = 0;
    for (int i = 0; i < 600; ++i) {
      const Point<2> at{1000 * random.unit(), 1000 * random.unit()};
      const Triangle nearest = viewer.nearest_at(at);
      const bool on_edge = !same(nearest, viewer.nearest_at({at[0] + 0.05, at[1]})) ||
                           !same(nearest, viewer.nearest_at({at[0], at[1] + 0.05})) ||
                           !same(nearest, viewer.nearest_at({at[0] - 0.05, at[1] - 0.05}));
      if (on_edge) continue;
      CAPTURE(at[0], at[1]);
      CHECK(same(last_at(drawn, at), nearest));
      ++looked_at;
      if (nearest != Triangle{}) ++covered;
    }
    CHECK(looked_at > 300);
    CHECK(covered > 150);
  }
}

TEST_CASE("a picture in space shows faces that are turned to the viewer, within its frame") {
  for (const auto family :
       {support::SpaceFamily::uniform, support::SpaceFamily::grid, support::SpaceFamily::spread}) {
    INFO(support::name(family));
    const Mesh<3> mesh = mesh_of(family, 60);
    const std::string svg = picture(mesh, mesher::svg_view(mesh));
    std::smatch frame;
    REQUIRE(std::regex_search(svg, frame, std::regex("viewBox=\"0 0 (\\S+) (\\S+)\"")));
    const double width = std::stod(frame[1]), height = std::stod(frame[2]);
    CHECK(std::max(width, height) == 1000);
    const auto triangles = triangles_of(svg);
    CHECK(triangles.size() > 10);
    for (const Triangle& t : triangles) {
      CHECK(area(t) <= 0.01);  // clockwise where y is downward; rounded
      for (const auto& [x, y] : t) CHECK((x >= 0 && x <= width && y >= 0 && y <= height));
    }
    CHECK(svg.find("#c0392b") != std::string::npos);  // an input point
    CHECK(svg == picture(mesh, mesher::svg_view(mesh)));
  }
}

TEST_CASE("a picture in space has nothing in front of its cut, and empty meshes have pictures") {
  const Mesh<3> mesh = mesh_of(support::SpaceFamily::uniform, 60);
  auto view = mesher::svg_view(mesh);
  // All of the mesh: the box's front is cut away.
  view.window = {mesh.vertices.front(), mesh.vertices.back()};
  const auto all = triangles_of(picture(mesh, view));
  view.window.hi[1] = view.window.lo[1];
  CHECK(triangles_of(picture(mesh, view)).empty());
  CHECK(all.size() > 100);
  const std::string none = picture({}, mesher::svg_view<3>({}));
  CHECK(none.find("</svg>") != std::string::npos);
  CHECK(triangles_of(none).empty());
}

TEST_CASE("tetrahedra that an update brought are orange in a picture") {
  const Mesh<3> mesh = mesh_of(support::SpaceFamily::uniform, 60);
  auto view = mesher::svg_view(mesh);
  const std::regex kOrange("fill=\"#[c-f][0-9a-f][89a][0-9a-f][345][0-9a-f]\"");
  CHECK_FALSE(std::regex_search(picture(mesh, view), kOrange));
  for (const auto& s : mesh.simplices) {
    view.coloured.push_back(
        {mesh.vertices[s[0]], mesh.vertices[s[1]], mesh.vertices[s[2]], mesh.vertices[s[3]]});
  }
  std::reverse(view.coloured.begin(), view.coloured.end());
  CHECK(std::regex_search(picture(mesh, view), kOrange));
}
