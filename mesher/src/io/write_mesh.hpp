// The writers of single formats, behind open_mesh. Each throws Error(cannot_write).
#pragma once

#include "mesher/mesh.hpp"
#include "mesher/output_files.hpp"

namespace mesher {

void write_node(const Mesh<2>& mesh, TextFile& file);
void write_ele(const Mesh<2>& mesh, TextFile& file);
void write_vtu(const Mesh<2>& mesh, TextFile& file);
void write_off(const Mesh<2>& mesh, TextFile& file);

}  // namespace mesher
