// A file that several processes read together. All functions are of all processes (peers.hpp), and
// say what reading by one would: the same points, the same errors.
#pragma once

#include <string>

#include "mesher/read.hpp"
#include "tiles/peers.hpp"

namespace mesher::detail {

/// As dimension_of().
[[nodiscard]] int joint_dimension(const std::string& path, Peers& peers);

/// As read(). Of points alone in a file with a line for each (.node, .xyz, .csv) each process gets
/// those of its share of the lines, which all must be able to read; of other files the first
/// process gets all. Throws: Error as read(), in all. Cost: O(n log n); of memory, while it runs
/// and beside the points, 3 to 4 times the bytes of a share, and up to 8 times where lines are
/// short.
template <int D>
[[nodiscard]] GraphFile<D> joint_read(const std::string& path, const ReadOptions& options,
                                      Peers& peers);

/// As located(): a feature is where one of the processes has it. `error`: of all.
template <int D>
[[nodiscard]] Error joint_located(const Error& error, const GraphFile<D>& share, Peers& peers);

}  // namespace mesher::detail
