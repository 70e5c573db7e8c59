// The address of a page in a file.
#include "page_address.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "platform/process.hpp"

namespace tool::view {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBeginning = "http://127.0.0.1:";
constexpr std::size_t kTokenLength = 32;

bool is_private(const std::string& path) {
  std::error_code failed;
  const fs::file_status status = fs::symlink_status(path, failed);
  const fs::perms others = fs::perms::group_all | fs::perms::others_all;
  return !failed && fs::is_regular_file(status) &&
         (status.permissions() & others) == fs::perms::none;
}

std::optional<PageAddress> address_of(const std::string& line) {
  const std::string beginning = kBeginning;
  if (!line.starts_with(beginning)) return std::nullopt;
  PageAddress address;
  const char* const end = line.data() + line.size();
  const auto port = std::from_chars(line.data() + beginning.size(), end, address.port);
  if (port.ec != std::errc{}) return std::nullopt;
  address.token = std::string(port.ptr, end);
  if (address.token.size() != kTokenLength + 2 || address.token.front() != '/' ||
      address.token.back() != '/') {
    return std::nullopt;
  }
  address.token = address.token.substr(1, kTokenLength);
  const bool fits = std::all_of(address.token.begin(), address.token.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
  });
  return fits && address.port != 0 ? std::optional(address) : std::nullopt;
}

}  // namespace

std::string PageAddress::text() const {
  return kBeginning + std::to_string(port) + "/" + token + "/";
}

std::optional<PageAddress> read_page_address(const std::string& path) {
  if (!is_private(path)) return std::nullopt;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return address_of(line);
}

bool write_page_address(const std::string& path, const PageAddress& address) {
  std::error_code ignored;
  fs::remove(path, ignored);
  std::FILE* const file = platform::create_private(path);
  if (file == nullptr) return false;
  // Where the system has not made it so.
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write, ignored);
  const bool written = is_private(path) && std::fputs((address.text() + "\n").c_str(), file) >= 0;
  if (std::fclose(file) == 0 && written) return true;
  fs::remove(path, ignored);
  return false;
}

}  // namespace tool::view
