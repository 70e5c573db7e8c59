// Figures wait until all else has been written; then standard output gets them.
#include "figures.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace tool {

Figures& Figures::operator<<(std::string_view text) {
  if (file_ != nullptr) *file_ << text;
  if (printed_) text_ += text;
  return *this;
}

void Figures::print() {
  if (!printed_) return;
  const bool written = std::fwrite(text_.data(), 1, text_.size(), stdout) == text_.size();
  if (written && std::fflush(stdout) == 0) return;
  throw mesher::Error(mesher::ErrorCode::cannot_write,
                      std::string("standard output cannot be written: ") + std::strerror(errno));
}

}  // namespace tool
