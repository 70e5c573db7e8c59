// Values that a `.mesh` file cannot hold, and counts instead.
#pragma once

#include <string>

#include "mesher/io.hpp"
#include "mesher/mesh_data.hpp"
#include "mesher/plc.hpp"
#include "mesher/pslg.hpp"

namespace tool {

/// Where `path` is of a format that counts values which are no whole numbers from 1 on, and `graph`
/// has such: what would be compared with them is taken out of both, and a note of the mesh says so.
void forget_counted_values(const std::string& path, mesher::MeshData& mesh,
                           mesher::PslgFile& graph);

/// The same of regions in space; markers are not compared there.
void forget_counted_values(const std::string& path, mesher::MeshDataOf<3>& mesh,
                           mesher::PlcFile& complex);

}  // namespace tool
