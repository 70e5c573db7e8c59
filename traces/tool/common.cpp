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

std::string is_count(const std::string& text) {
  const bool digits = text.find_first_not_of("0123456789") == std::string::npos;
  return digits ? "" : "'" + text + "' is not a number";
}

}  // namespace tool
