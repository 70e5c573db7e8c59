// The subcommands. Each adds itself, with its options, help and examples, to the command line, and
// runs when it is parsed. Failures leave as mesher::Error.
#pragma once

#include <CLI/CLI.hpp>

namespace tool {

void add_gen(CLI::App& app);
void add_mesh(CLI::App& app);
void add_edit(CLI::App& app);
void add_view(CLI::App& app);  // where Boost is
void add_repair(CLI::App& app);
void add_check(CLI::App& app);
void add_trace(CLI::App& app);

}  // namespace tool
