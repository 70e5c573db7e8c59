// Texts with random mistakes, for tests of readers.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <iterator>
#include <string>

#include "mesher/error.hpp"
#include "mesher/extra/generate.hpp"
#include "scratch_file.hpp"

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

/// Has `read` read the file with mistakes, a hundred times; it may refuse it, as a format, with its
/// absolute path. The file is good again then. How often it was refused.
template <class Read>
std::size_t refused_with_mistakes(const ScratchFolder& folder, const std::string& name,
                                  mesher::SplitMix64& random, Read&& read) {
  const std::string good = folder.read(name);
  std::size_t refused = 0;
  for (int round = 0; round < 100; ++round) {
    const std::string bad = with_mistakes(good, random);
    folder.write(name, bad);
    INFO(name << ":\n" << bad);
    try {
      read();
    } catch (const mesher::Error& error) {
      ++refused;
      CHECK(error.location().file.substr(0, 1) == "/");
      CHECK(mesher::exit_code(error.code()) == mesher::ExitCode::format);
    }
  }
  folder.write(name, good);
  return refused;
}

}  // namespace support
