// Equal parts of some work, on a thread each.
#pragma once

#include <cstddef>
#include <thread>
#include <vector>

namespace mesher::detail {

/// Calls act(part) for parts 0 to parts - 1, each on a thread as far as there are threads to be
/// had. Requires: act does not throw. Throws: std::bad_alloc, and then has done nothing.
template <class Act>
void on_threads(std::size_t parts, Act&& act) {
  std::vector<std::thread> others;
  others.reserve(parts);
  std::size_t part = 1;
  try {
    for (; part < parts; ++part) others.emplace_back([&act, part] { act(part); });
  } catch (...) {  // no more threads: this one does the rest
  }
  act(0);
  for (; part < parts; ++part) act(part);
  for (std::thread& other : others) other.join();
}

}  // namespace mesher::detail
