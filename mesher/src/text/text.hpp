// Reading text files: lines, fields with their columns, and numbers that are checked.
//
// Most readers walk a file line by line with `Line`, which knows its location; so each error
// carries file, line and column without the reader's help. Formats that are not line-based are read
// from a `Source`, which finds the location of any part of its text. Numbers are parsed by
// std::from_chars (no locale); a leading '+' is accepted.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/mesh.hpp"

namespace mesher::text {

/// The whole file, or its first `most` bytes. Throws: Error(cannot_read).
[[nodiscard]] std::string read_file(const std::string& path, std::size_t most = SIZE_MAX);

/// The part of a path from its last dot, in lower case (".node"); empty if there is none.
[[nodiscard]] std::string extension(const std::string& path);

/// `path` with `extension` in place of its own.
[[nodiscard]] std::string with_extension(const std::string& path, const std::string& extension);

/// A part of a file in quotes, as it may be shown to people; see text/printable.hpp.
[[nodiscard]] std::string quoted(std::string_view text);

/// The shortest decimal that reads back as `value`.
[[nodiscard]] std::string to_text(double value);

/// "(x, y)"
template <int D>
[[nodiscard]] std::string to_text(const Point<D>& p) {
  std::string text = "(";
  for (int i = 0; i < D; ++i) text += (i > 0 ? ", " : "") + to_text(p[i]);
  return text + ")";
}

/// Whether `value` is 0 or of magnitude 2^-100 .. 2^100, as input coordinates must be.
[[nodiscard]] bool is_coordinate(double value) noexcept;

/// One line of a file as fields: between blanks, or between separators as in a .csv file.
class Line {
 public:
  explicit Line(std::string file) : file_(std::move(file)) {}

  /// Takes the next line; a '#' and what follows it is dropped. `text` must outlive the fields.
  void split_blanks(long number, std::string_view text);
  /// Whether the line ends with a backslash: the next one continues it.
  [[nodiscard]] bool is_continued() const {
    return !fields_.empty() && fields_.back().ends_with('\\');
  }
  /// Takes the line that continues this one, whose backslash goes. Requires: is_continued(), and
  /// both are parts of one text.
  void continue_blanks(long number, std::string_view text);
  /// The same with fields between `separator`s, trimmed; a field may stand in double quotes.
  void split_separated(long number, std::string_view text, char separator);

  [[nodiscard]] std::size_t size() const { return fields_.size(); }
  [[nodiscard]] std::string_view operator[](std::size_t i) const { return fields_[i]; }
  /// Of the first, if lines continue it.
  [[nodiscard]] long number() const { return number_; }
  /// The line without comment and outer blanks.
  [[nodiscard]] std::string_view trimmed() const;

  /// Where field i begins, or the end of the last field.
  [[nodiscard]] FilePosition position(std::size_t i) const;
  [[nodiscard]] FileLocation place(std::size_t i) const {
    const FilePosition found = position(i);
    return {file_, found.line, found.column};
  }
  [[nodiscard]] Error error(ErrorCode code, const std::string& message, std::size_t i) const {
    return {code, message, place(i)};
  }

  /// Field i as a number. Throws: Error (bad_number, not_finite, magnitude beyond a double's).
  [[nodiscard]] double finite(std::size_t i) const;
  /// Field i as an input coordinate; -0 becomes 0. Throws: as finite, or Error(magnitude).
  [[nodiscard]] double coordinate(std::size_t i) const;
  /// Field i as an integer. Throws: Error(bad_number).
  [[nodiscard]] std::int64_t integer(std::size_t i) const { return integer_before(i, SIZE_MAX); }
  /// The first `size` characters of field i, or all of it, as an integer. Throws: likewise.
  [[nodiscard]] std::int64_t integer_before(std::size_t i, std::size_t size) const;

 private:
  // Returns where a comment begins, or the text's end.
  const char* add_fields(std::string_view text);

