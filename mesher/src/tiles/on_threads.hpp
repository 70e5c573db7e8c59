// Equal parts of some work, on a thread each.
#pragma once

#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace mesher::detail {

/// Calls act(part), which returns nothing, for parts 0 to parts - 1, each on a thread as far as
/// there are threads to be had. Throws: what act has thrown, that of the first part, when all have
/// ended; std::bad_alloc, and then has done nothing.
template <class Act>
void on_threads(std::size_t parts, Act&& act) {
  if (parts == 1) return act(0);
  std::vector<std::thread> others;
  std::vector<std::exception_ptr> failures(parts);
  others.reserve(parts);
  const auto run = [&](std::size_t part) noexcept {
    try {
      act(part);
    } catch (...) {
      failures[part] = std::current_exception();
    }
  };
  std::size_t next = 1;
  try {
    for (; next < parts; ++next) others.emplace_back(run, next);
  } catch (...) {  // no more threads: this one does the rest
  }
  if (parts > 0) run(0);
  for (; next < parts; ++next) run(next);
  for (std::thread& other : others) other.join();
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

}  // namespace mesher::detail
