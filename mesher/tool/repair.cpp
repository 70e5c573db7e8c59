// mesher repair: what crosses, touches or overlaps in a file, made to fit together.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "commands.hpp"
#include "mesher/write.hpp"
#include "outputs.hpp"
#include "report.hpp"

namespace tool {
namespace {

using mesher::Error;
using mesher::ErrorCode;

// A file for each output, all of formats that hold the graph.
template <int D>
std::vector<mesher::TextFile*> open_graphs(const MeshArguments& args, const Input<D>& input,
                                           CommandFiles& outputs) {
  protect_inputs(args, input, outputs);
  std::vector<mesher::TextFile*> files;
  for (const std::string& path : args.outputs) {
    const std::string extension = std::filesystem::path(path).extension().string();
    const char* const other = D == 2 ? ".obj" : ".smesh";
    if (extension != ".poly" && extension != other) {
      throw Error(ErrorCode::unknown_format,
                  std::string("a repaired file is written to .poly and ") + other, {path});
    }
    if constexpr (D == 3) {
      if (extension == other) mesher::require_single_loops(input.graph());
    }
    files.push_back(&outputs.open(path));
  }
  return files;
}

template <int D>
std::string contents(const mesher::Graph<D>& graph) {
  std::string text = counted(graph.points.size(), "point") + ", " +
                     counted(mesher::segments_of(graph).size(), "segment");
  if constexpr (D == 3) text += ", " + counted(graph.polygons.size(), "polygon");
  return text;
}

template <int D>
void run_repair_in(const MeshArguments& args) {
  const Input<D> input = read_input<D>(args);
  CommandFiles outputs;
  const auto files = open_graphs(args, input, outputs);
  for (std::size_t i = 0; i < files.size(); ++i) {
    write_graph(input.graph(), args.outputs[i], *files[i]);
  }
  const auto targets = outputs.targets();
  if (!args.quiet) {
    print_notes(input.notes());
    if (input.leaves_faces()) {
      std::fprintf(stderr, "%s: note: its vertices are read; --surface repairs its faces, too\n",
                   input.path().c_str());
    }
    print_repairs(input);
  }
  outputs.commit();
  if (args.quiet) return;
  const std::size_t changes = input.repairs().size();
  if (changes == 0) {
    std::printf("%s; nothing was to be repaired\n", contents(input.graph()).c_str());
  } else {
    std::printf("%s; %s, which move what is there by at most %.2g\n",
                contents(input.graph()).c_str(), counted(changes, "repair").c_str(),
                input.deviation());
  }
  print_outputs(targets);
}

}  // namespace

void add_repair(CLI::App& app) {
  const auto args = std::make_shared<MeshArguments>();
  args->repair = true;
  CLI::App* repair = app.add_subcommand(
      "repair", "Makes what crosses, touches or overlaps in a file fit together.");
  add_input_options(*repair, *args);
  repair
      ->add_option("-o", args->outputs,
                   "Output: .poly, in the plane .obj, in space .smesh; may be repeated. Without\n"
                   "it, only say what would be repaired")
      ->type_name("OUT")
      ->allow_extra_args(false);
  add_tolerance_option(*repair, args->repair_tolerance);
  repair->add_flag("--quiet", args->quiet, "Print nothing but errors");
  repair->footer(
      "These are the repairs of 'mesh --repair': lines (in space also polygons) that cross or\n"
      "touch get common points there, points at one position become one, what several cover\n"
      "belongs to the smallest id, polygons that are not flat become triangles. Each repair is\n"
      "reported. What needs none is written as it is; in OUT, segments and polygons are numbered\n"
      "anew.\n"
      "Examples:\n"
      "  mesher repair roads.geojson -o roads.poly\n"
      "  mesher repair part.stl --surface\n"
      "  mesher repair part.stl --merge -o part.poly");
  repair->callback(
      [args] { dimension_of(*args) == 3 ? run_repair_in<3>(*args) : run_repair_in<2>(*args); });
}

}  // namespace tool
