// What a name of a file becomes.
#include "io/names_read.hpp"

#include <charconv>

namespace mesher {

std::string allowed_name(std::string_view name) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const auto first = name.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  name = name.substr(first, name.find_last_not_of(kBlanks) + 1 - first);
  std::string allowed;
  for (const char c : name) {
    const bool is_bad = !fault_of_name(std::string_view(&c, 1)).empty();
    allowed += is_bad ? '_' : c;
  }
  if (allowed.size() <= GroupNames::kLongestName) return allowed;
  std::size_t end = GroupNames::kLongestName;  // not within a character of UTF-8
  while (end > 0 && (static_cast<unsigned char>(allowed[end]) & 0xC0) == 0x80) --end;
  return allowed.substr(0, end);
}

bool is_name_of_number(std::string_view name) {
  for (const std::string_view prefix : {"marker", "line", "region"}) {
    if (name.substr(0, prefix.size()) != prefix || name.size() < prefix.size() + 2) continue;
    if (name[prefix.size()] != '_' && name[prefix.size()] != ' ') continue;
    const std::string_view number = name.substr(prefix.size() + 1);
    double value = 0;
    const auto read = std::from_chars(number.data(), number.data() + number.size(), value);
    if (read.ec == std::errc{} && read.ptr == number.data() + number.size()) return true;
  }
  return false;
}

}  // namespace mesher
