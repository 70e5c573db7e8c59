// The positions of the bars of an icicle: rows by depth, widths by calls, thin bars drawn together.
//
// A view defines the shown calls and their widths: `whole` shows all, each of width 1; `changed`
// shows the calls of a list, each of width 1, their ancestors, and for each stretch of other
// siblings between them one fold of a width of its own.
#pragma once

#include <cstdint>
#include <vector>

#include "traces/trace.hpp"

namespace traces {

/// What is drawn as one rectangle.
struct Bar {
  enum class Kind : std::uint8_t {
    call,    // `first` alone, with its label
    fold,    // siblings that did not change, with all below them
    column,  // calls too thin to be told apart
  };
  Kind kind = Kind::call;
  bool changed = false;     // a call of the list, or a column with one
  bool leaf = true;         // nothing is drawn below it
  std::uint32_t row = 0;    // from 0 at the roots
  std::uint32_t first = 0;  // number of the first call
  std::uint64_t calls = 0;  // of a call: those in its bar; else: those drawn together
  double begin = 0;         // across, in pixels
  double own = 0;           // width of the call without those below
  double end = 0;
  static constexpr std::uint32_t kFolded = 0xffffffff;
  struct Share {
    std::uint32_t function;  // index, or kFolded
    std::uint64_t calls;
  };
  std::vector<Share> shares;  // of a column: its functions
};

/// The row of each call: one below its parent's, or its parent's for a tail call.
[[nodiscard]] std::vector<std::uint32_t> rows_of(const Trace& trace);

struct Layout {
  double width;        // in pixels
  std::uint32_t rows;  // what lies deeper is drawn in one more row
};

/// `changed`: ascending numbers of calls, to be marked. Cost: O(n); O(width * rows) bars.
[[nodiscard]] std::vector<Bar> lay_out_whole(const Trace& trace,
                                             const std::vector<std::uint32_t>& changed,
                                             const Layout& layout);
[[nodiscard]] std::vector<Bar> lay_out_changed(const Trace& trace,
                                               const std::vector<std::uint32_t>& changed,
                                               const Layout& layout);

}  // namespace traces
