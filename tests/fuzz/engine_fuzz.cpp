// Any bytes are a program and a sequence of edits (tests/support/program_case.hpp): libFuzzer
// looks for those with which the engine does not agree with a run from scratch.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "program_case.hpp"
#include "program_oracle.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const support::Case c = support::decode({data, size});
  const std::string fault = support::fault_of(c);
  if (fault.empty()) return 0;
  std::fprintf(stderr, "%s%s\n", support::describe(c).c_str(), fault.c_str());
  std::abort();
}
