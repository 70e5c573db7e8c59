// The first mesh of an input, made with or without the engine.
#pragma once

#include "input.hpp"
#include "mesher/meshing.hpp"
#include "progress.hpp"
#include "report.hpp"

namespace tool {

/// Gives `target` the input and updates it.
/// Throws: Error, said of the line of the feature to blame or of the file; Error(cancelled).
template <int D, class Target>
void insert_all(const Input<D>& input, Target& target, Progress& progress) {
  locating(input, [&] {
    target.insert(input.graph());
    Watched(target, progress).update();
  });
}

/// Runs `target`, a mesher without input, on the input. Throws: Error, as insert_all.
template <int D, class Target>
RunOf<D> first_run(const Input<D>& input, Target& target, Progress& progress) {
  const double start = mesher::now();
  insert_all(input, target, progress);
  const Kept<D>& mesh = target.domain_mesh();
  RunOf<D> run;
  run.seconds_total = mesher::now() - start;
  run.stats = target.stats();
  measure(mesh, target.options().rho, run);
  return run;
}

}  // namespace tool
