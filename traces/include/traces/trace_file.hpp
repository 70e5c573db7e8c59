// The trace file: the calls of one run in pre-order, written and read as a stream.
//
// Version 4. Integers are unsigned LEB128 (7 bits a byte, lowest first) unless a size is given;
// fixed sizes are little-endian; a text is its length and its bytes.
//
//   header    "\x89traces\n"  version  parts    8 bytes, 1 byte, 1 byte
//   function  'F'  name                        its index is the number of functions before it
//   call      'C'  flags  depth  function index  hash  arguments  [weight]
//             flags, 1 byte: bit 0: the label contains an object without a name (recorder.hpp), so
//             the hash is valid only within this run; bit 1: a tail call; bit 2: a weight follows,
//             which the call reported by sac::Scope::weigh; else it is 0. The hash is 16 bytes,
//             high half first
//   edge      'X'  hash  text
//             of the call before, in the order of execution, if edges were requested: a read, an
//             effect, or the result. The hash is that of the observed value, hashed like a part of
//             a label; 0 for other edges
//   end       'E'  number of calls  checksum    8 bytes: FNV-1a of all bytes before it
//
// `parts` lists the parts that a call's hash covers: bit 0 the function, bit 1 its arguments, bit 2
// the values it read, bit 3 the results of its children [Def 1.4.1]. This version writes 15: all of
// them. The texts are for people; only hashes are compared.
//
// Guarantees:
// (1) Writing and reading take O(1) memory in addition to the names of functions.
// (2) A writer that has not finished leaves no file; an existing file stays as it was.
// (3) A reader refuses a truncated or changed file, at the latest at its end.
// (4) A reader allocates memory only for bytes that it has read, never for a count in the file.
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
/// The writer cuts longer texts; the reader refuses them.
inline constexpr std::size_t kLongestText = 4096;

/// A file that cannot be written, or is not a trace; what() is `FILE:byte N: error[code]: what`.
class FileError : public std::runtime_error {
 public:
  /// `code`: io, not_a_trace, version, truncated, corrupt.
  FileError(const std::string& path, std::uint64_t offset, std::string code,
            const std::string& what);
  [[nodiscard]] const std::string& code() const noexcept { return code_; }
  /// The position in the file, in bytes from its start.
  [[nodiscard]] std::uint64_t offset() const noexcept { return offset_; }

 private:
  std::string code_;
  std::uint64_t offset_;
};

/// An edge in a file.
struct EdgeRecord {
  LabelHash hash;    // of the observed value; 0 for other edges
  std::string text;  // as printed
};

/// A call in a file.
struct CallRecord {
  std::uint32_t depth = 0;     // at most one more than that of the call before, and < 2^31
  std::uint32_t function = 0;  // index
  LabelHash hash;
  bool named = true;                   // every part of the label has a name for all runs
  std::string arguments;               // as printed
  bool tail = false;                   // a tail call: runs after its parent, as its last child
  std::vector<EdgeRecord> edges = {};  // none unless requested
  std::uint64_t weight = 0;            // reported by sac::Scope::weigh, if recorded
};

/// The path to which a writer writes until it has finished.
[[nodiscard]] std::string temporary_of(const std::string& path);

/// Writes a trace file.
class TraceWriter {
 public:
  /// Opens the file. Throws: FileError.
  explicit TraceWriter(std::string path);
  TraceWriter(TraceWriter&&) noexcept;
  ~TraceWriter();

  /// Adds a function and returns its index.
  std::uint32_t add_function(std::string_view name);
  /// Adds a call. Throws: FileError. Requires: call.function < number of added functions.
  void add_call(const CallRecord& call);
  /// Completes the file and renames it to its path; the last call. Throws: FileError.
  void finish();

 private:
  struct Output;
  std::unique_ptr<Output> out_;
  std::uint32_t functions_ = 0;
  std::uint64_t calls_ = 0;
  std::int64_t depth_ = -1;
};

/// Reads a trace file.
class TraceReader {
 public:
  /// Reads the header. Throws: FileError.
  explicit TraceReader(std::string path);
  TraceReader(TraceReader&&) noexcept;
  ~TraceReader();

  /// The next call, valid until the following call of next(); null at the end. Throws: FileError.
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

/// `name(arguments)` on one line: unprintable bytes are shown as '?'.
[[nodiscard]] std::string label_text(std::string_view name, std::string_view arguments);
/// The text of an edge on one line, likewise.
[[nodiscard]] std::string edge_text(const EdgeRecord& edge);

}  // namespace traces
