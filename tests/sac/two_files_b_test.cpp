// Functions of one name in two files: the other one.
#include "sac/sac.hpp"

namespace two_files {

struct World {
  sac::Mod<bool> swapped;
  sac::Mod<int> x;
  sac::Agenda& agenda;
};

static void digit(sac::Scope& s, int) {
  auto& w = s.environment<World>();
  s.write(w.x, s.read(w.x) * 10 + 2);
}
void post_b(sac::Scope& s) { s.environment<World>().agenda.post<digit>(s, {}, 1); }

}  // namespace two_files
