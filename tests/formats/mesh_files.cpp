// Writes meshes in every format for others to read, and what they are for a comparison; says what
// a file of others is to us.
//
//   mesh_files write FOLDER
//   mesh_files dump FILE TRUTH
//
// For each mesh NAME: NAME.node (.ele, ...), .vtu, .vtk, .msh, .mesh, .off, .obj, and NAME.truth:
// lines `v BITS BITS` (a vertex, its doubles' bits in hexadecimal), `t A B C REGION` (a triangle),
// `e A B MARKER` (an edge on a line), numbered from 0. `dump` writes the like of FILE to TRUTH.
#include <bit>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <string>

#include "file_program.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/meshing.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"
#include "random_mesh.hpp"

namespace {

using mesher::MeshData;

void write_truth(const MeshData<2>& mesh, const std::string& path) {
  std::ofstream file(path);
  file << std::hex << std::setfill('0');
  for (const auto& [x, y] : mesh.vertices) {
    file << "v " << std::setw(16) << std::bit_cast<std::uint64_t>(x) << ' ' << std::setw(16)
         << std::bit_cast<std::uint64_t>(y) << '\n';
  }
  file << std::dec << std::setprecision(17);
  for (std::size_t i = 0; i < mesh.simplices.size(); ++i) {
    const auto& [a, b, c] = mesh.simplices[i];
    const double region = mesh.features.regions.empty() ? 0 : mesh.features.regions[i];
    file << "t " << a << ' ' << b << ' ' << c << ' ' << region << '\n';
  }
  for (const auto& e : mesh.features.edges) {
    file << "e " << e.low << ' ' << e.high << ' ' << e.marker << '\n';
  }
}

void write(const MeshData<2>& mesh, const std::string& stem) {
  write_truth(mesh, stem + ".truth");
  for (const char* extension : {".node", ".vtu", ".vtk", ".msh", ".mesh", ".off", ".obj"}) {
    mesher::write_mesh(mesh, stem + extension);
  }
}

MeshData<2> mesh_of_points() {
  mesher::Graph<2> graph;
  std::int64_t id = 0;
  for (const auto& p : mesher::generate_points<2>(mesher::PointKind::clusters, 500, 1)) {
    graph.points.push_back({mesher::PointId{++id}, p});
  }
  return MeshData<2>(mesher::box_mesh<2>(graph, {.algorithm = mesher::Algorithm::gap_balls}));
}

void write_all(const std::string& folder) {
  mesher::SplitMix64 random(1);
  write(mesh_of_points(), folder + "points");
  const support::MeshValues small{.any_region = false, .any_marker = false};
  for (int i = 0; i < 5; ++i) {
    const auto size = 1 + static_cast<std::uint32_t>(random.below(12));
    write(support::random_mesh(size, random, small), folder + "features" + std::to_string(i));
  }
  write(support::random_mesh(9, random), folder + "any_values");
}

}  // namespace

int main(int argc, char** argv) {
  return formats::file_program(
      argc, argv, [](const std::string& folder) { write_all(folder + "/"); },
      [](const char* mesh, const char* truth) { write_truth(mesher::read_mesh(mesh), truth); });
}
