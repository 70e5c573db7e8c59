// Filling where simplices must not be large: the queries of calls, and edits from outside.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "program/fill_plans.hpp"
#include "program/point_world.hpp"
#include "program/surroundings.hpp"

namespace mesher::detail {

/// fill() of the box, asked for from the outside if there are limits; not in a world that only
/// splits segments.
template <class AnyWorld>
void post_cells(AnyWorld& w);
template <class AnyWorld>
void retract_cells(AnyWorld& w);

/// fill() of what a cell consists of, which is split, too.
template <class S, class AnyWorld, int D>
void post_parts(S& s, AnyWorld& w, const Cell<D>& c);

/// Sets the limits that the options say, from outside, with how to take it back. `where` they
/// differ: calls that may have asked there run again. Throws: Error(bad_option), bad_alloc.
template <class AnyWorld, int D>
void edit_limits(AnyWorld& w, const Options<D>& options, const std::vector<Box<D>>& where,
                 sac::Engine& engine) {
  engine.begin_edit();
  const auto other = std::make_shared<Limits<D>>(options, w.box);
  const auto exchange = [&w, other, where]() noexcept {
    std::swap(w.limits, *other);
    for (const Box<D>& box : where) w.limits_changed(box);
  };
  engine.on_rollback(exchange);
  exchange();
  if (w.limits.any() == other->any()) return;
  w.limits.any() ? post_cells(w) : retract_cells(w);
}

}  // namespace mesher::detail
