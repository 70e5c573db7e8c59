// traces show: the calls of a trace, one a line.
#include <cstdint>
#include <iostream>
#include <limits>
#include <memory>

#include "commands.hpp"
#include "traces/trace_file.hpp"

namespace tool {
namespace {

struct Arguments {
  std::string a;
  std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();
};

void show(const Arguments& args) {
  traces::TraceReader reader(args.a);
  for (std::uint64_t shown = 0; shown < args.limit; ++shown) {
    const traces::CallRecord* call = reader.next();
    if (call == nullptr) break;
    std::cout << call->depth << ' '
              << traces::label_text(reader.functions()[call->function], call->arguments)
              << (call->named ? "" : "  [unnamed]") << '\n';
    for (const traces::EdgeRecord& edge : call->edges) {
      std::cout << "  " << traces::edge_text(edge) << '\n';
    }
  }
}

}  // namespace

void add_show(CLI::App& app) {
  const auto args = std::make_shared<Arguments>();
  CLI::App* sub = app.add_subcommand("show", "Prints the calls in pre-order: depth and label");
  sub->add_option("A", args->a, "A trace file")->required();
  sub->add_option("--limit", args->limit, "The largest number of calls to print")
      ->type_name("N")
      ->check(is_count, "");
  sub->callback([args] { show(*args); });
}

}  // namespace tool
