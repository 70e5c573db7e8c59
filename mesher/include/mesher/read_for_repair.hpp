// Readers of points that leave those in one place to a repair (repair.hpp, space_repair.hpp).
//
//   mesher::PslgFile scan = mesher::read_pslg("scan.csv", mesher::CoincidingPoints::kept);
//   scan = mesher::repair(scan).file;    // points in one place are one
#pragma once

#include <cstdint>
#include <string>

#include "mesher/io.hpp"
#include "mesher/pslg.hpp"

namespace mesher {

/// What readers of points alone do with points in one place.
enum class CoincidingPoints : std::uint8_t { refused, kept };

/// As read_points(path), but Error(duplicate_point) only if coinciding points are refused.
template <int D>
[[nodiscard]] PointFile<D> read_points(const std::string& path, CoincidingPoints coinciding);

/// As read_pslg(path), likewise.
[[nodiscard]] PslgFile read_pslg(const std::string& path, CoincidingPoints coinciding);

}  // namespace mesher
