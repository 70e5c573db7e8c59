// traces: what a recorded run consists of, how far two runs are apart, and why.
#include <exception>
#include <iostream>
#include <new>

#include "commands.hpp"
#include "mesher/error.hpp"
#include "shell/shell.hpp"
#include "traces/trace_file.hpp"

namespace {

using tool::Exit;

constexpr const char* kHelpFooter =
    "Examples:\n"
    "  mesher trace points.node -o a.trace     records a trace for these commands\n"
    "  traces example quicksort -o q.trace     records a trace of an example of the engine\n"
    "  traces show a.trace --limit 20          the first calls, one per line: depth and label\n"
    "  traces distance a.trace b.trace         counts the calls of only one of two runs\n"
    "  traces distance a.trace b.trace --json\n"
    "  traces audit a.trace                    is the program concise?\n"
    "  traces audit a.trace b.trace            and monotone?\n"
    "  traces render a.trace b.trace -o c.svg  draws both runs, and their difference\n"
    "  traces stability --n 1000 --edits 100   changes and costs of random edits of meshes\n"
    "Exit codes: 0 ok, 1 a finding, 2 usage, 3 a file is no trace or cannot be used,\n"
    "4 out of memory, 70 a bug.";

int run(int argc, char** argv) {
  CLI::App app{"Compares, audits and draws recorded traces of self-adjusting programs.", "traces"};
  app.footer(kHelpFooter);
  app.set_version_flag("--version", "traces " TRACES_VERSION);
  app.require_subcommand(1);
  int exit_code = Exit::kOk;
  tool::add_example(app);
  tool::add_show(app);
  tool::add_distance(app);
  tool::add_audit(app, exit_code);
  tool::add_render(app);
  tool::add_stability(app, exit_code);
  tool::shell::add_commands(app);
  try {
    app.parse(argc, argv);
    return exit_code;
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    std::cerr << "error[bad_option]: " << error.what() << "; see 'traces --help'\n";
    return Exit::kUsage;
  }
}

int fail(Exit code, const std::string& message) {
  std::cerr << message << '\n';
  return code;
}

// An output that cannot be written is a file that cannot be used, as an input is.
Exit exit_of(const mesher::Error& error) {
  return error.code() == mesher::ErrorCode::bad_option ? Exit::kUsage : Exit::kFile;
}

}  // namespace

int main(int argc, char** argv) {
  std::ios::sync_with_stdio(false);
  try {
    const int code = run(argc, argv);
    std::cout.flush();
    return std::cout ? code : fail(Exit::kFile, "error[io]: writing the output failed");
  } catch (const traces::FileError& error) {
    std::cout.flush();
    return fail(Exit::kFile, error.what());
  } catch (const mesher::Error& error) {
    return fail(exit_of(error), error.what());
  } catch (const std::bad_alloc&) {
    return fail(Exit::kLimit, "error[too_many]: out of memory");
  } catch (const std::exception& error) {
    return fail(Exit::kBug, std::string("error[bug]: ") + error.what() +
                                "; this is our mistake: please report it with the files");
  }
}
