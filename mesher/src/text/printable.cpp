// Characters that are shown, and bytes that are written in their place.
#include "text/printable.hpp"

#include <cstddef>
#include <cstdint>

namespace mesher::text {
namespace {

constexpr std::size_t kLongest = 40;  // bytes of a quotation

constexpr unsigned char byte(char c) { return static_cast<unsigned char>(c); }
constexpr bool continues(char c) { return (byte(c) & 0xC0) == 0x80; }

// How many bytes the character at the beginning has; 0 if there is none, or none that is shown.
// Overlong forms, surrogates and what is beyond U+10FFFF are none [RFC 3629].
std::size_t shown_length(std::string_view text) {
  const unsigned char first = byte(text[0]);
  if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  std::uint32_t character = first & (0xFFu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if (!continues(text[i])) return 0;
    character = character << 6 | (byte(text[i]) & 0x3Fu);
  }
  constexpr std::uint32_t kLeast[] = {0, 0, 0xA0, 0x800, 0x10000};  // below 0xA0: controls
  const bool is_surrogate = character >= 0xD800 && character <= 0xDFFF;
  return character >= kLeast[length] && character <= 0x10FFFF && !is_surrogate ? length : 0;
}

std::string escaped(char c) {
  constexpr const char* kDigits = "0123456789abcdef";
  return {'\\', 'x', kDigits[byte(c) >> 4], kDigits[byte(c) & 15]};
}

std::string shown(std::string_view text, bool with_line_feeds) {
  std::string out;
  while (!text.empty()) {
    const bool stays = with_line_feeds && text[0] == '\n';
    const std::size_t length = stays ? 1 : shown_length(text);
    out += length > 0 ? std::string(text.substr(0, length)) : escaped(text[0]);
    text.remove_prefix(length > 0 ? length : 1);
  }
  return out;
}

}  // namespace

std::string printable(std::string_view text) { return shown(text, true); }

std::string quoted(std::string_view text) {
  std::size_t size = text.size();
  if (size > kLongest) {  // between characters
    size = kLongest;
    while (size > kLongest - 4 && continues(text[size])) --size;
  }
  return "'" + shown(text.substr(0, size), false) + (size < text.size() ? "...'" : "'");
}

}  // namespace mesher::text
