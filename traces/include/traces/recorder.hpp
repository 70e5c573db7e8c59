// Records the calls of a live engine into a trace file or into memory.
//
// The label of a call is (function, arguments, values read, results of children) [Def 1.4.1]. Its
// hash is made of their names in the sense of sac/label.hpp, so that equal labels of two runs have
// equal hashes; the structure from which a value was read names it (sac::Structure::label). Handles
// and addresses differ between runs; the object behind one has a name
// (1) if name() was called for it, or for the object that contains it: inputs and cells made from
//     outside, objects of the environment;
// (2) else, if it is in an object made by keyed allocation: the label of that allocation, i.e. the
//     key, and the offset in the object;
// (3) else it has none. The hash then depends on the handle and is valid only within this engine;
//     the call is marked in the file and counted.
//
// A comparison of two runs cannot distinguish two functions with one name, nor keyed allocations of
// types with one name and equal keys. Within one trace they are distinguished.
//
// Example
//   traces::Recorder recorder(engine);
//   for (const Item& item : items) recorder.name(item.next, "next", item.id);
//   recorder.record("before.trace");
//   const traces::Trace before = recorder.trace();
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "sac/engine.hpp"
#include "sac/label.hpp"
#include "sac/mod.hpp"
#include "traces/label_hash.hpp"
#include "traces/trace.hpp"

namespace traces {

/// The result of Recorder::record().
struct Recording {
  std::uint64_t calls = 0;
  std::uint64_t unnamed = 0;  // calls whose label contains an object without a name
};

/// Whether to record the edges of calls.
enum class Edges : bool { no, yes };

/// Records traces of an engine.
class Recorder {
 public:
  /// Requires: `engine` outlives the recorder.
  explicit Recorder(const sac::Engine& engine) : engine_(engine) {}

  /// Names `mod` in labels by `key`; a key consists of numbers and strings.
  /// Requires: no other object has this key.
  template <class T, class... Key>
  void name(sac::Mod<T> mod, const Key&... key) {
    handles_[mod.head().handle()] = hash_of_key(key...);
  }
  /// Names an object that traced functions take or read by pointer; parts of it are named by its
  /// name and their offset.
  template <class T, class... Key>
  void name(const T* object, const Key&... key) {
    addresses_[reinterpret_cast<const std::byte*>(object)] = {sizeof(T), hash_of_key(key...)};
  }

  /// Writes the current trace to a file. `edges`: whether to add the reads and effects of each
  /// call, as text.
  /// Throws: FileError; UsageError if the engine runs.
  /// Cost: O(n log n); memory 20 bytes for each keyed allocation, and 24 bytes for each call if any
  /// call has a result.
  Recording record(const std::string& path, Edges edges = Edges::no) const;
  /// The current trace, as load_trace() would read it from a file.
  /// Throws: UsageError if the engine runs.  Cost: as record(), without printing arguments.
  [[nodiscard]] Trace trace() const;

 private:
  friend class Labeller;

  template <class T>
  static void add_to_key(LabelHasher& hasher, const T& part) {
    if constexpr (std::is_convertible_v<const T&, std::string_view>) {
      hasher.text(part);
    } else {
      static_assert(std::is_integral_v<T> || std::is_enum_v<T>, "keys are numbers and strings");
      hasher.word(static_cast<std::uint64_t>(part));
    }
  }
  template <class... Key>
  static LabelHash hash_of_key(const Key&... key) {
    LabelHasher hasher;
    (add_to_key(hasher, key), ...);
    return hasher.result();
  }

  const sac::Engine& engine_;
  std::map<sac::Handle, LabelHash> handles_;
  struct Object {
    std::size_t bytes;
    LabelHash name;
  };
  std::map<const std::byte*, Object> addresses_;  // do not overlap
};

}  // namespace traces
