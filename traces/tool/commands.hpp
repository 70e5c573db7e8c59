// The subcommands. Each adds itself, with its options and help, to the command line, and runs when
// it is parsed; failures leave as exceptions that main.cpp handles.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "traces/trace.hpp"

namespace tool {

/// What the process exits with.
enum Exit { kOk = 0, kFound = 1, kUsage = 2, kFile = 3, kLimit = 4, kBug = 70 };

/// Keeps the order in which fields are given.
using Json = nlohmann::ordered_json;

void add_example(CLI::App& app);
void add_show(CLI::App& app);
void add_distance(CLI::App& app);
/// `exit_code` becomes kFound if something is found.
void add_audit(CLI::App& app, int& exit_code);
void add_render(CLI::App& app);
void add_stability(CLI::App& app, int& exit_code);

/// Says on standard error that hashes of calls without names mean nothing in another run.
void warn_of_unnamed(const std::string& path, const traces::Trace& trace);

/// Prints one line. Names come from files: what is no UTF-8 is replaced.
void print_json(const Json& object);

/// --edits and --seed.
void add_random_edits(CLI::App& sub, std::uint64_t& edits, std::uint64_t& seed,
                      const std::string& about_edits);

/// An option's check: what is wrong with `text`, or nothing. CLI11 takes -1 for a large number.
[[nodiscard]] std::string is_count(const std::string& text);
/// An option's check: `name` is an example of the engine.
[[nodiscard]] std::string is_example(const std::string& name);

}  // namespace tool
