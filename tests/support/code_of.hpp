// The error that something throws.
#pragma once

#include <optional>

#include "mesher/error.hpp"

namespace support {

/// The code of the Error that run() throws; nothing if it throws none.
template <class Run>
std::optional<mesher::ErrorCode> code_of(Run&& run) {
  try {
    run();
  } catch (const mesher::Error& error) {
    return error.code();
  }
  return std::nullopt;
}

}  // namespace support
