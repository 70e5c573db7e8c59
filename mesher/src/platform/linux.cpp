// Linux, on any processor.
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "platform/files.hpp"

namespace mesher::platform {
namespace {

std::error_code last_error() noexcept { return {errno, std::generic_category()}; }

}  // namespace

std::error_code create(const std::string& path) noexcept {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) return last_error();
  ::close(descriptor);
  return {};
}

std::FILE* open_to_write(const std::string& path) noexcept {
  return std::fopen(path.c_str(), "wbe");
}

std::error_code why_not_writable(const std::string& path) noexcept {
  if (::access(path.c_str(), W_OK) == 0) return {};
  return last_error();
}

std::error_code rename(const std::string& from, const std::string& to) noexcept {
  if (std::rename(from.c_str(), to.c_str()) == 0) return {};
  return last_error();
}

void remove(const std::string& path) noexcept { ::unlink(path.c_str()); }

unsigned process_number() noexcept { return static_cast<unsigned>(::getpid()); }

}  // namespace mesher::platform
