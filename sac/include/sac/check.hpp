// Contract checks, classified by who is at fault.
//
// SAC_EXPECTS   the caller: throws UsageError.
// SAC_ENSURES   this library: throws InvariantError, in builds with SAC_CHECKS.
// SAC_INVARIANT a predicate of a structure in check_invariants(): throws InvariantError.
#pragma once

#include <stdexcept>
#include <string>

namespace sac {

/// The client violated the contract of the library; the message names the calls and modifiables
/// involved.
class UsageError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// The progress callback stopped the run.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled by the progress callback") {}
};

/// An invariant of the library is broken: a bug of the library.
class InvariantError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Whether this build was made with SAC_CHECKS.
#ifdef SAC_CHECKS
inline constexpr bool kChecked = true;
#else
inline constexpr bool kChecked = false;
#endif

namespace detail {
[[noreturn]] void fail_expects(const char* expression, const char* file, int line);
[[noreturn]] void fail_invariant(const char* expression, const char* file, int line);
}  // namespace detail

}  // namespace sac

#define SAC_EXPECTS(condition)            \
  (static_cast<bool>(condition) ? void(0) \
                                : ::sac::detail::fail_expects(#condition, __FILE__, __LINE__))

#define SAC_INVARIANT(condition)          \
  (static_cast<bool>(condition) ? void(0) \
                                : ::sac::detail::fail_invariant(#condition, __FILE__, __LINE__))

#ifdef SAC_CHECKS
#define SAC_ENSURES(condition) SAC_INVARIANT(condition)
#else
#define SAC_ENSURES(condition) void(0)
#endif
