// Writes meshes of tetrahedra in every format for compare_space.py, and what they are as `.truth`:
// "v" and the bits of three coordinates, "t" and four vertices from 0 on, "p" and a whole number
// and the ascending vertices of a tetrahedron (its region), a face or an edge (its marker); says
// what a file of others is to us.
//   space_files write FOLDER
//   space_files dump FILE TRUTH        of FILE.surface.vtu its points and polygons
#include <algorithm>
#include <bit>
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "file_program.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/meshing.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"

namespace {

using mesher::Point;

template <class Corners>
void write_part(Corners corners, std::int64_t value, std::ofstream& truth) {
  std::sort(corners.begin(), corners.end());
  truth << "p " << value;
  for (const std::uint32_t v : corners) truth << ' ' << v;
  truth << '\n';
}

void write_parts(const mesher::MeshData<3>& mesh, std::ofstream& truth) {
  const auto& f = mesh.features;
  for (std::size_t i = 0; i < f.regions.size(); ++i) {
    write_part(mesh.simplices[i], static_cast<std::int64_t>(f.regions[i]), truth);
  }
  for (const auto& face : f.faces) write_part(face.corners, face.marker, truth);
  for (const auto& e : f.edges) write_part(std::array{e.low, e.high}, e.marker, truth);
}

void write_truth(const mesher::MeshData<3>& mesh, const std::string& path) {
  std::ofstream truth(path);
  for (const auto& p : mesh.vertices) {
    truth << 'v';
    for (const double x : p) truth << ' ' << std::bit_cast<std::uint64_t>(x);
    truth << '\n';
  }
  for (const auto& s : mesh.simplices) {
    truth << "t " << s[0] << ' ' << s[1] << ' ' << s[2] << ' ' << s[3] << '\n';
  }
  write_parts(mesh, truth);
}

// Of points and polygons, by numbers of points from 0 on.
void write_surface(const mesher::Graph<3>& plc, const std::string& path) {
  std::ofstream truth(path);
  std::map<mesher::PointId, std::uint32_t> number;
  for (const auto& p : plc.points) {
    number.emplace(p.id, static_cast<std::uint32_t>(number.size()));
    truth << 'v';
    for (const double x : p.at) truth << ' ' << std::bit_cast<std::uint64_t>(x);
    truth << '\n';
  }
  for (const auto& f : plc.polygons) {
    std::vector<std::uint32_t> corners;
    for (const auto id : f.loops[0]) corners.push_back(number.at(id));
    write_part(corners, f.marker, truth);
  }
}

void write(const std::string& stem, const mesher::MeshData<3>& mesh) {
  for (const char* extension : {".node", ".vtu", ".vtk", ".msh", ".mesh", ".off", ".obj", ".stl"}) {
    mesher::write_mesh(mesh, stem + extension);
  }
  write_truth(mesh, stem + ".truth");
}

void write(const std::string& stem, const std::vector<Point<3>>& points) {
  mesher::Graph<3> graph;
  std::int64_t id = 0;
  for (const Point<3>& p : points) graph.points.push_back({mesher::PointId{++id}, p});
  const mesher::Options<3> options{.algorithm = mesher::Algorithm::gap_balls};
  write(stem, mesher::MeshData<3>(mesher::box_mesh(graph, options)));
}

// A cube in a cube, with two regions, and a marker for each side; one side's edges are segments.
void write_complex(const std::string& stem, mesher::Extent extent) {
  mesher::Graph<3> plc = mesher::generate_plc({mesher::PlcKind::nested, 0.2});
  std::int64_t marker = 10;
  for (auto& facet : plc.polygons) facet.marker = ++marker;
  const auto& side = plc.polygons[2].loops[0];
  for (std::size_t i = 0; i < side.size(); ++i) {
    const auto id = static_cast<std::int64_t>(i) + 1;
    plc.segments.push_back({mesher::LineId{id}, side[i], side[(i + 1) % side.size()], 90 + id});
  }
  plc.seeds.push_back(mesher::region_seed<3>(1, {0.1, 0.1, 0.1}, 3));
  plc.seeds.push_back(mesher::region_seed<3>(2, {0.5, 0.5, 0.5}, 8));
  const mesher::Options<3> options{.extent = extent, .algorithm = mesher::Algorithm::gap_balls};
  write(stem, mesher::mesh(plc, options).mesh);
}

void write_all(const std::string& folder) {
  write_complex(folder + "/complex", mesher::Extent::enclosed);
  write_complex(folder + "/complexbox", mesher::Extent::box);
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
    const std::string path = mesh;
    path.ends_with(".surface.vtu") ? write_surface(mesher::read<3>(path).graph, truth)
                                   : write_truth(mesher::read_mesh<3>(path), truth);
  });
}
