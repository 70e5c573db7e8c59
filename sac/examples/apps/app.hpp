// What the examples have in common as programs with random inputs and edits, for tests and tools.
//
// An App says what the example is; everything in it is a plain value except for World, which is the
// program with its inputs on a host, sac::Engine (traced) or sac::PlainScope (not traced):
//
//   struct App {
//     static constexpr const char* kName = "list map";
//     using Input = ...;                                   // copied freely
//     using Edit = ...;                                    // one change of an Input
//     static Input random_input(Random&, int size);        // size: 0 ..
//     static Edit random_edit(Random&, const Input&);      // one that can be applied
//     static Edit inverse(const Input& before, const Edit&);
//     static void apply(Input&, const Edit&);
//     static auto oracle(const Input&);                    // naive; a value with ==
//     template <class Host> struct World {
//       World(Host&, const Input&);                        // makes the inputs and runs the program
//       void edit(const Edit&);                            // the same change; does not propagate
//       auto result();                                     // to be compared with the oracle
//       void name(Recorder&);                              // inputs and cells, for recordings
//     };
//   };
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "sac/sac.hpp"

namespace apps {

/// Whether an update of the App moves calls (queries, to who asks first): it makes them anew.
template <class App>
inline constexpr bool kMovesCalls = requires {
  App::kMovesCalls;
};

/// Random numbers: the same in every build, from a seed.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(sac::mix(seed + 1)) {}
  /// 0 .. n - 1
  int operator()(int n) {
    state_ = sac::mix(state_ + 0x9e3779b97f4a7c15u);
    return static_cast<int>(state_ % static_cast<std::uint64_t>(n));
  }

 private:
  std::uint64_t state_;
};

/// The scope that programs get from a host.
template <class Host>
using ScopeOf = std::conditional_t<std::is_same_v<Host, sac::Engine>, sac::Scope, sac::PlainScope>;

/// Tells a recorder (traces::Recorder) the names of modifiables: `name`, and their places.
template <class Recorder, class Mods>
void name_all(Recorder& recorder, const Mods& mods, const char* name) {
  for (std::size_t i = 0; i < mods.size(); ++i) recorder.name(mods[i], name, i);
}

}  // namespace apps
