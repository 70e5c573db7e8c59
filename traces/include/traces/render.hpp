// Pictures of traces as SVG, for people: an icicle, with the roots on top.
//
// A call is a bar, its children lie below it in the order of the trace; a bar is as wide as it has
// calls, itself included, and has the colour of its function. A tail call stands beside the call
// that it continues, so that a loop is a row. Calls thinner than two pixels are drawn together, a
// column of pixels showing what share of them each function has. Whoever points at a bar is told
// its label, and at a column its calls.
//
// Example
//   out << traces::render("before.trace");
//   out << traces::render_difference("before.trace", "after.trace");
#pragma once

#include <cstdint>
#include <string>

namespace traces {

struct RenderOptions {
  int width = 1200;         ///< of the picture, in pixels, at least 200
  std::uint32_t rows = 40;  ///< what lies deeper is one row; at least 1
};

/// The whole trace. Throws: FileError.
/// Cost: O(n), 28 bytes of memory a call; the picture's size is O(width * rows), whatever n is.
[[nodiscard]] std::string render(const std::string& path, const RenderOptions& options = {});

/// Both traces, with marks at the calls that the other has not; below, the blame region: those
/// calls and their ancestors, with all that is the same folded; and their labels.
/// Throws: FileError.  Cost: O(n log n), 40 bytes of memory a call.
[[nodiscard]] std::string render_difference(const std::string& a, const std::string& b,
                                            const RenderOptions& options = {});

}  // namespace traces
