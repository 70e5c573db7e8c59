// Rows of tables, and what is said where they end too early.
#include "io/rows.hpp"

#include <algorithm>

namespace mesher {
namespace {

[[noreturn]] void fail_ended(const text::FieldLines& lines, std::size_t done, std::int64_t count,
                             const std::string& what) {
  throw lines.line().error(
      ErrorCode::truncated,
      "the file ends after " + std::to_string(done) + " of " + std::to_string(count) + " " + what,
      lines.line().size());
}

}  // namespace

std::int64_t read_count(const text::Line& line, std::size_t i) {
  const std::int64_t count = line.integer(i);
  if (count >= 0) return count;
  throw line.error(ErrorCode::bad_header, "a count of " + std::to_string(count), i);
}

const text::Line& header_row(text::FieldLines& lines, const std::string& path) {
  if (lines.next()) return lines.line();
  throw Error(ErrorCode::truncated, "no header: the file is empty", {path});
}

const text::Line& next_row(text::FieldLines& lines, std::size_t fields, std::size_t done,
                           std::int64_t count, const std::string& what) {
  if (!lines.next()) fail_ended(lines, done, count, what);
  const text::Line& line = lines.line();
  if (line.size() >= fields) return line;
  if (lines.at_end()) fail_ended(lines, done, count, what);
  throw line.error(ErrorCode::wrong_count,
                   std::to_string(line.size()) + " fields, expected " + std::to_string(fields),
                   line.size());
}

const text::Line& next_header(text::FieldLines& lines, const std::string& what) {
  if (lines.next()) return lines.line();
  throw lines.line().error(ErrorCode::truncated, "the file ends before the number of " + what,
                           lines.line().size());
}

void require_header(const text::Line& line, std::size_t most) {
  if (line.size() <= most) return;
  throw line.error(
      ErrorCode::bad_header,
      std::to_string(line.size()) + " numbers, expected " + std::to_string(most) + " at most",
      most);
}

bool read_markers(const text::Line& header, std::size_t i) {
  const std::int64_t markers = header.size() > i ? header.integer(i) : 0;
  if (markers == 0 || markers == 1) return markers == 1;
  throw header.error(ErrorCode::bad_header, "markers must be 0 or 1", i);
}

void require_fields(const text::Line& line, std::size_t least, std::size_t most) {
  if (line.size() >= least && line.size() <= most) return;
  throw line.error(ErrorCode::wrong_count,
                   std::to_string(line.size()) + " fields, expected " + std::to_string(most),
                   std::min(line.size(), most));
}

void require_end(text::FieldLines& lines, const std::string& what) {
  if (!lines.next()) return;
  throw lines.line().error(ErrorCode::wrong_count, "more " + what + " than the header says", 0);
}

void require_indexable(std::size_t vertices, const std::string& path) {
  if (vertices <= UINT32_MAX) return;
  throw Error(ErrorCode::too_many, std::to_string(vertices) + " vertices, 2^32 - 1 at most",
              {path});
}

}  // namespace mesher
