// The readers of single formats behind read_plc.
#pragma once

#include <string>

#include "mesher/plc.hpp"

namespace mesher {

/// Throws: Error as read_plc, but ids of points, holes and regions may repeat.
[[nodiscard]] PlcFile read_space_poly(const std::string& path);
[[nodiscard]] PlcFile read_smesh(const std::string& path);

}  // namespace mesher
