// The first mesh of an input, made with or without the engine.
#pragma once

#include <string>

#include "mesher/check.hpp"
#include "mesher/edit_script.hpp"
#include "mesher/io.hpp"
#include "progress.hpp"
#include "report.hpp"

namespace tool {

struct Result {
  mesher::Mesh<2> mesh;
  Run run;
};

/// Throws the error that the first refused point makes, said of its line; else `error`, said of the
/// file.
template <class Target>
[[noreturn]] void throw_with_place(const mesher::PointFile<2>& input, Target& target,
                                   const mesher::Error& error) {
  for (std::size_t i = 0; i < input.points.size(); ++i) {
    try {
      target.insert(input.ids[i], input.points[i]);
    } catch (const mesher::Error& refusal) {
      throw refusal.at(input.place(i));
    }
  }
  throw error.at({input.file});
}

/// Gives `target` the points and updates it.
/// Throws: Error, said of the line of the point to blame or of the file; Error(cancelled).
template <class Target>
void insert_all(const mesher::PointFile<2>& input, Target& target, Progress& progress) {
  try {
    target.insert(input.ids, input.points);
  } catch (const mesher::Error& error) {
    throw_with_place(input, target, error);
  }
  try {
    Watched(target, progress).update();
  } catch (const mesher::Error& error) {
    if (error.code() == mesher::ErrorCode::cancelled) throw;
    throw error.at({input.file});
  }
}

/// Runs `target`, a mesher without points, on the input. Throws: Error, as insert_all.
template <class Target>
Result first_run(const mesher::PointFile<2>& input, Target& target, Progress& progress) {
  const double start = mesher::now();
  insert_all(input, target, progress);
  Result result{target.mesh(), {}};
  result.run.seconds_total = mesher::now() - start;
  result.run.stats = target.stats();
  result.run.quality = mesher::quality(result.mesh);
  return result;
}

}  // namespace tool
