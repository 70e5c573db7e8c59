// Texts with random mistakes, for tests of readers.
#pragma once

#include <algorithm>
#include <iterator>
#include <string>

#include "mesher/generate.hpp"

namespace support {

/// `good` with one to three changes: cut off, or a part replaced, put in or left out.
[[nodiscard]] inline std::string with_mistakes(const std::string& good,
                                               mesher::SplitMix64& random) {
  const std::string pieces[] = {"-1", "0", "7", "1e400", "nan", "99999999999", "#",  "\n", " ",
                                "x",  "<", ">", "]",     "{",   "\"",          "\0", "$",  "/"};
  std::string bad = good;
  for (auto changes = 1 + random.below(3); changes > 0; --changes) {
    const std::size_t at = random.below(bad.size() + 1);
    const std::size_t length = random.below(2) == 0 ? 0 : random.below(6);
    const std::string& piece = pieces[random.below(std::size(pieces))];
    switch (random.below(3)) {
      case 0:
        bad.resize(at);
        break;
      case 1:
        bad.replace(at, std::min(length, bad.size() - at), piece);
        break;
      default:
        bad.erase(at, length);
    }
  }
  return bad;
}

}  // namespace support
