// Memory that runs out is an error of ours, not the end by the system without a word.
#pragma once

#include <cstddef>
#include <new>
#include <string>

#include "mesher/error.hpp"

namespace tool {

/// Memory beyond what is free now is std::bad_alloc, where the system has that.
void bound_memory() noexcept;

/// "out of memory after 20.1 GiB".
[[nodiscard]] std::string out_of_memory();

/// How many vertices memory may hold a run of svr or refine for, by the least that one takes; 0:
/// unknown.
[[nodiscard]] std::size_t most_vertices_in_memory(int dimension);

/// Gives act(), which has this bound of --max-vertices if `is_bound`. Throws: Error(too_many) with
/// words of memory for it, and for std::bad_alloc.
template <class Act>
decltype(auto) within_memory(bool is_bound, Act&& act) {
  using mesher::Error;
  using mesher::ErrorCode;
  try {
    return act();
  } catch (const Error& error) {
    if (!is_bound || error.code() != ErrorCode::too_many) throw;
    throw error.with_message(error.message() +
                             "; memory holds no more; --max-vertices N sets another limit");
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::too_many,
                out_of_memory() + "; --max-vertices N ends sooner, and names what needs so many");
  }
}

}  // namespace tool
