// Exits with 0 if the self-test refuses this build, which contracts a*b+c; 77 where it cannot run.
#include <cstdio>
#include <stdexcept>

#include "mesher/predicates.hpp"

int main() {
  if (!__builtin_cpu_supports("fma")) return 77;
  try {
    mesher::predicates::self_test();
  } catch (const std::logic_error& error) {
    std::printf("%s\n", error.what());
    return 0;
  }
  std::printf("a build that contracts a*b+c is accepted\n");
  return 1;
}
