// Any system, in standard C++ and C.
#include <cerrno>
#include <filesystem>
#include <random>

#include "platform/files.hpp"

namespace mesher::platform {
namespace {

std::error_code error_of(std::FILE* opened) noexcept {
  if (opened == nullptr) return {errno, std::generic_category()};
  std::fclose(opened);
  return {};
}

unsigned drawn() noexcept {
  try {
    return std::random_device{}();
  } catch (...) {
    return 0;
  }
}

}  // namespace

// "x" is C's from 2011 on: fails if the file is there.
std::error_code create(const std::string& path) noexcept {
  return error_of(std::fopen(path.c_str(), "wbx"));
}

std::FILE* open_to_write(const std::string& path) noexcept {
  return std::fopen(path.c_str(), "wb");
}

// Opening for more, and writing none, leaves the file as it is.
std::error_code why_not_writable(const std::string& path) noexcept {
  return error_of(std::fopen(path.c_str(), "ab"));
}

std::error_code rename(const std::string& from, const std::string& to) noexcept {
  std::error_code error;
  try {
    std::filesystem::rename(from, to, error);
  } catch (...) {
    return std::make_error_code(std::errc::not_enough_memory);
  }
  return error;
}

void remove(const std::string& path) noexcept { std::remove(path.c_str()); }

// One of 2^32 by chance. Names made of it are tried until one is free.
unsigned process_number() noexcept {
  static const unsigned number = drawn();
  return number;
}

}  // namespace mesher::platform
