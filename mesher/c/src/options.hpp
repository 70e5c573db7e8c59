// Options as the caller gives them.
#pragma once

#include "livemesh.h"
#include "mesher/mesh.hpp"

namespace lm {

/// null: the defaults. Throws: Failure (LM_BAD_SIZE, LM_BAD_ARGUMENT, LM_BAD_HANDLE).
template <int D>
[[nodiscard]] mesher::Options<D> options_of(const lm_options* options);

}  // namespace lm
