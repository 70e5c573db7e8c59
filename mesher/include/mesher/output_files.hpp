// Output files that appear whole, together, at the end, or not at all.
//
// Each file is written under a temporary name in its own directory. `commit` closes all of them,
// looks at every error a disk can report, and only then renames them to their targets, each of
// which is kept under another name until the last has its own. Whatever fails before that removes
// the temporaries and leaves the targets as they were.
#pragma once

#include <concepts>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/error.hpp"

namespace mesher {

/// A text file being written. Throws Error(cannot_write) where the system refuses.
class TextFile {
 public:
  /// Opens `path` for writing and empties it. Errors speak of `shown_as`.
  TextFile(const std::string& path, std::string shown_as);
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  ~TextFile();

  TextFile& operator<<(std::string_view text);
  TextFile& operator<<(char c) {
    if (used_ == buffer_.size()) flush();
    buffer_[used_++] = c;
    return *this;
  }
  /// The shortest decimal that reads back bit for bit.
  TextFile& operator<<(double value);
  TextFile& operator<<(std::integral auto value) { return add_integer(value); }
  /// What `write` puts where it is told: it returns the end of that, at most `most` characters on,
  /// which are 1024 at the most. For rows of many numbers.
  template <class Write>
  void add_up_to(std::size_t most, Write&& write) {
    if (buffer_.size() - used_ < most) flush();
    used_ = static_cast<std::size_t>(write(buffer_.data() + used_) - buffer_.data());
  }

  /// Writes what is left and closes.
  void close();

 private:
  TextFile& add_integer(long long value);
  void flush();
  [[noreturn]] void fail();

  std::string shown_as_;
  std::string buffer_;  // of a fixed size
  std::size_t used_ = 0;
  std::FILE* file_;
};

/// The output files of one command.
class OutputFiles {
 public:
  OutputFiles() = default;
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;
  /// Removes what has not been committed.
  ~OutputFiles();

  /// A new file that `commit` will name `target`; the reference stays valid until then.
  /// Throws: Error(cannot_write) if that could not work, Error(bad_option) if `target` is taken
  /// by another output or protected.
  TextFile& open(const std::string& target);

  /// Refuses `path` as a target: it is an input.
  void protect(const std::string& path) { protected_.push_back(path); }

  /// Closes all files and renames them to their targets.
  /// Throws: Error(cannot_write), and then the targets are as before.
  void commit();

  /// Where the files are until they are committed.
  [[nodiscard]] std::vector<std::string> temporaries() const;
  /// What they will be called, in the order of opening.
  [[nodiscard]] std::vector<std::string> targets() const;

 private:
  struct Entry {
    std::string target;     // as given
    std::string resolved;   // behind symbolic links
    std::string temporary;  // in the directory of `resolved`
    std::string kept;       // there as well: what had the target's name, if anything had
    std::unique_ptr<TextFile> file;
  };
  static void keep(Entry& entry);
  static void replace(Entry& entry);
  static void restore(Entry& entry) noexcept;
  void require_free(const Entry& entry) const;

  std::vector<Entry> entries_;
  std::vector<std::string> protected_;
};

}  // namespace mesher
