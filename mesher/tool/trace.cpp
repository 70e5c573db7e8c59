// mesher trace: what the mesher's engine did for a file of points and lines, for the tool `traces`.
#include <cstdio>
#include <memory>
#include <utility>

#include "arguments.hpp"
#include "cancel.hpp"
#include "commands.hpp"
#include "first_run.hpp"
#include "mesher/extra/edit_script.hpp"
#include "mesher/mesher.hpp"
#include "traces/recorder.hpp"
#include "traces/trace_file.hpp"

namespace tool {
namespace {

struct TraceArguments : MeshArguments {
  std::string script;
  std::string trace;
  bool edges = false;
};

// Throws: Error (cannot_write, bad_option) if the trace could not be written at the end.
void require_writable(const TraceArguments& args, const auto& input) {
  mesher::OutputFiles files;
  protect_inputs(args, input, files);
  if (!args.script.empty()) files.protect(args.script);
  files.open(args.trace);
}

template <int D>
void follow_script(const TraceArguments& args, Input<D>& input, mesher::Mesher<D>& mesher,
                   Progress& progress) {
  mesher::EditScript<D> script(args.script);
  std::size_t updates = 0;
  Watched watched(mesher, progress);
  try {
    while (auto edits = script.next()) {
      input.follow(*edits);
      mesher::apply(std::move(*edits), watched);
      progress.set_task("after " + std::to_string(++updates) + " updates, ");
    }
  } catch (const mesher::Error& error) {
    throw with_domain_hint<D>(input.located(error));
  }
}

traces::Recording record(const sac::Engine& engine, const std::string& path, traces::Edges edges) {
  require_uninterrupted();
  set_doomed({traces::temporary_of(path)});
  try {
    const traces::Recording recording = traces::Recorder(engine).record(path, edges);
    set_doomed({});
    return recording;
  } catch (const traces::FileError& error) {
    set_doomed({});
    throw mesher::Error(mesher::ErrorCode::cannot_write, error.what(), {path});
  }
}

template <int D>
void run_trace(const TraceArguments& args) {
  Input<D> input(args.input, faces(args));
  drop_copies();
  auto options = mesh_options(args, input);
  options.extent = mesher::Extent::box;
  require_writable(args, input);
  Progress progress(args.quiet);
  auto mesher = locating(input, [&] { return mesher::Mesher<D>(options); });
  insert_all(input, mesher, progress);
  if (!args.script.empty()) follow_script<D>(args, input, mesher, progress);
  const traces::Recording recording =
      record(mesher.engine(), args.trace, args.edges ? traces::Edges::yes : traces::Edges::no);
  progress.erase();
  if (!args.quiet) {
    std::printf("%s: %llu calls\n", args.trace.c_str(),
                static_cast<unsigned long long>(recording.calls));
  }
}

}  // namespace

void add_trace(CLI::App& app) {
  const auto args = std::make_shared<TraceArguments>();
  CLI::App* trace =
      app.add_subcommand("trace", "Records the engine's trace of a mesh and its updates.");
  add_program_options(*trace, *args);
  trace->add_option("--script", args->script, "Edits to apply before recording")
      ->type_name("EDITS");
  trace->add_option("-o", args->trace, "The recording")->required()->type_name("FILE.trace");
  trace->add_flag("--edges", args->edges, "Add the observations and effects of each call, as text");
  trace->add_flag("--quiet", args->quiet, "Print nothing but errors");
  trace->footer(
      "The tool 'traces' compares, audits and draws recordings. With --script the trace is\n"
      "that after the updates: the same as that of a fresh mesh of the edited input in the\n"
      "same domain, which by default is that of INPUT. Limits of size count in the whole\n"
      "domain, whatever lines enclose.\n"
      "Examples:\n"
      "  mesher trace points.node -o before.trace\n"
      "  mesher trace points.node --script edits.txt -o after.trace\n"
      "  traces distance before.trace after.trace");
  trace->callback([args] { dimension_of(*args) == 2 ? run_trace<2>(*args) : run_trace<3>(*args); });
}

}  // namespace tool
