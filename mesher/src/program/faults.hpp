// What fails in a call of a part of the mesh.
#pragma once

#include "program/world.hpp"

namespace mesher::detail {

/// Calls act(). In a part of the mesh a call may meet what will not be there in the end: an error
/// counts only if it is still there then, but for too many vertices. `is_near`: it is that a vertex
/// would come too near to others, as TooNear says, too. Returns whether there was none.
template <class S, int D, class Act>
bool succeeds(S& s, World<S, D>& w, Act&& act, [[maybe_unused]] bool is_near = false) {
  if (!w.is_part()) return act(), true;
  const auto fault = [&](const Error& error, [[maybe_unused]] bool near) {
    if constexpr (S::kTraced) {
      w.border->fault(s, error, near);
    } else {
      w.halo->fault(error);
    }
    return false;
  };
  try {
    act();
    return true;
  } catch (const Error& error) {
    if (error.code() == ErrorCode::too_many) throw;
    return fault(error, is_near);
  } catch (const TooNear&) {
    return fault({ErrorCode::too_close, "a new vertex would be too near to others"}, true);
  }
}

}  // namespace mesher::detail
