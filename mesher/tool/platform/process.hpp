// The functions of the operating system that the tool uses. This folder has one file for each
// system; CMake chooses (SAC_PLATFORM).
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

namespace tool::platform {

/// Calls `handler` at an interrupt, a termination or a hang-up, at any point of the program: it may
/// only call the functions named ..._at_once, and read and write sig_atomic_t. One that the parent
/// process had ignored stays ignored.
void catch_interrupts(void (*handler)());
/// From now on they wait; gives which have done so before.
[[nodiscard]] unsigned hold_interrupts() noexcept;
/// Those wait from now on that hold_interrupts() gave as `before`; if others have come, the handler
/// is called here.
void restore_interrupts(unsigned before) noexcept;

/// Removes a file.
void remove_at_once(const char* path) noexcept;
/// Writes a line to the standard error and ends the process without any cleaning up.
[[noreturn]] void end_at_once(const char* line, int exit_code) noexcept;

/// A file that grows too large, and a pipe that nobody reads, are errors of the write from now on.
void return_failures_of_writes() noexcept;

/// Whether the standard error is a terminal.
[[nodiscard]] bool shows_errors_to_people() noexcept;
/// A number of the process that started this one, which changes when that ends; 0 where the system
/// does not tell.
[[nodiscard]] std::uint64_t parent_number() noexcept;
/// The most memory that the process has had; 0: unknown.
[[nodiscard]] std::uint64_t peak_memory_bytes() noexcept;

/// What the system, and the groups of processes that this one is in, have free, with swap; 0:
/// unknown.
[[nodiscard]] std::uint64_t free_memory_bytes() noexcept;
/// What the process asks for beyond so many bytes is std::bad_alloc from now on, where the system
/// has that, unless less is allowed already: else the system would end it without a word.
void bound_memory(std::uint64_t bytes) noexcept;

/// Memory that is freed stays with the process. Large tables go while others come: what is given
/// back to the system comes anew, to be cleared. A mesh of 10^6 points takes 8% more memory so, a
/// quarter fewer pages, and 2% less time, or a tenth where memory is new to the machine.
void keep_freed_memory() noexcept;

/// Opens a file to read it and to write at its end, without a buffer; it is made if it is not
/// there. Null, and errno says why, if that fails.
[[nodiscard]] std::FILE* open_to_append(const std::string& path) noexcept;
/// Whether no other process has it; none gets it before this one closes it.
[[nodiscard]] bool lock(std::FILE* file) noexcept;
/// Brings what was written to the disk; 0, or the error.
[[nodiscard]] int sync(std::FILE* file) noexcept;
/// The same for the name of a file, as far as the system can.
void sync_folder_of(const std::string& path) noexcept;
/// Makes a file that only its owner can read, where the system has that; null if the name is taken,
/// or if that fails.
[[nodiscard]] std::FILE* create_private(const std::string& path) noexcept;
/// Drops what is behind the first `bytes` of the file, which is at `path`; 0, or the error.
[[nodiscard]] int shorten(std::FILE* file, const std::string& path, std::uint64_t bytes) noexcept;

}  // namespace tool::platform
