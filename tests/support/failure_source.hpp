// Failures of every kind, one at a time: of client code, of operator new, of the engine's arena.
#pragma once

#include <cstdint>
#include <new>

#include "failing_new.hpp"
#include "sac/engine.hpp"

namespace support {

/// Where failures come from.
struct FailureSource {
  const char* name;
  void (*arm)(sac::Engine&, std::uint64_t count);  // the count-th event fails; 0: none
};
/// All of them; `Client`: a type whose operations burn Client::fuse.
template <class Client>
inline constexpr FailureSource kFailureSources[] = {
    {"client", [](sac::Engine&, std::uint64_t count) { Client::fuse.left = count; }},
    {"operator new", [](sac::Engine&, std::uint64_t count) { allocation_fuse.left = count; }},
    {"arena", [](sac::Engine& e, std::uint64_t count) { e.arena().fail_after(count); }},
};

/// Whether act() fails when the count-th event of the source does.
template <class Act>
bool fails(sac::Engine& engine, const FailureSource& source, std::uint64_t count, Act&& act) {
  source.arm(engine, count);
  bool failed = false;
  try {
    act();
  } catch (const ClientFailure&) {
    failed = true;
  } catch (const std::bad_alloc&) {
    failed = true;
  }
  source.arm(engine, 0);
  return failed;
}

}  // namespace support
