// The trace file: the calls of one run in pre-order, written and read as a stream.
//
// Version 4. Integers are unsigned LEB128 (7 bits a byte, lowest first) unless a size is given;
// fixed sizes are little-endian; a text is its length and its bytes.
//
//   header    "\x89traces\n"  version  parts    8 bytes, 1 byte, 1 byte
//   function  'F'  name                        its index is the number of functions before it
//   call      'C'  flags  depth  function index  hash  arguments  [weight]
//             flags, 1 byte: bit 0: the label contains an object without a name (recorder.hpp), so
//             the hash is good within this run only; bit 1: a tail call; bit 2: a weight follows,
//             what the call said by sac::Scope::weigh; else it is 0. The hash is 16 bytes, high
//             half first
//   edge      'X'  hash  what it is
//             of the call before, in the order of execution, if edges were asked for: what the call
//             read or did, or its result. The hash is that of what an observation saw, in words of
//             its label; 0 of other edges
//   end       'E'  number of calls  checksum    8 bytes: FNV-1a of all bytes before it
//
// `parts` says what a call's hash covers: bit 0 the function, bit 1 its arguments, bit 2 the values
// it read, bit 3 the results of its children [Def 1.4.1]. This version writes 15: all of them. The
// texts are for people; only hashes are compared.
//
// Guarantees:
// (1) Writing and reading take O(1) memory beside the names of functions.
// (2) A writer that has not finished leaves no file, and an older one as it was.
// (3) A reader refuses a file that was cut or changed anywhere, at the latest at its end.
// (4) A reader allocates for bytes that it has read, never for a count that the file states.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "traces/label_hash.hpp"

namespace traces {

inline constexpr std::uint8_t kVersion = 4;
inline constexpr std::uint8_t kParts = 15;  // function, arguments, values read, results of children
/// Longer texts are cut by the writer and refused by the reader.
inline constexpr std::size_t kLongestText = 4096;

/// A file cannot be written, or is not a trace; what() is `FILE:byte N: error[code]: what`.
class FileError : public std::runtime_error {
 public:
  /// `code`: io, not_a_trace, version, truncated, corrupt.
  FileError(const std::string& path, std::uint64_t offset, std::string code,
            const std::string& what);
  [[nodiscard]] const std::string& code() const noexcept { return code_; }
  /// Where in the file, in bytes from its start.
  [[nodiscard]] std::uint64_t offset() const noexcept { return offset_; }

 private:
  std::string code_;
  std::uint64_t offset_;
};

struct EdgeRecord {
  LabelHash hash;    // of what an observation saw; else 0
  std::string text;  // as printed
};

struct CallRecord {
  std::uint32_t depth = 0;     // at most one more than that of the call before, and < 2^31
  std::uint32_t function = 0;  // index
  LabelHash hash;
  bool named = true;                   // all in the label has a name that is the same in every run
  std::string arguments;               // as printed
  bool tail = false;                   // a tail call: runs after its parent, as its last child
  std::vector<EdgeRecord> edges = {};  // none unless they were asked for
  std::uint64_t weight = 0;            // what it said by sac::Scope::weigh, if that was recorded
};

/// Where a writer writes until it has finished.
[[nodiscard]] std::string temporary_of(const std::string& path);

class TraceWriter {
 public:
  /// Throws: FileError.
  explicit TraceWriter(std::string path);
  TraceWriter(TraceWriter&&) noexcept;
  ~TraceWriter();

  /// The index of a new function.
  std::uint32_t add_function(std::string_view name);
  /// Throws: FileError. Requires: call.function < number of functions added
  void add_call(const CallRecord& call);
  /// Puts the file in its place; last thing to do. Throws: FileError.
  void finish();

 private:
  struct Output;
  std::unique_ptr<Output> out_;
  std::uint32_t functions_ = 0;
  std::uint64_t calls_ = 0;
  std::int64_t depth_ = -1;
};

class TraceReader {
 public:
  /// Reads the header. Throws: FileError.
  explicit TraceReader(std::string path);
  TraceReader(TraceReader&&) noexcept;
  ~TraceReader();

  /// The next call, valid until the one after it is asked for; null at the end. Throws: FileError.
  const CallRecord* next();
  /// The functions met so far, by index.
  [[nodiscard]] const std::vector<std::string>& functions() const noexcept { return functions_; }

 private:
  void read_header();
  void read_call();
  void read_edges();
  void read_end();

  struct Input;
  std::unique_ptr<Input> in_;
  std::vector<std::string> functions_;
  CallRecord call_;
  std::uint64_t calls_ = 0;
  std::int64_t depth_ = -1;
  bool at_end_ = false;
};

/// `name(arguments)` on one line: bytes that do not print are shown as '?'.
[[nodiscard]] std::string label_text(std::string_view name, std::string_view arguments);
/// The text of an edge, likewise.
[[nodiscard]] std::string edge_text(const EdgeRecord& edge);

}  // namespace traces