  struct Start {
    long number;
    const char* at;
  };
  std::string file_;
  std::string_view text_;
  long number_ = 0;
  std::vector<Start> continued_;  // by further lines
  std::vector<std::string_view> fields_;
};

/// The lines of a file that one process reads: all; or, where several read one file together, some
/// of them, and the first lines, the *head*, which each reads.
struct Share {
  std::string file;
  std::string lines{};
  bool is_first = true;         ///< `lines` begin the file, and the head is a part of them
  std::string head{};           ///< if they do not
  long lines_before = 0;        ///< of the file, before `lines`
  std::size_t rows_before = 0;  ///< of these, those with what is read line by line
  bool is_followed = false;     ///< by more than blanks and comments
};

/// Throws: Error(cannot_read).
[[nodiscard]] Share whole_file(const std::string& path);

/// The lines of a file that begin at one of the bytes `from` to `to` - 1, up to their ends. Throws:
/// Error(cannot_read).
[[nodiscard]] std::string read_lines(const std::string& path, std::uint64_t from, std::uint64_t to);

/// Cuts a text into lines; LF or CRLF, the last line's end may be missing.
class Lines {
 public:
  explicit Lines(std::string_view text);
  /// The head, and then the lines. `share` must outlive them.
  explicit Lines(const Share& share);
  /// Goes to the next line. False at the end of the text.
  bool next();
  [[nodiscard]] std::string_view text() const { return line_; }
  [[nodiscard]] long number() const { return number_; }
  /// Whether nothing but blanks and comments follows the current line.
  [[nodiscard]] bool at_end() const;
  /// What follows the current line in its text.
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::string_view behind_head_;
  long lines_before_ = 0;  // behind_head_
  bool is_followed_ = false;
  std::string_view line_;
  long number_ = 0;
};

/// Whether a backslash at the end of a line continues it.
enum class Continued : bool { no, by_backslash };

/// The lines of a text that hold fields, split at blanks.
class FieldLines {
 public:
  FieldLines(const std::string& file, std::string_view content, Continued continued = Continued::no)
      : lines_(content), line_(file), continued_(continued) {}
  /// `share` must outlive them.
  explicit FieldLines(const Share& share)
      : lines_(share), line_(share.file), continued_(Continued::no) {}
  /// Goes to the next line with a field. False at the end of the text.
  bool next();
  [[nodiscard]] const Line& line() const { return line_; }
  [[nodiscard]] bool at_end() const { return lines_.at_end(); }
  [[nodiscard]] std::string_view rest() const { return lines_.rest(); }

 private:
  Lines lines_;
  Line line_;
  Continued continued_;
};

/// The whole text of a file, for readers to whom line ends are blanks. What is passed as `at` or
/// `field` is a part of the content.
class Source {
 public:
  /// Throws: Error(cannot_read).
  explicit Source(const std::string& path);
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] std::string_view content() const { return content_; }
  [[nodiscard]] std::string_view end() const { return content().substr(content_.size()); }

  /// Where a part of the content begins. Cost: O(log n); O(n) the first time.
  [[nodiscard]] FilePosition position(std::string_view at) const;
  [[nodiscard]] FileLocation place(std::string_view at) const {
    const FilePosition found = position(at);
    return {file_, found.line, found.column};
  }
  [[nodiscard]] Error error(ErrorCode code, const std::string& message, std::string_view at) const {
    return {code, message, place(at)};
  }

  /// As the functions of Line. Throws: Error likewise.
  [[nodiscard]] double finite(std::string_view field) const;
  [[nodiscard]] double coordinate(std::string_view field) const;
  [[nodiscard]] std::int64_t integer(std::string_view field) const;

 private:
  std::string file_;
  std::string content_;
  mutable std::vector<std::size_t> line_starts_;  // offsets; found when first asked for
};

/// The fields of a text, wherever its lines end.
class Fields {
 public:
  explicit Fields(std::string_view text) : rest_(text) {}
  /// The next field; empty, at the end of the text, if there is none.
  std::string_view next();
  /// What follows the last field, for readers of binary data between fields.
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

}  // namespace mesher::text
