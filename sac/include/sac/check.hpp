// Contract checks, classified by whose fault a failure is.
//
// SAC_EXPECTS   the caller's: throws UsageError.
// SAC_ENSURES   ours: throws InvariantError, in builds with SAC_CHECKS.
// SAC_INVARIANT a structure's predicate inside check_invariants(): throws InvariantError.
#pragma once

#include <stdexcept>
#include <string>

namespace sac {

/// The client used the library against its contract; the message names calls and mods involved.
class UsageError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// The progress callback asked for the end.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled by the progress callback") {}
};

/// A structure of the library is not what it promises to be: our bug.
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
