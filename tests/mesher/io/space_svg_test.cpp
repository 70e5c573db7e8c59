// Pictures of meshes of tetrahedra: what is shown, in which order, in which colour.
#include "mesher/space_svg.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <regex>
#include <string>
#include <vector>

#include "mesher/mesher.hpp"
#include "scratch_file.hpp"
#include "space_points.hpp"

namespace {

using mesher::Mesh;
using mesher::Point;

Mesh<3> mesh_of(support::SpaceFamily family, std::size_t n) {
  const auto points = support::space_points(family, n, 5);
  return mesher::mesh_statically<3>(points, {.domain = mesher::snapped_domain<3>(points)});
}

std::string picture(const Mesh<3>& mesh, const mesher::SpaceView& view) {
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

}  // namespace

TEST_CASE("a picture in space shows faces that are turned to the viewer, within its frame") {
  for (const auto family :
       {support::SpaceFamily::uniform, support::SpaceFamily::grid, support::SpaceFamily::spread}) {
    INFO(support::name(family));
    const Mesh<3> mesh = mesh_of(family, 60);
    const std::string svg = picture(mesh, mesher::space_view(mesh));
    std::smatch frame;
    REQUIRE(std::regex_search(svg, frame, std::regex("viewBox=\"0 0 (\\S+) (\\S+)\"")));
    const double width = std::stod(frame[1]), height = std::stod(frame[2]);
    CHECK(std::max(width, height) == 1000);
    const auto triangles = triangles_of(svg);
    CHECK(triangles.size() > 20);
    for (const Triangle& t : triangles) {
      CHECK(area(t) <= 0.01);  // clockwise where y is downward; rounded
      for (const auto& [x, y] : t) CHECK((x >= 0 && x <= width && y >= 0 && y <= height));
    }
    CHECK(svg.find("#c0392b") != std::string::npos);  // an input point
    CHECK(svg == picture(mesh, mesher::space_view(mesh)));
  }
}

TEST_CASE("a picture in space has nothing in front of its cut, and empty meshes have pictures") {
  const Mesh<3> mesh = mesh_of(support::SpaceFamily::uniform, 60);
  auto view = mesher::space_view(mesh);
  // All of the mesh: the box's front is cut away.
  view.window = {mesh.vertices.front(), mesh.vertices.back()};
  const auto all = triangles_of(picture(mesh, view));
  view.window.hi[1] = view.window.lo[1];
  CHECK(triangles_of(picture(mesh, view)).empty());
  CHECK(all.size() > 100);
  const std::string none = picture({}, mesher::space_view({}));
  CHECK(none.find("</svg>") != std::string::npos);
  CHECK(triangles_of(none).empty());
}

TEST_CASE("tetrahedra that an update brought are orange in a picture") {
  const Mesh<3> mesh = mesh_of(support::SpaceFamily::uniform, 60);
  auto view = mesher::space_view(mesh);
  const std::regex kOrange("fill=\"#[c-f][0-9a-f][89a][0-9a-f][345][0-9a-f]\"");
  CHECK_FALSE(std::regex_search(picture(mesh, view), kOrange));
  for (const auto& s : mesh.simplices) {
    view.coloured.push_back(
        {mesh.vertices[s[0]], mesh.vertices[s[1]], mesh.vertices[s[2]], mesh.vertices[s[3]]});
  }
  std::reverse(view.coloured.begin(), view.coloured.end());
  CHECK(std::regex_search(picture(mesh, view), kOrange));
}
