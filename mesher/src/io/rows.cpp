// Rows of tables, and what is said where they end too early.
#include "io/rows.hpp"

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
