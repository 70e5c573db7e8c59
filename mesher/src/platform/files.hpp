// The functions of the operating system that the mesher uses beyond std::filesystem. This folder
// has one file for each system; CMake chooses (SAC_PLATFORM).
#pragma once

#include <cstdio>
#include <string>
#include <system_error>

namespace mesher::platform {

/// Creates an empty file; the error file_exists if the name is taken, whoever took it.
[[nodiscard]] std::error_code create(const std::string& path) noexcept;
/// Opens a file for bytes from its start; programs that this one starts do not have it open. Null,
/// and errno says why, if that fails.
[[nodiscard]] std::FILE* open_to_write(const std::string& path) noexcept;
/// Why one may not write to a file that is there; no error if one may.
[[nodiscard]] std::error_code why_not_writable(const std::string& path) noexcept;
/// Gives a file another name, whoever has had that; on failure nothing has changed.
[[nodiscard]] std::error_code rename(const std::string& from, const std::string& to) noexcept;
/// Removes a file if it is there.
void remove(const std::string& path) noexcept;
/// A number that tells this process from others that run.
[[nodiscard]] unsigned process_number() noexcept;

}  // namespace mesher::platform
