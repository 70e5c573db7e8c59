// A graph behind a handle.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "handles.hpp"
#include "inputs.hpp"
#include "mesher/graph.hpp"

namespace lm {

/// The lists of a graph in rows of numbers; made when they are asked for.
struct FlatGraph {
  std::vector<std::int64_t> line_offsets, line_points;
  std::vector<std::int64_t> polygon_offsets, loop_offsets, loop_points;
  std::vector<std::int64_t> edge_offsets, inner_edges, inner_offsets, inner_points;
  std::vector<double> holes, regions, attributes, limits;
  std::vector<std::int64_t> hole_ids, region_ids;
};

struct GraphObject final : Object {
  using File = std::variant<mesher::GraphFile<2>, mesher::GraphFile<3>>;

  explicit GraphObject(File all, std::vector<std::string> of_it = {});

  [[nodiscard]] int dimension() const noexcept { return file.index() == 0 ? 2 : 3; }
  [[nodiscard]] const std::vector<std::string>* texts() override { return &notes; }
  /// The lists as they are now. Several readers may ask at a time.
  [[nodiscard]] const FlatGraph& flat();
  /// What was made of the graph is no longer true.
  void change() noexcept { flat_.reset(); }

  File file;
  NextIds next;
  std::vector<std::string> notes;

 private:
  std::mutex making_;
  std::optional<FlatGraph> flat_;
};

/// A graph of that dimension. Throws: Failure(LM_BAD_ARGUMENT).
template <int D>
[[nodiscard]] const mesher::GraphFile<D>& file_in(const GraphObject& graph) {
  const auto* file = std::get_if<mesher::GraphFile<D>>(&graph.file);
  if (file == nullptr) throw Failure(LM_BAD_ARGUMENT, "the graph is of the other dimension");
  return *file;
}

/// Throws: Error(unknown_id) if a line or a polygon names a point that does not exist.
template <int D>
void require_points(const mesher::Graph<D>& graph);

/// Runs body(); an Error that it throws gets the locations of its features in the graph's file.
template <int D, class Body>
auto with_locations(const mesher::GraphFile<D>& file, Body&& body) {
  try {
    return body();
  } catch (const mesher::Error& error) {
    if (file.file.empty()) throw;
    throw mesher::located(error, file);
  }
}

}  // namespace lm
