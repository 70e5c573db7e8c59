// The first mesh of an input, made with or without the engine.
#pragma once

#include <string>

#include "input.hpp"
#include "mesher/domain_mesh.hpp"
#include "progress.hpp"
#include "report.hpp"

namespace tool {

struct Result {
  mesher::DomainMesh mesh;
  Run run;
  std::string angles;  // what small angles of the input do to the mesh
};

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
Result first_run(const Input& input, double rho, Target& target, Progress& progress) {
  const double start = mesher::now();
  insert_all(input, target, progress);
  Result result{target.domain_mesh(), {}, {}};
  result.run.seconds_total = mesher::now() - start;
  result.run.stats = target.stats();
  measure(result.mesh, rho, result.run);
  return result;
}

}  // namespace tool
