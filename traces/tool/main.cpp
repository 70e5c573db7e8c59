// traces: what a recorded run consists of, how far two runs are apart, and why.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <exception>
#include <iostream>
#include <limits>
#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "traces/audit.hpp"
#include "traces/distance.hpp"
#include "traces/trace.hpp"
#include "traces/trace_file.hpp"

namespace {

constexpr const char* kHelpFooter =
    "Examples:\n"
    "  traces show a.trace --limit 20          the first calls, one a line: depth and label\n"
    "  traces distance a.trace b.trace         calls that only one of two runs makes\n"
    "  traces distance a.trace b.trace --json\n"
    "  traces audit a.trace                    is the program concise?\n"
    "  traces audit a.trace b.trace            and monotone?\n"
    "Exit codes: 0 ok, 1 audit found something, 2 usage, 3 a file is no trace or cannot be used,\n"
    "4 out of memory, 70 a bug of ours.";

enum Exit { kOk = 0, kFound = 1, kUsage = 2, kFile = 3, kLimit = 4, kBug = 70 };

// Repeated labels that audit prints for a trace.
constexpr std::size_t kShown = 10;

struct Arguments {
  std::string a;
  std::string b;
  std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();
  bool json = false;
};

// Hashes of such calls mean nothing in another run: whoever compares must know.
void warn_of_unnamed(const std::string& path, const traces::Trace& trace) {
  if (trace.unnamed == 0) return;
  std::cerr << path << ": note: " << trace.unnamed << " of " << trace.calls.size()
            << " calls have arguments without a name (see traces/README.md): they can be compared "
               "within one engine only\n";
}

// --- distance --------------------------------------------------------------------------------

nlohmann::ordered_json to_json(const traces::CallCounts& counts) {
  return {{"distance", counts.distance()},
          {"common", counts.common},
          {"calls_a", counts.calls_a},
          {"calls_b", counts.calls_b}};
}

void print_row(const traces::CallCounts& counts, const std::string& name) {
  const std::string cells[] = {std::to_string(counts.distance()), std::to_string(counts.common),
                               std::to_string(counts.calls_a), std::to_string(counts.calls_b)};
  for (const std::string& cell : cells) {
    std::cout << std::string(cell.size() < 10 ? 10 - cell.size() : 0, ' ') << cell << ' ';
  }
  std::cout << ' ' << name << '\n';
}

void print_distance(const traces::Distance& d) {
  std::cout << "  distance     common    calls_a    calls_b   function\n";
  for (const auto& [name, counts] : d.by_function) print_row(counts, name);
  print_row(d.all, "all");
}

int distance(const Arguments& args) {
  const traces::Trace a = traces::load_trace(args.a), b = traces::load_trace(args.b);
  warn_of_unnamed(args.a, a);
  warn_of_unnamed(args.b, b);
  const traces::Distance d = traces::distance(a, b);
  if (!args.json) return print_distance(d), kOk;
  nlohmann::ordered_json object = to_json(d.all);
  object["unnamed_a"] = a.unnamed;
  object["unnamed_b"] = b.unnamed;
  object["functions"] = nlohmann::ordered_json::object();
  for (const auto& [name, counts] : d.by_function) object["functions"][name] = to_json(counts);
  // Names come from files: what is no UTF-8 is replaced.
  std::cout << object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  return kOk;
}

// --- audit -----------------------------------------------------------------------------------

// Prints what is wrong; whether anything is.
bool audit_concise(const std::string& path, const traces::Trace& trace) {
  const traces::Conciseness result = traces::check_concise(trace);
  if (result.surplus == 0) return false;
  std::cout << path << ": not concise: " << result.surplus
            << " calls have the label of an earlier call\n";
  const std::size_t shown = std::min(kShown, result.repetitions.size());
  std::vector<std::uint32_t> calls;
  for (std::size_t i = 0; i < shown; ++i) calls.push_back(result.repetitions[i].first);
  const auto labels = traces::labels_at(path, calls);
  for (std::size_t i = 0; i < shown; ++i) {
    const traces::Repetition& r = result.repetitions[i];
    std::cout << "  " << labels[i] << ": " << r.times << " times, first as calls " << r.first
              << " and " << r.second << '\n';
  }
  if (shown < result.repetitions.size()) {
    std::cout << "  and " << result.repetitions.size() - shown << " more labels\n";
  }
  return true;
}

void print_places(const Arguments& args, const std::string& label, const traces::Pair& pair) {
  std::cout << "  " << label << ": call " << pair.a << " of " << args.a << ", call " << pair.b
            << " of " << args.b << '\n';
}

bool audit_monotone(const Arguments& args, const traces::Trace& a, const traces::Trace& b) {
  const traces::Monotonicity result = traces::check_monotone(a, b);
  if (!result.first) return false;
  std::cout << args.a << ", " << args.b << ": not monotone: " << result.moved << " of "
            << result.common << " common calls are in another order; the first pair:\n";
  const auto labels = traces::labels_at(args.a, {result.first->left.a, result.first->right.a});
  print_places(args, labels[0], result.first->left);
  print_places(args, labels[1], result.first->right);
  return true;
}

int audit(const Arguments& args) {
  const traces::Trace a = traces::load_trace(args.a);
  bool found = audit_concise(args.a, a);
  if (!args.b.empty()) {
    const traces::Trace b = traces::load_trace(args.b);
    warn_of_unnamed(args.a, a);
    warn_of_unnamed(args.b, b);
    if (audit_concise(args.b, b)) found = true;
    if (audit_monotone(args, a, b)) found = true;
  }
  return found ? kFound : kOk;
}

// --- show ------------------------------------------------------------------------------------

int show(const Arguments& args) {
  traces::TraceReader reader(args.a);
  for (std::uint64_t shown = 0; shown < args.limit; ++shown) {
    const traces::CallRecord* call = reader.next();
    if (call == nullptr) break;
    std::cout << call->depth << ' '
              << traces::label_text(reader.functions()[call->function], call->arguments)
              << (call->named ? "" : "  [unnamed]") << '\n';
  }
  return kOk;
}

// ---------------------------------------------------------------------------------------------

// An option's check: what is wrong with `text`, or nothing. CLI11 takes -1 for a large number.
std::string is_count(const std::string& text) {
  const bool digits = text.find_first_not_of("0123456789") == std::string::npos;
  return digits ? "" : "'" + text + "' is not a number of calls";
}

int run(int argc, char** argv) {
  CLI::App app{"Compares and audits recorded traces of self-adjusting programs.", "traces"};
  app.footer(kHelpFooter);
  app.require_subcommand(1);
  Arguments args;
  int exit_code = kOk;
  const auto add = [&](const char* name, const char* what, int (*command)(const Arguments&)) {
    CLI::App* sub = app.add_subcommand(name, what);
    sub->add_option("A", args.a, "A trace file")->required();
    sub->callback([&, command] { exit_code = command(args); });
    return sub;
  };
  CLI::App* sub = add("distance", "Counts the calls that only one of two traces has", &distance);
  sub->add_option("B", args.b, "Another trace file")->required();
  sub->add_flag("--json", args.json, "One JSON object instead of a table");
  sub = add("audit", "Looks for equal labels in a trace, and for common calls in another order",
            &audit);
  sub->add_option("B", args.b, "A trace of the same program on other input");
  sub = add("show", "Prints the calls in pre-order: depth and label", &show);
  sub->add_option("--limit", args.limit, "At most so many calls")
      ->type_name("N")
      ->check(is_count, "");
  try {
    app.parse(argc, argv);
    return exit_code;
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    std::cerr << "error[bad_option]: " << error.what() << "; see 'traces --help'\n";
    return kUsage;
  }
}

int fail(Exit code, const std::string& message) {
  std::cerr << message << '\n';
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  std::ios::sync_with_stdio(false);
  try {
    const int code = run(argc, argv);
    std::cout.flush();
    return std::cout ? code : fail(kFile, "error[io]: writing the output failed");
  } catch (const traces::FileError& error) {
    std::cout.flush();
    return fail(kFile, error.what());
  } catch (const std::bad_alloc&) {
    return fail(kLimit, "error[too_many]: out of memory");
  } catch (const std::exception& error) {
    return fail(kBug, std::string("error[bug]: ") + error.what() +
                          "; this is our mistake: please report it with the files");
  }
}
