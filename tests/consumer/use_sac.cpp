// The first example of the engine, as a user compiles it.
#include <cstdio>
#include <sac/sac.hpp>

void add(sac::Scope& s, sac::Mod<int> a, sac::Mod<int> b, sac::Mod<int> out) {
  s.write(out, s.read(a) + s.read(b));
}

int main() {
  sac::Engine e;
  auto a = e.input(3), b = e.input(4);
  auto sum = e.cell<int>();
  e.run<add>(a, b, sum);
  const int before = e.get(sum);
  e.set(a, 10);
  e.propagate();
  const int after = e.get(sum);
  std::printf("%d, then %d\n", before, after);
  return before == 7 && after == 14 ? 0 : 1;
}
