// The boundary of a mesh of tetrahedra as a surface. Each throws Error(cannot_write). If markers of
// faces have names, the faces of a marker are a group of `.obj`, a solid of `.stl`, upward by
// marker.
#pragma once

#include "mesher/mesh.hpp"
#include "mesher/write.hpp"

namespace mesher {

void write_surface_off(const Mesh<3>& mesh, TextFile& file);
void write_surface_obj(const Mesh<3>& mesh, const MeshFeatures& features, TextFile& file);
/// In text: floats of the binary format would round coordinates.
void write_surface_stl(const Mesh<3>& mesh, const MeshFeatures& features, TextFile& file);

}  // namespace mesher
