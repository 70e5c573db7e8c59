// Draws traces as SVG, for people: an icicle, with the roots on top.
//
// A call is a bar, its children are below it in the order of the trace; the width of a bar is the
// number of its calls, itself included, and its colour is that of its function. A tail call is
// beside the call that it continues, so that a loop is a row. Calls thinner than two pixels are
// drawn together: a column of pixels shows the share of each function. Pointing at a bar shows its
// label, at a column its calls.
//
// Example
//   out << traces::render("before.trace");
//   out << traces::render_difference("before.trace", "after.trace");
#pragma once

#include <cstdint>
#include <string>

namespace traces {

/// Options of pictures.
struct RenderOptions {
  int width = 1200;         ///< of the picture, in pixels, at least 200
  std::uint32_t rows = 40;  ///< deeper calls are drawn as one row; at least 1
};

/// Draws a whole trace. Throws: FileError. Cost: O(n), 28 bytes of memory for each call; the size
/// of the picture is O(width * rows) for any n.
[[nodiscard]] std::string render(const std::string& path, const RenderOptions& options = {});

/// Draws two traces, with marks at the calls that the other trace does not have; below them the
/// blame region: those calls and their ancestors, with common calls folded; and their labels.
/// Throws: FileError.  Cost: O(n log n), 40 bytes of memory for each call.
[[nodiscard]] std::string render_difference(const std::string& a, const std::string& b,
                                            const RenderOptions& options = {});

}  // namespace traces
