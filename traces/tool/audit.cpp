// traces audit: is the program concise, is it monotone?
#include "traces/audit.hpp"

#include <algorithm>
#include <iostream>
#include <memory>
#include <vector>

#include "commands.hpp"

namespace tool {
namespace {

// Repeated labels that are printed of a trace.
constexpr std::size_t kShown = 10;

struct Arguments {
  std::string a;
  std::string b;
};

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

// Whether anything was found.
bool audit(const Arguments& args) {
  const traces::Trace a = traces::load_trace(args.a);
  bool found = audit_concise(args.a, a);
  if (args.b.empty()) return found;
  const traces::Trace b = traces::load_trace(args.b);
  warn_of_unnamed(args.a, a);
  warn_of_unnamed(args.b, b);
  if (audit_concise(args.b, b)) found = true;
  if (audit_monotone(args, a, b)) found = true;
  return found;
}

}  // namespace

void add_audit(CLI::App& app, int& exit_code) {
  const auto args = std::make_shared<Arguments>();
  CLI::App* sub = app.add_subcommand(
      "audit", "Looks for equal labels in a trace, and for common calls in another order");
  sub->add_option("A", args->a, "A trace file")->required();
  sub->add_option("B", args->b, "A trace of the same program on other input");
  sub->callback([args, &exit_code] {
    if (audit(*args)) exit_code = kFound;
  });
}

}  // namespace tool
