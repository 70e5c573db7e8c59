// Sizes behind a handle.
#pragma once

#include <memory>
#include <variant>

#include "handles.hpp"
#include "mesher/sizes.hpp"

namespace lm {

struct SizesObject final : Object {
  using Field = std::variant<std::shared_ptr<const mesher::SizeField<2>>,
                             std::shared_ptr<const mesher::SizeField<3>>>;
  explicit SizesObject(Field all) : field(std::move(all)) {}
  const Field field;
};

/// The sizes behind a handle, null for 0. Throws: Failure (LM_BAD_HANDLE, LM_BAD_ARGUMENT: of the
/// other dimension).
template <int D>
[[nodiscard]] std::shared_ptr<const mesher::SizeField<D>> sizes_of(lm_handle handle);

}  // namespace lm
