// Writes meshes of tetrahedra in every format for compare_space.py, and what they are as `.truth`:
// "v" and the bits of three coordinates, "t" and four vertices from 0 on; says what a file of
// others is to us.
//   space_files write FOLDER
//   space_files dump FILE TRUTH
#include "mesher/space_files.hpp"

#include <bit>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "file_program.hpp"
#include "mesher/generate.hpp"
#include "mesher/io.hpp"
#include "mesher/mesher.hpp"

namespace {

using mesher::Point;

void write_truth(const mesher::Mesh<3>& mesh, const std::string& path) {
  std::ofstream truth(path);
  for (const auto& p : mesh.vertices) {
    truth << 'v';
    for (const double x : p) truth << ' ' << std::bit_cast<std::uint64_t>(x);
    truth << '\n';
  }
  for (const auto& s : mesh.simplices) {
    truth << "t " << s[0] << ' ' << s[1] << ' ' << s[2] << ' ' << s[3] << '\n';
  }
}

void write(const std::string& stem, const std::vector<Point<3>>& points) {
  const mesher::Options<3> options{.domain = mesher::snapped_domain<3>(points)};
  const mesher::Mesh<3> mesh = mesher::mesh_statically<3>(points, options);
  for (const char* extension : {".node", ".vtu", ".vtk", ".msh", ".mesh", ".off", ".obj", ".stl"}) {
    mesher::write_mesh(mesh, stem + extension);
  }
  write_truth(mesh, stem + ".truth");
}

void write_all(const std::string& folder) {
  write(folder + "/uniform", mesher::generate_points<3>(mesher::PointKind::uniform, 50, 1));
  write(folder + "/grid", mesher::generate_points<3>(mesher::PointKind::grid, 27, 1));
  std::vector<Point<3>> small = mesher::generate_points<3>(mesher::PointKind::gaussian, 9, 4);
  for (auto& p : small) {
    for (double& x : p) x *= 0x1p-70;
  }
  write(folder + "/small", small);
}

}  // namespace

int main(int argc, char** argv) {
  return formats::file_program(argc, argv, write_all, [](const char* mesh, const char* truth) {
    write_truth(mesher::read_mesh<3>(mesh), truth);
  });
}
