// A random program with edits: from a seed or from bytes, as text, and made smaller.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "random_program.hpp"

namespace support {

/// One thing that the outside does.
struct Step {
  enum Kind : std::uint8_t {
    // edits,
    set,   // input a gets b
    post,  // node a, on an agenda that b chooses
    retract,
    insert,  // an element of weight b at a of the list
    remove,  // element a; it is released
    weigh,   // element a gets weight b
    // what ends them,
    propagate,
    undo,
    run,  // `late` with a, after the edits are propagated
    shrink,
    // and what shall fail, once, before the edits are propagated
    fuse,    // call a of the program
    client,  // operation a of a value
    heap,    // the a-th operator new
    arena,   // the a-th allocation in the trace
    cancel,  // at call a
    starve   // all allocations
  };
  static constexpr int kKinds = starve + 1;

  Kind kind;
  int a = 0;  // 0 .. 255 both; taken modulo what there is
  int b = 0;
};

struct Case {
  RandomProgram program{RandomProgram::kLeastNodes};
  bool fragile = false;  // values are `Fragile`, not ints
  bool audit = false;    // the engine's detectors are on
  bool observe = false;  // it is observed
  std::vector<Step> steps;
};

/// Propagations with edits before them, some of which fail. Some of the features are in it, thinly.
[[nodiscard]] Case random_case(std::uint64_t seed, unsigned features = kFeatures);
/// A small program in which the features are dense, and few edits.
[[nodiscard]] Case focused_case(std::uint64_t seed, unsigned features);

/// Any bytes are a case; decode(encode(c)) does what c does.
[[nodiscard]] Case decode(std::span<const std::uint8_t> bytes);
[[nodiscard]] std::vector<std::uint8_t> encode(const Case& c);

[[nodiscard]] std::string describe(const Case& c);

/// A smaller case for which `fails` as well.
[[nodiscard]] Case shrink(Case c, const std::function<bool(const Case&)>& fails);

}  // namespace support
