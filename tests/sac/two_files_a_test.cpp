// Functions of one name in two files: they are two functions, in an order of their own.
#include <catch2/catch.hpp>

#include "sac/sac.hpp"

namespace two_files {

struct World {
  sac::Mod<bool> swapped;
  sac::Mod<int> x;
  sac::Agenda& agenda;
};

static void digit(sac::Scope& s, int) {
  auto& w = s.environment<World>();
  s.write(w.x, s.read(w.x) * 10 + 1);
}
void post_a(sac::Scope& s) { s.environment<World>().agenda.post<digit>(s, {}, 1); }
void post_b(sac::Scope& s);

static void post_both(sac::Scope& s) {
  auto& w = s.environment<World>();
  s.write(w.x, 0);
  if (s.read(w.swapped)) post_b(s);
  post_a(s);
  if (!s.read(w.swapped)) post_b(s);
  w.agenda.drain(s);
}

TEST_CASE("static functions of one name in two files have an order of their own") {
  const auto run = [](bool before, bool now) {
    sac::Engine e;
    World w{e.input(before), e.cell<int>(), e.make_agenda("digits")};
    e.set_environment(&w);
    e.run<post_both>();
    e.set(w.swapped, now);
    e.propagate();
    return e.get(w.x);
  };
  const int order = run(false, false);
  CHECK((order == 12 || order == 21));
  CHECK(run(false, true) == order);
  CHECK(run(true, true) == order);
  CHECK(run(true, false) == order);
}

}  // namespace two_files
