// What several commands say and check.
#include <iostream>

#include "commands.hpp"

namespace tool {

void warn_of_unnamed(const std::string& path, const traces::Trace& trace) {
  if (trace.unnamed == 0) return;
  std::cerr << path << ": note: " << trace.unnamed << " of " << trace.calls.size()
            << " calls have arguments without a name (see traces/README.md): they can be compared "
               "within one engine only\n";
}

void print_json(const Json& object) {
  std::cout << object.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n';
}

void add_random_edits(CLI::App& sub, std::uint64_t& edits, std::uint64_t& seed,
                      const std::string& about_edits) {
  sub.add_option("--edits", edits, about_edits)
      ->check(is_count, "")
      ->type_name("K")
      ->capture_default_str();
  sub.add_option("--seed", seed, "The seed of input and edits")
      ->check(is_count, "")
      ->type_name("S")
      ->capture_default_str();
}

std::string is_count(const std::string& text) {
  const bool digits = text.find_first_not_of("0123456789") == std::string::npos;
  return digits ? "" : "'" + text + "' is not a number";
}

}  // namespace tool
