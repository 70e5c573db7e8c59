// The files of the page, which are in the program (CMake makes pages.cpp of them).
#pragma once

#include <string_view>

namespace tool::view {

struct PageFile {
  std::string_view name, type, content;
};

/// Null if there is none of that name; "" is the page itself.
[[nodiscard]] const PageFile* find_page(std::string_view name);

}  // namespace tool::view
