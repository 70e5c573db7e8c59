// Makes text of files and arguments printable.
#pragma once

#include <string>
#include <string_view>

namespace mesher::text {

/// What a terminal or a log may be given: UTF-8 as it is, but for control characters (of ASCII and
/// of Unicode's second set) and for bytes that are no UTF-8, each of which is written as \xNN.
/// Line feeds stay: messages have some.
[[nodiscard]] std::string printable(std::string_view text);

/// The same of a part of a file in quotes, without line feeds, cut to some 40 bytes. All that a
/// message takes from a file goes through this.
[[nodiscard]] std::string quoted(std::string_view text);

}  // namespace mesher::text
