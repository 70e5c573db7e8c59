// Names for formats that allow few characters, and in which case does not count.
#pragma once

#include <initializer_list>
#include <set>
#include <string>

namespace mesher {

/// Makes names of ASCII letters, digits, '_', '-' and '.', each for one group.
class PlainNames {
 public:
  /// `taken`: names that groups must not have.
  PlainNames(std::initializer_list<const char*> taken) {
    for (const char* name : taken) taken_.insert(folded(name));
  }

  /// `name` with '_' for what is not allowed; with a number behind it if it is taken.
  [[nodiscard]] std::string make(std::string name) {
    for (char& c : name) {
      if (!is_plain(c)) c = '_';
    }
    std::string made = name;
    for (int i = 2; !taken_.insert(folded(made)).second; ++i) {
      const std::string number = '_' + std::to_string(i);
      made = name.substr(0, kLongest - number.size()) + number;
    }
    return made;
  }

 private:
  static constexpr std::size_t kLongest = 80;  // of Abaqus and CalculiX
  static bool is_plain(char c) {
    return c == '_' || c == '-' || c == '.' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
           (c >= 'A' && c <= 'Z');
  }
  static std::string folded(std::string name) {
    for (char& c : name) {
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    }
    return name;
  }
  std::set<std::string> taken_;
};

}  // namespace mesher
