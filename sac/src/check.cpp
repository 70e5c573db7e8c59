// What a failed check says.
#include "sac/check.hpp"

#include "sac/internal/same.hpp"

namespace sac::detail {

namespace {

std::string describe(const char* what, const char* expression, const char* file, int line) {
  return std::string(what) + ": " + expression + " (" + file + ":" + std::to_string(line) + ")";
}

}  // namespace

void fail_expects(const char* expression, const char* file, int line) {
  throw UsageError(describe("requirement not met", expression, file, line));
}

void fail_invariant(const char* expression, const char* file, int line) {
  throw InvariantError(describe("broken invariant", expression, file, line));
}

void fail_unordered(std::string_view function) {
  throw UsageError("two calls of " + std::string(function) +
                   " are posted at one key, and their arguments are neither equal nor ordered: <=> "
                   "must tell apart what == tells apart");
}

}  // namespace sac::detail
