// The destination of --stats: a file, or standard output for "-".
#pragma once

#include <string>
#include <string_view>

#include "outputs.hpp"

namespace tool {

class Figures {
 public:
  /// `path`: as --stats has it; empty for nowhere. Throws: Error (cannot_write, bad_option).
  Figures(const std::string& path, CommandFiles& outputs)
      : file_(path.empty() || path == "-" ? nullptr : &outputs.open(path)), printed_(path == "-") {}

  [[nodiscard]] bool wanted() const noexcept { return file_ != nullptr || printed_; }
  /// Whether standard output is theirs alone.
  [[nodiscard]] bool printed() const noexcept { return printed_; }

  Figures& operator<<(std::string_view text);

  /// Gives standard output what it shall have. To be called before files are committed, so that
  /// none appears if that fails. Throws: Error(cannot_write).
  void print();

 private:
  mesher::TextFile* file_;
  bool printed_;
  std::string text_;  // for standard output
};

}  // namespace tool
