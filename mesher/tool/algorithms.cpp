// From the command's arguments to calls of the library.
#include "algorithms.hpp"

#include <cstdio>
#include <string>
#include <vector>

#include "first_run.hpp"
#include "mesher/mesher.hpp"
#include "mesher/refine.hpp"
#include "mesher/svr.hpp"

namespace tool {
namespace {

bool has_lines(const Input& input) { return !segments_of(input.graph()).empty(); }
bool has_lines(const SpaceInput& input) {
  return !input.graph().segments.empty() || !input.graph().facets.empty();
}

template <int D>
std::vector<mesher::Point<D>> places(const std::vector<mesher::InputPoint<D>>& points) {
  std::vector<mesher::Point<D>> all;
  for (const auto& point : points) all.push_back(point.at);
  return all;
}

template <int D>
struct Task {
  const MeshArguments& args;
  const InputOf<D>& input;
  const mesher::Options<D>& options;
  AnyRun& run;
  Progress& progress;
};

template <int D>
mesher::Mesh<D> by_gap_balls(const Task<D>& task, bool with_engine) {
  if (!with_engine) {
    return locating(task.input, [&] {
      const StopPolitely stop;
      return mesher::mesh_statically(task.input.graph(), task.options, &task.run.stats,
                                     task.progress.control());
    });
  }
  auto mesher = mesher_for<mesher::Mesher<D>>(task.input, task.options);
  insert_all(task.input, mesher, task.progress);
  task.run.stats = mesher.stats();
  return mesher.mesh();
}

// of_points(places, ids, stats, control), of_graph(graph, extent, stats, control).
template <class Stats, int D, class OfPoints, class OfGraph>
mesher::Mesh<D> by_refinement(const Task<D>& task, OfPoints&& of_points, OfGraph&& of_graph) {
  Stats stats;
  Stats* const wanted = task.args.stats.empty() ? nullptr : &stats;
  mesher::Mesh<D> mesh = locating(task.input, [&] {
    const StopPolitely stop;
    if (has_lines(task.input)) {
      return of_graph(task.input.graph(), extent(task.args), wanted, task.progress.control());
    }
    const auto points = task.input.points();
    std::vector<mesher::FeatureId> ids;
    for (const auto& point : points) ids.push_back(point.id);
    return of_points(places<D>(points), ids, wanted, task.progress.control());
  });
  task.run.stats.vertices = mesh.vertices.size();
  task.run.stats.simplices = mesh.simplices.size();
  if (wanted != nullptr) {
    static_cast<Stats&>(task.run.refinement.emplace()) = stats;
  }
  return mesh;
}

template <int D>
mesher::Mesh<D> by_svr(const Task<D>& task) {
  const auto& options = task.options;
  return by_refinement<mesher::SvrStats>(
      task,
      [&](const auto& places, const auto& ids, auto* stats, const auto& control) {
        return mesher::svr<D>(places, options, {}, ids, stats, control);
      },
      [&](const auto& graph, auto extent, auto* stats, const auto& control) {
        return mesher::svr(graph, options, extent, {}, stats, control);
      });
}

template <int D>
mesher::Mesh<D> by_refine(const Task<D>& task) {
  const auto& options = task.options;
  return by_refinement<mesher::RefineStats>(
      task,
      [&](const auto& places, const auto& ids, auto* stats, const auto& control) {
        return mesher::refine<D>(places, options, {}, ids, stats, control);
      },
      [&](const auto& graph, auto extent, auto* stats, const auto& control) {
        return mesher::refine(graph, options, extent, {}, stats, control);
      });
}

template <int D>
mesher::Mesh<D> by(const std::string& algorithm, const Task<D>& task, bool with_engine) {
  task.run.algorithm = algorithm;
  if (algorithm == "svr") return by_svr(task);
  if (algorithm == "refine") return by_refine(task);
  return by_gap_balls(task, with_engine);
}

// Of those that know what is asked for. In the plane refine takes as long as svr, for fewer
// vertices; in space the triangulation of all points may be large.
template <int D>
const char* fastest(const Task<D>& task) {
  const mesher::Options<D>& o = task.options;
  const bool limited = o.max_measure != 0 || o.sizes != nullptr || !o.box_limits.empty() ||
                       o.region_limits != nullptr;
  const bool low = has_lines(task.input) && o.rho < mesher::Options<D>{}.rho;
  if (task.args.is_static || limited || low || o.rule != mesher::Rule::radius_edge) {
    return "gap-balls";
  }
  const bool refines =
      D == 2 || (!has_lines(task.input) && mesher::are_even<D>(places<D>(task.input.points())));
  return refines ? "refine" : "svr";
}

}  // namespace

template <int D>
mesher::Mesh<D> mesh_by_algorithm(const MeshArguments& args, const InputOf<D>& input,
                                  const mesher::Options<D>& options, AnyRun& run,
                                  Progress& progress) {
  const Task<D> task{args, input, options, run, progress};
  if (args.algorithm != "auto") return by(args.algorithm, task, !args.is_static);
  const std::string algorithm = fastest(task);
  if (algorithm == "gap-balls") return by(algorithm, task, false);
  try {
    return by(algorithm, task, false);
  } catch (const mesher::Error& e) {
    if (e.code() != mesher::ErrorCode::too_close && e.code() != mesher::ErrorCode::too_many) throw;
    progress.erase();
    if (!args.quiet) {
      std::fprintf(stderr, "%s: %s; now by gap-balls\n", algorithm.c_str(), e.what());
    }
  }
  return by("gap-balls", task, false);
}

template mesher::Mesh<2> mesh_by_algorithm<2>(const MeshArguments&, const Input&,
                                              const mesher::Options<2>&, AnyRun&, Progress&);
template mesher::Mesh<3> mesh_by_algorithm<3>(const MeshArguments&, const SpaceInput&,
                                              const mesher::Options<3>&, AnyRun&, Progress&);

}  // namespace tool
