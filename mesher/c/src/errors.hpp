// Failures as statuses, with the record that lm_last_error() shows.
#pragma once

#include <stdexcept>
#include <string>

#include "livemesh.h"
#include "mesher/error.hpp"

namespace lm {

/// A mistake of the caller. (Bad data is a mesher::Error.)
class Failure : public std::runtime_error {
 public:
  Failure(lm_status status, const std::string& message)
      : std::runtime_error(message), status_(status) {}
  [[nodiscard]] lm_status status() const noexcept { return status_; }

 private:
  lm_status status_;
};

[[nodiscard]] constexpr lm_status status_of(mesher::ErrorCode code) noexcept {
  return LM_DUPLICATE_POINT + static_cast<lm_status>(code);
}

/// Records the exception that is being handled as the last failure of this thread; its status.
[[nodiscard]] lm_status record_failure() noexcept;

/// Runs a function of the interface: what it throws becomes a status.
template <class Body>
[[nodiscard]] lm_status guarded(Body&& body) noexcept {
  try {
    body();
    return LM_OK;
  } catch (...) {
    return record_failure();
  }
}

/// Throws: Failure(LM_NULL_POINTER). `what`: the name of the parameter.
void require_pointer(const void* pointer, const char* what);
/// Throws: Failure(LM_BAD_ARGUMENT) for 2^32 elements or more.
void require_count(std::size_t n, const char* what);
/// Both, for an array of n elements.
void require_array(const void* pointer, std::size_t n, const char* what);

}  // namespace lm
