// Inputs that come through pipes, or under a name that does not tell their format.
//
// Readers look at a file several times, and choose a format by the extension of its path. An input
// that can be read only once, or has no extension, gets a copy (a file gets a link) in a folder of
// its own.
#pragma once

#include <string>

namespace tool {

/// A path at which readers find what is at `path`: itself, unless that is a pipe or another device,
/// or `format` (an extension: "poly" or ".poly"; "": none) is another one than its own. Files of
/// the same name beside it are found as well. Throws: Error (cannot_read; unknown_format for a pipe
/// without an extension and a format).
[[nodiscard]] std::string readable(const std::string& path, const std::string& format);

/// The text with paths that readable() has given replaced by those that it was asked for.
[[nodiscard]] std::string with_own_paths(std::string text);

/// Removes what readable() has made. Links and copies are not needed once they were read.
void drop_copies() noexcept;

}  // namespace tool
