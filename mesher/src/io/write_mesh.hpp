// The writers of single formats, behind open_mesh. Each throws Error(cannot_write).
#pragma once

#include <cstdint>
#include <vector>

#include "mesher/mesh_data.hpp"
#include "mesher/output_files.hpp"

namespace mesher {

void write_node(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file);
void write_ele(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file);
void write_edge(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file);
void write_poly(const MeshFeatures& features, TextFile& file);
void write_neigh(const Mesh<2>& mesh, TextFile& file);
void write_vtu(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file);
void write_vtk(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file);
void write_msh(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file);
void write_medit(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file);
void write_off(const Mesh<2>& mesh, TextFile& file);
void write_obj(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file);

/// Numbers for formats whose groups are positive integers of 32 bits: 0 stays 0; other values stay
/// if all are such integers, else they are numbered upward from 1.
class GroupNumbers {
 public:
  explicit GroupNumbers(std::vector<double> values);
  [[nodiscard]] std::int32_t of(double value) const;
  /// The distinct values but 0, ascending.
  [[nodiscard]] const std::vector<double>& values() const { return values_; }

 private:
  std::vector<double> values_;
  bool as_they_are_ = true;
};

}  // namespace mesher
