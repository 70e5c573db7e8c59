// The functions of the operating system that the engine uses. sac/src/platform has one file for
// each system; CMake chooses it (SAC_PLATFORM), and the rest of the library depends on none of
// them.
//
// An arena takes addresses first and memory later: reserve(), then commit() from the front as it
// grows. discard() returns pages whose content is no longer needed.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sac::platform {

/// Addresses of memory are below 2^kAddressBits: what x86-64 gives to programs. A system that gives
/// more is asked for those below.
inline constexpr int kAddressBits = 47;

/// An arena reserves 2^kReserveBits bytes: 2^35, as far as its handles reach, where addresses alone
/// cost nothing. The generic platform takes memory for them, if only in the system's books.
/// kReturnsPages: whether discard() gives anything back.
#ifdef SAC_GENERIC_PLATFORM
inline constexpr int kReserveBits = 30;
inline constexpr bool kReturnsPages = false;
#else
inline constexpr int kReserveBits = 35;
inline constexpr bool kReturnsPages = true;
#endif

/// `bytes` of addresses, the first a multiple of `alignment`; null if there are none.
/// Requires: both are powers of 2, and bytes <= alignment.
[[nodiscard]] void* reserve(std::size_t bytes, std::size_t alignment) noexcept;
/// Requires: reserve(bytes, alignment) gave `block`.
void release(void* block, std::size_t bytes, std::size_t alignment) noexcept;

/// Makes reserved addresses memory; false, and nothing happens, if the system has none.
/// Requires: `from` is a multiple of page_bytes().
[[nodiscard]] bool commit(void* from, std::size_t bytes) noexcept;
/// Gives pages back; they stay memory, of any content. A hint, whose failure is harmless.
/// Requires: `from` and `bytes` are multiples of page_bytes(), and committed.
void discard(void* from, std::size_t bytes) noexcept;
[[nodiscard]] std::size_t page_bytes() noexcept;

/// Asks for huge pages; a hint, whose failure is harmless.
void advise_huge_pages(void* block, std::size_t bytes) noexcept;

/// How large the stack of a thread may grow, as far as the system says so.
[[nodiscard]] std::size_t stack_bytes() noexcept;

}  // namespace sac::platform
