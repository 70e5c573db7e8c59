// Calls of ChooseSteiners about vertices of other tiles: what they have to do in this one.
//
// Calls of one key run in the order of their names and vertices' places, so a call that stands for
// one of another tile has its name and its vertex.
#pragma once

#include <vector>

#include "program/world.hpp"

namespace mesher::detail {

/// Complete, or SplitSlivers, of v, which is another tile's: what that has seen here is looked at
/// again, and what it has inserted is born.
template <int D>
void run_for_another(sac::Scope& s, World<sac::Scope, D>& w, VertexRef<D> v) {
  const auto& script = w.border->read_script(s);
  std::vector<VertexHandle> found;
  for (const auto& [id, question] : script.questions) {
    const VertexRef<D> center = question.p == v->p ? v : w.vertices.claim(question.p);
    w.vertices.look_across(s, center, question.radius, found);
    w.border->answer(s, id, found);
  }
  for (const auto& [birth, count] : script.births) {
    const VertexRef<D> x = w.vertices.claim(birth.p);
    birth.role.on != 0 ? w.vertices.insert(s, x, birth.role) : w.vertices.insert(s, x);
    if (birth.bucket < 0) continue;
    if (birth.asks_nearest) {
      w.post_nearest_in(s, x, birth.bucket);
    } else {
      w.post_complete(s, x, birth.bucket);
    }
    w.post_star(s, x);
  }
}

}  // namespace mesher::detail
