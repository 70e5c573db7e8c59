// A file that holds the updates of a run, so that one that was killed goes on where it was.
//
// Form: the line `mesher journal 1`, then records. A record is a head of 24 bytes (little endian:
// the word `upd\n`, the length of the text, the number of the record from 0 (8 bytes), the CRC-32
// of the text, the CRC-32 of the 20 bytes before) and a text. Text 0 says of which input and
// options the journal is; each other text is an edit script (edit_script.hpp) of one update.
// Comments in it:
//   # undo, # redo          what a live view made the update for
//   # sizes CRC FOLDER      the backgrounds that its limits name are in FOLDER, with this content
//   # start                 that it is of the script with which a live view began
//   # folded N HASH         it stands for N updates, whose lines have this hash
//
// Guarantees:
//   (1) append() has the whole record in the file when it returns (on the disk, if `sync`); if it
//       throws, the file is as before;
//   (2) an unfinished record at the end of a file, which a kill or a power cut leaves, is removed;
//       whatever else is not as it was written is refused, with the offset;
//   (3) while a journal is open, no other process can open it;
//   (4) replace() puts a shorter file in its place, or leaves it as it was.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tool {

/// What a journal belongs to, by name; compared one by one.
using JournalIdentity = std::vector<std::pair<std::string, std::string>>;

/// How far a run is: how many updates, and a hash of their lines.
struct JournalPlace {
  std::uint64_t updates = 0;
  std::uint64_t hash = 0xcbf29ce484222325;

  /// The place after an update of these lines.
  [[nodiscard]] JournalPlace after(const std::string& lines) const;
  friend bool operator==(const JournalPlace&, const JournalPlace&) = default;
};

class Journal {
 public:
  /// Opens a journal, or begins one. `sync`: every record is written to the disk.
  /// Throws: Error: bad_header if the file is something else, or of another version; bad_option if
  /// it belongs to something else, or is in use; bad_syntax if it is damaged; cannot_read,
  /// cannot_write.
  Journal(std::string path, const JournalIdentity& identity, bool sync);

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  /// The texts of the updates that were there, without the one with which it begins; taken once.
  [[nodiscard]] std::vector<std::string> take_found() { return std::move(found_); }
  /// What is to be told of opening it: bytes that were removed, another version of the program.
  [[nodiscard]] const std::vector<std::string>& notes() const noexcept { return notes_; }
  /// After what was found and appended so far.
  [[nodiscard]] const JournalPlace& place() const noexcept { return place_; }
  [[nodiscard]] std::uint64_t bytes() const noexcept { return bytes_; }
  /// Its length after the last replace(); 0 before.
  [[nodiscard]] std::uint64_t bytes_replaced() const noexcept { return bytes_replaced_; }

  /// `text`: the script of one update. Throws: Error(cannot_write), which says that the update is
  /// not in the journal.
  void append(const std::string& text, const std::string& lines);
  /// Puts one record in the place of all, which stands for them. Throws: Error(cannot_write).
  void replace(const std::string& text);

  /// The texts of all updates, joined: a script. Throws: Error(cannot_read).
  [[nodiscard]] std::string script() const;

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };
  using File = std::unique_ptr<std::FILE, Close>;

  [[nodiscard]] std::string beginning() const;
  void begin();
  void read(const std::string& content);
  void take_identity(const std::string& text) const;
  void take_update(std::string text, std::size_t offset);
  void cut(std::size_t offset, std::size_t size);

  std::string path_;
  JournalIdentity identity_;
  bool sync_;
  File file_;
  std::uint64_t bytes_ = 0, bytes_replaced_ = 0, records_ = 0;
  JournalPlace place_;
  std::vector<std::string> found_, notes_;
  bool broken_ = false;  // a record that failed could not be removed
};

/// The lines of a script without comments and begin and commit: what places count.
[[nodiscard]] std::string edit_lines(const std::string& script);

}  // namespace tool
