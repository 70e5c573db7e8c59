// The readers of single formats behind read<3>.
#pragma once

#include <string>

#include "mesher/graph.hpp"

namespace mesher {

/// Throws: Error as read(), but ids of points, holes and regions may repeat.
[[nodiscard]] GraphFile<3> read_space_poly(const std::string& path);
[[nodiscard]] GraphFile<3> read_smesh(const std::string& path);

}  // namespace mesher
