// The quadtree for finding vertices: its class, and the bodies of its functions by subject.
#pragma once

#include "index/quadtree_cells.hpp"    // IWYU pragma: export
#include "index/quadtree_check.hpp"    // IWYU pragma: export
#include "index/quadtree_class.hpp"    // IWYU pragma: export
#include "index/quadtree_nearest.hpp"  // IWYU pragma: export
#include "index/quadtree_reach.hpp"    // IWYU pragma: export
#include "index/quadtree_search.hpp"   // IWYU pragma: export
