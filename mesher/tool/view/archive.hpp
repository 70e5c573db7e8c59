// Several files as one: a tar archive (POSIX ustar).
#pragma once

#include <string>
#include <vector>

namespace tool::view {

struct ArchivedFile {
  std::string name;  // shorter than 100 bytes
  std::string content;
};

[[nodiscard]] inline std::string tar_of(const std::vector<ArchivedFile>& files) {
  constexpr std::size_t kBlock = 512;
  std::string archive;
  for (const auto& [name, content] : files) {
    std::string head(kBlock, '\0');
    const auto put = [&](std::size_t at, const std::string& text) {
      head.replace(at, text.size(), text);
    };
    const auto octal = [](std::size_t value, std::size_t digits) {
      std::string text(digits, '0');
      for (std::size_t i = digits; i-- > 0; value /= 8)
        text[i] = static_cast<char>('0' + value % 8);
      return text;
    };
    put(0, name.substr(0, 99));
    put(100, octal(0644, 7));
    put(108, octal(0, 7));
    put(116, octal(0, 7));
    put(124, octal(content.size(), 11));
    put(136, octal(0, 11));
    put(148, "        0");  // the checksum counts as blanks; a plain file
    put(257, "ustar");
    put(263, "00");
    std::size_t sum = 0;
    for (const char c : head) sum += static_cast<unsigned char>(c);
    put(148, octal(sum, 6) + '\0');
    archive += head + content;
    archive.resize((archive.size() + kBlock - 1) / kBlock * kBlock, '\0');
  }
  return archive.append(2 * kBlock, '\0');
}

}  // namespace tool::view
