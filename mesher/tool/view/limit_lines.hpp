// Limits of size: as lines of a script, as JSON for pages, and what commands about them are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fields.hpp"
#include "mesher/mesher.hpp"

namespace tool::view {

/// The lines that give a mesh the limits of `options`, whatever limits it had; nothing if they have
/// a background or a function, which has no name in a script. D is 2 or 3.
template <int D>
[[nodiscard]] std::optional<std::vector<std::string>> limit_lines(
    const mesher::Options<D>& options);

/// {"everywhere": LARGEST, "boxes": [{"lo": [...], "hi": [...], "largest": LARGEST}, ...]}, the
/// last box that contains a position counts there. LARGEST: an area (volume), null, or
/// "background".
template <int D>
[[nodiscard]] Json json_of_limits(const mesher::Options<D>& options);

/// The lines of a command `limit` or `unlimit` (see model.hpp) on a mesh with the limits `now`.
/// Throws: Error(bad_edit).
template <int D>
[[nodiscard]] std::vector<std::string> limit_lines_of(const Json& command,
                                                      const mesher::Options<D>& now);

/// Announces the limits of `options`, backgrounds included, in place of all. Throws: as limit().
template <int D>
void announce_limits(const mesher::Options<D>& options, mesher::Mesher<D>& mesher);

}  // namespace tool::view
