// Writes meshes of tetrahedra in every format for compare_space.py, and what they are as `.truth`:
// "v" and the bits of three coordinates, "t" and four vertices from 0 on.
//   space_files FOLDER
#include "mesher/space_files.hpp"

#include <bit>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "mesher/generate.hpp"
#include "mesher/mesher.hpp"

namespace {

using mesher::Point;

void write(const std::string& stem, const std::vector<Point<3>>& points) {
  const mesher::Options<3> options{.domain = mesher::snapped_domain<3>(points)};
  const mesher::Mesh<3> mesh = mesher::mesh_statically<3>(points, options);
  for (const char* extension : {".node", ".vtu", ".vtk", ".msh", ".mesh"}) {
    mesher::write_mesh(mesh, stem + extension);
  }
  std::ofstream truth(stem + ".truth");
  for (const auto& p : mesh.vertices) {
    truth << 'v';
    for (const double x : p) truth << ' ' << std::bit_cast<std::uint64_t>(x);
    truth << '\n';
  }
  for (const auto& s : mesh.simplices) {
    truth << "t " << s[0] << ' ' << s[1] << ' ' << s[2] << ' ' << s[3] << '\n';
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::cerr << "usage: space_files FOLDER\n", 2;
  const std::string folder = argv[1];
  write(folder + "/uniform", mesher::generate_points<3>(mesher::PointKind::uniform, 50, 1));
  write(folder + "/grid", mesher::generate_points<3>(mesher::PointKind::grid, 27, 1));
  std::vector<Point<3>> small = mesher::generate_points<3>(mesher::PointKind::gaussian, 9, 4);
  for (auto& p : small) {
    for (double& x : p) x *= 0x1p-70;
  }
  write(folder + "/small", small);
}
