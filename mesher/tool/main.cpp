// mesher: quality meshes of files of points and lines, or of points in space, that follow edits.
#include <algorithm>
#include <exception>
#include <iostream>
#include <iterator>
#include <new>
#include <string>
#include <string_view>

#include "cancel.hpp"
#include "commands.hpp"
#include "memory.hpp"
#include "mesher/error.hpp"
#include "mesher/predicates.hpp"
#include "pipe.hpp"
#include "platform/process.hpp"
#include "shell/shell.hpp"

namespace {

using mesher::ExitCode;

constexpr const char* kHelpFooter =
    "Examples:\n"
    "  mesher mesh lake.poly -o lake.1.node -o lake.svg\n"
    "  mesher edit lake.poly --script wall.txt -o after.1.node --stats updates.jsonl\n"
    "  mesher mesh scan.ply -o scan.vtu -o scan.svg\n"
    "  mesher repair roads.geojson -o roads.poly\n"
    "  mesher check after.1.node --rho 1.4142\n"
    "  mesher gen uniform --n 10000 -o points.node\n"
    "  mesher trace points.node --script edits.txt -o after.trace\n"
    "'mesher COMMAND --help' describes a command.\n"
    "Exit codes: 0 ok, 1 geometry, 2 usage, 3 format, 4 limit, 5 cancelled, 70 a bug.";

struct Command {
  std::string_view name;
  void (*add)(CLI::App&);
};
constexpr Command kCommands[] = {
    {"gen", tool::add_gen},       {"mesh", tool::add_mesh},   {"edit", tool::add_edit},
#ifdef MESHER_HAS_VIEW
    {"view", tool::add_view},
#endif
    {"repair", tool::add_repair}, {"check", tool::add_check}, {"trace", tool::add_trace}};

// The one that is called, or all: each has some thirty options, which take longer to add than a
// small mesh to make.
void add_commands(CLI::App& app, std::string_view called) {
  const auto is_called = [&](const Command& c) { return c.name == called; };
  const bool any = std::any_of(std::begin(kCommands), std::end(kCommands), is_called);
  for (const Command& command : kCommands) {
    if (!any || is_called(command)) command.add(app);
  }
  if (!any) tool::shell::add_commands(app);
}

int fail(ExitCode code, const std::string& message) {
  std::cerr << tool::with_own_paths(message) << std::endl;
  return static_cast<int>(code);
}

int run(int argc, char** argv) {
  CLI::App app{
      "Makes quality Delaunay meshes of points and lines in the plane, and of points, lines\n"
      "and polygons in space, and updates them under edits.",
      "mesher"};
  app.footer(kHelpFooter);
  app.set_version_flag("--version", "mesher " MESHER_VERSION);
  app.require_subcommand(1);
  add_commands(app, argc > 1 ? argv[1] : "");
  try {
    app.parse(argc, argv);
    return static_cast<int>(ExitCode::ok);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return fail(ExitCode::usage,
                std::string("error[bad_option]: ") + error.what() + "; see 'mesher --help'");
  }
}

}  // namespace

int main(int argc, char** argv) {
  tool::catch_interrupts();
  tool::platform::return_failures_of_writes();
  tool::bound_memory();
  try {
    mesher::predicates::self_test();
    return run(argc, argv);
  } catch (const mesher::Error& error) {
    const bool stopped = error.code() == mesher::ErrorCode::cancelled;
    return fail(mesher::exit_code(error.code()), stopped ? tool::kStopped : error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::limit, "error[too_many]: " + tool::out_of_memory());
  } catch (const std::exception& error) {
    return fail(ExitCode::bug, std::string("error[bug]: ") + error.what() +
                                   "; this is our mistake: please report it with the input");
  }
}
