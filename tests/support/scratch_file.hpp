// Files that a test writes into the scratch folder and reads back, and errors that it expects.
#pragma once

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "mesher/error.hpp"
#include "test_paths.hpp"

namespace support {

/// A folder of this test alone, empty at first and removed with all that is in it.
class ScratchFolder {
 public:
  ScratchFolder() : path_(unused()) { std::filesystem::create_directories(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() { std::filesystem::remove_all(path_); }

  [[nodiscard]] std::string path(const std::string& name) const { return (path_ / name).string(); }

  /// Writes `content` to a file; its path.
  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    REQUIRE(file.is_open());
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// How many files there are, hidden ones included.
  [[nodiscard]] long count() const {
    return std::distance(std::filesystem::directory_iterator(path_), {});
  }

 private:
  static std::filesystem::path unused() {
    static int made = 0;
    return std::filesystem::path(test_paths::kScratch) /
           ("files-" + std::to_string(getpid()) + "-" + std::to_string(made++));
  }
  std::filesystem::path path_;
};

/// The error that `run` throws.
template <class Run>
mesher::Error error_of(Run run) {
  try {
    run();
  } catch (const mesher::Error& error) {
    return error;
  }
  FAIL("no error");
  throw std::logic_error("unreachable");
}

/// `code@LINE:COLUMN` of the error that `run` throws.
template <class Run>
std::string failure_of(Run run) {
  const mesher::Error error = error_of(run);
  return std::string(code_name(error.code())) + "@" + std::to_string(error.location().line) + ":" +
         std::to_string(error.location().column);
}

}  // namespace support
