// Windows. Names are in the code page of the process, as the arguments of main() are.
#include <fcntl.h>
#include <io.h>
#include <process.h>
#include <sys/stat.h>
#define WIN32_LEAN_AND_MEAN
#define NOMINMAX
#include <windows.h>

#include <cerrno>

#include "platform/files.hpp"

namespace mesher::platform {
namespace {

std::error_code last_error() noexcept { return {errno, std::generic_category()}; }

}  // namespace

std::error_code create(const std::string& path) noexcept {
  constexpr int kFlags = _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY | _O_NOINHERIT;
  const int descriptor = ::_open(path.c_str(), kFlags, _S_IREAD | _S_IWRITE);
  if (descriptor < 0) return last_error();
  ::_close(descriptor);
  return {};
}

std::FILE* open_to_write(const std::string& path) noexcept {
  return std::fopen(path.c_str(), "wbN");  // N: not inherited
}

std::error_code why_not_writable(const std::string& path) noexcept {
  constexpr int kWrite = 2;
  if (::_access(path.c_str(), kWrite) == 0) return {};
  return last_error();
}

std::error_code rename(const std::string& from, const std::string& to) noexcept {
  if (::MoveFileExA(from.c_str(), to.c_str(), MOVEFILE_REPLACE_EXISTING) != 0) return {};
  return {static_cast<int>(::GetLastError()), std::system_category()};
}

void remove(const std::string& path) noexcept { ::DeleteFileA(path.c_str()); }

unsigned process_number() noexcept { return static_cast<unsigned>(::_getpid()); }

}  // namespace mesher::platform
