// Where a page is, beside its journal, so that a server that is started again is found by the pages
// of the one before.
//
// FILE.page holds the address of the page of the journal FILE. Only its owner can read it, as
// whoever knows the address can edit; a file that others can read is not used.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace tool::view {

struct PageAddress {
  std::uint16_t port = 0;  // 0: any that is free
  std::string token;       // 32 hexadecimal digits; empty: a new one

  [[nodiscard]] std::string text() const;  // http://127.0.0.1:PORT/TOKEN/
};

/// Nothing if there is none that can be used.
[[nodiscard]] std::optional<PageAddress> read_page_address(const std::string& path);
/// Replaces the file. Whether that was possible.
bool write_page_address(const std::string& path, const PageAddress& address);

}  // namespace tool::view
