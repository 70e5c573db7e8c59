// traces example: records an example of the engine.
#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "example_subject.hpp"

namespace tool {
namespace {

struct Arguments {
  std::string name;
  std::string output;
  int n = 100;
  std::uint64_t edits = 0;
  std::uint64_t seed = 1;
  bool with_edges = false;
};

void run(const Arguments& args) {
  const auto subject = make_example(args.name, args.seed, args.n);
  sac::Counts last;
  for (std::uint64_t i = 0; i < args.edits; ++i) last = subject->edit().work;
  const auto recording =
      subject->record(args.output, args.with_edges ? traces::Edges::yes : traces::Edges::no);
  std::cout << args.output << ": " << recording.calls << " calls";
  if (args.edits > 0) {
    std::cout << "; the last edit: " << last.executed << " executed, " << last.created
              << " created, " << last.discarded << " discarded";
  }
  std::cout << '\n';
}

std::string listed(const char* between) {
  std::string all;
  for (const std::string& name : example_names()) all += (all.empty() ? "" : between) + name;
  return all;
}

}  // namespace

std::string is_example(const std::string& name) {
  const std::vector<std::string> names = example_names();
  if (std::find(names.begin(), names.end(), name) != names.end()) return "";
  return "'" + name + "' is no example; there are " + listed(", ");
}

void add_example(CLI::App& app) {
  const auto args = std::make_shared<Arguments>();
  CLI::App* sub =
      app.add_subcommand("example", "Runs an example of the engine, edits its input, records it");
  sub->add_option("NAME", args->name, "The example")
      ->required()
      ->check(CLI::Validator(is_example, "{" + listed(",") + "}"));
  sub->add_option("-o", args->output, "The trace")->required()->type_name("FILE.trace");
  sub->add_option("--n", args->n, "About how many elements the input has; 0 to 100000")
      ->check(CLI::Range(0, 100'000), "")
      ->type_name("N")
      ->capture_default_str();
  add_random_edits(*sub, args->edits, args->seed, "Random edits, each propagated");
  sub->add_flag("--edges", args->with_edges, "Add the reads and effects of each call");
  sub->footer(
      "Runs with one seed make the same edits. To draw the change of the fifth edit:\n"
      "  traces example quicksort --edits 4 -o before.trace\n"
      "  traces example quicksort --edits 5 -o after.trace\n"
      "  traces render before.trace after.trace -o edit.svg");
  sub->callback([args] { run(*args); });
}

}  // namespace tool
