// The first mesh of an input, made with or without the engine.
#pragma once

#include "input.hpp"
#include "mesher/domain_mesh.hpp"
#include "progress.hpp"
#include "report.hpp"

namespace tool {

/// Announces all of the input to a mesher of its dimension. Throws: as the mesher.
template <class Target>
void announce(const Input& input, Target& target) {
  mesher::announce(input.graph(), target);
}
template <class Target>
void announce(const SpaceInput& input, Target& target) {
  mesher::announce(input.graph(), target);
}

/// A Mesher or DomainMesher for the input: that of `arguments`, of which options are the first.
/// Throws: Error(bad_option), said of the file.
template <class Mesher>
[[nodiscard]] Mesher mesher_for(const Standing& input, const auto&... arguments) {
  return locating(input, [&] { return Mesher(arguments...); });
}

/// Gives `target` the input and updates it.
/// Throws: Error, said of the line of the feature to blame or of the file; Error(cancelled).
template <class Input, class Target>
void insert_all(const Input& input, Target& target, Progress& progress) {
  locating(input, [&] {
    announce(input, target);
    Watched(target, progress).update();
  });
}

/// Runs `target`, a mesher without input, on the input. Throws: Error, as insert_all.
template <int D, class Target>
RunOf<D> first_run(const InputOf<D>& input, Target& target, Progress& progress) {
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
