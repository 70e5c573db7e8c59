// The first mesh of an input, made with or without the engine.
#pragma once

#include "input.hpp"
#include "mesher/domain_mesh.hpp"
#include "progress.hpp"
#include "report.hpp"

namespace tool {

/// Gives `target` the input and updates it.
/// Throws: Error, said of the line of the feature to blame or of the file; Error(cancelled).
template <class Target>
void insert_all(const Input& input, Target& target, Progress& progress) {
  try {
    mesher::announce(input.graph(), target);
    Watched(target, progress).update();
  } catch (const mesher::Error& error) {
    throw input.located(error);
  }
}

/// Runs `target`, a mesher without input for this rho, on the input. Throws: Error, as insert_all.
template <class Target>
Run first_run(const Input& input, double rho, Target& target, Progress& progress) {
  const double start = mesher::now();
  insert_all(input, target, progress);
  const mesher::DomainMesh& mesh = target.domain_mesh();
  Run run;
  run.seconds_total = mesher::now() - start;
  run.stats = target.stats();
  measure(mesh, rho, run);
  return run;
}

}  // namespace tool
