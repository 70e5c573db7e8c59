// Tables of a line-based file: a header with a count, then that many rows.
#pragma once

#include <cstdint>
#include <string>

#include "text/text.hpp"

namespace mesher {

/// Field i as a count. Throws: Error (bad_number, bad_header).
[[nodiscard]] std::int64_t read_count(const text::Line& line, std::size_t i);

/// The first line. Throws: Error(truncated) of the file `path` if there is none.
const text::Line& header_row(text::FieldLines& lines, const std::string& path);

/// The next line, which must be there with at least `fields` fields: row `done` of `count` of what
/// is called `what`. Throws: Error (truncated, wrong_count).
const text::Line& next_row(text::FieldLines& lines, std::size_t fields, std::size_t done,
                           std::int64_t count, const std::string& what);

/// The next line, with the number of what is called `what`. Throws: Error(truncated).
const text::Line& next_header(text::FieldLines& lines, const std::string& what);

/// Throws: Error(bad_header) if a header has more than `most` numbers.
void require_header(const text::Line& line, std::size_t most);

/// Whether a header's field i, 0 if it is not there, says that there are markers.
/// Throws: Error(bad_header) unless it is 0 or 1.
[[nodiscard]] bool read_markers(const text::Line& header, std::size_t i);

/// Throws: Error(wrong_count) unless a line has as many fields.
void require_fields(const text::Line& line, std::size_t least, std::size_t most);

/// Throws: Error(wrong_count) if another line follows.
void require_end(text::FieldLines& lines, const std::string& what);

/// Throws: Error(too_many): vertices are numbered by 32 bits.
void require_indexable(std::size_t vertices, const std::string& path);

}  // namespace mesher
