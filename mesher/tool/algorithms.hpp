// The algorithms of `mesher mesh`, and which one is taken.
#pragma once

#include "arguments.hpp"
#include "input.hpp"
#include "progress.hpp"
#include "report.hpp"

namespace tool {

/// The mesh in the box, by args.algorithm; `run` is told which that was, and what happened.
/// "auto": the fastest that knows what is asked for. If it finds features too close, or takes more
/// vertices than it may, that is said on standard error, and gap-balls tries.
/// Throws: as the algorithm.
template <int D>
[[nodiscard]] mesher::Mesh<D> mesh_by_algorithm(const MeshArguments& args, const InputOf<D>& input,
                                                const mesher::Options<D>& options, AnyRun& run,
                                                Progress& progress);

}  // namespace tool
