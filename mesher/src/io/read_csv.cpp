// Reads `.csv` files: columns by name where the first line names them, else exactly D numbers.
#include <algorithm>
#include <array>
#include <optional>

#include "io/line_points.hpp"
#include "io/read_points.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

constexpr std::size_t kMissing = static_cast<std::size_t>(-1);

template <int D>
using Columns = std::array<std::size_t, D>;

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return out;
}

char separator_of(std::string_view line) {
  for (const char c : {',', ';', '\t'}) {
    if (line.find(c) != std::string_view::npos) return c;
  }
  return ',';
}

bool is_blank_or_comment(const text::Line& line) {
  if (line.size() == 1 && line[0].empty()) return true;
  return !line[0].empty() && line[0].front() == '#';
}

std::size_t find_column(const text::Line& header, std::string_view name) {
  std::size_t found = kMissing;
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (lower(header[i]) != name) continue;
    if (found != kMissing) {
      throw header.error(ErrorCode::bad_header, "two columns are named " + text::quoted(name), i);
    }
    found = i;
  }
  return found;
}

// Columns that belong together, by name.
template <int D>
using ColumnNames = std::array<std::string_view, D>;

const std::vector<ColumnNames<2>> kPlaneColumns{
    {"x", "y"}, {"lon", "lat"}, {"longitude", "latitude"}};
const std::vector<ColumnNames<3>> kSpaceColumns{{"x", "y", "z"}};
const std::vector<ColumnNames<3>> kSizes{
    {"x", "y", "h"}, {"lon", "lat", "h"}, {"longitude", "latitude", "h"}};
const std::vector<ColumnNames<4>> kSpaceSizes{{"x", "y", "z", "h"}};

template <int D>
std::string text_of(const ColumnNames<D>& names) {
  std::string text;
  for (const auto& name : names) text += (name == names[0] ? "" : ",") + std::string(name);
  return text;
}

template <int D>
std::string text_of(const std::vector<ColumnNames<D>>& sets) {
  std::string text;
  for (const auto& names : sets) text += (text.empty() ? "" : " or ") + text_of<D>(names);
  return text;
}

// The columns of the first set of names that the header has in full.
template <int D>
Columns<D> named_columns(const text::Line& header, const std::vector<ColumnNames<D>>& sets) {
  for (const ColumnNames<D>& names : sets) {
    Columns<D> columns;
    std::transform(names.begin(), names.end(), columns.begin(),
                   [&](std::string_view name) { return find_column(header, name); });
    if (std::find(columns.begin(), columns.end(), kMissing) == columns.end()) return columns;
  }
  throw header.error(ErrorCode::bad_header, "no columns named " + text_of<D>(sets), 0);
}

bool is_number(const text::Line& line, std::size_t i) {
  try {
    (void)line.finite(i);
    return true;
  } catch (const Error& error) {
    return error.code() != ErrorCode::bad_number;  // NaN is a number that is refused, not a name
  }
}

// A first line without any number names the columns.
bool is_header(const text::Line& line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (is_number(line, i)) return false;
  }
  return true;
}

template <int D>
Columns<D> unnamed_columns(const text::Line& line, const ColumnNames<D>& names) {
  if (line.size() > D) {
    throw line.error(ErrorCode::bad_dimension,
                     std::to_string(line.size()) + " columns, expected " + std::to_string(D) +
                         ": name the columns in a first line (" + text_of<D>(names) + ")",
                     D);
  }
  Columns<D> columns;
  for (std::size_t i = 0; i < D; ++i) columns[i] = i;
  return columns;
}

// A row that is too short is the file's end where nothing follows, and a mistake elsewhere.
void require_fields(const text::Line& line, std::size_t width, const text::Lines& lines) {
  if (line.size() == width) return;
  const bool cut = line.size() < width && lines.at_end();
  throw line.error(cut ? ErrorCode::truncated : ErrorCode::wrong_count,
                   std::to_string(line.size()) + " fields, expected " + std::to_string(width),
                   std::min(line.size(), width));
}

template <int D>
Point<D> read_point(const text::Line& line, const Columns<D>& columns) {
  Point<D> point;
  for (std::size_t i = 0; i < D; ++i) point[i] = line.coordinate(columns[i]);
  return point;
}

// The lines of a file that are neither blank nor comments, split where the first of them says.
class CsvLines {
 public:
  explicit CsvLines(const text::Share& share) : lines_(share), line_(share.file) {}

  bool next() {
    while (lines_.next()) {
      if (first_) separator_ = separator_of(lines_.text());
      line_.split_separated(lines_.number(), lines_.text(), separator_);
      if (is_blank_or_comment(line_)) continue;
      first_ = false;
      return true;
    }
    return false;
  }
  [[nodiscard]] const text::Line& line() const { return line_; }
  [[nodiscard]] const text::Lines& lines() const { return lines_; }
  [[nodiscard]] std::string_view rest() const { return lines_.rest(); }

 private:
  text::Lines lines_;
  text::Line line_;
  char separator_ = ',';
  bool first_ = true;
};

// Columns of the first of `sets` that the file names in full, or its D columns if it names none.
template <int D>
PointFile<D> read_columns(const text::Share& share, const std::vector<ColumnNames<D>>& sets) {
  PointFile<D> rows{share.file, {}, {}, {}};
  std::optional<Columns<D>> columns;
  std::size_t width = 0;
  for (CsvLines all(share); all.next();) {
    const text::Line& line = all.line();
    if (!columns) {
      const bool named = is_header(line);
      columns = named ? named_columns<D>(line, sets) : unnamed_columns<D>(line, sets.front());
      width = named ? line.size() : D;
      if (named || !share.is_first) continue;
    }
    require_fields(line, width, all.lines());
    add_row<D>(rows, read_point<D>(line, *columns), line.number(), share.rows_before);
  }
  return rows;
}

// The column z of a header that names x and y as well; kMissing if it does not.
std::size_t height_column(const text::Line& header) {
  std::size_t z = kMissing;
  for (const std::string_view name : kSpaceColumns.front()) {
    z = find_column(header, name);
    if (z == kMissing) break;
  }
  return z;
}

}  // namespace

std::string csv_head(const std::string& path) { return head_of<CsvLines>(path); }

std::size_t csv_rows(const text::Share& share) {
  CsvLines all(share);
  if (!all.next()) return 0;
  std::size_t rows = share.is_first && !is_header(all.line()) ? 1 : 0;
  while (all.next()) ++rows;
  return rows;
}

bool csv_is_in_space(const text::Share& share) {
  CsvLines all(share);
  if (!all.next()) return false;
  if (!is_header(all.line())) return all.line().size() == 3;
  const std::size_t z = height_column(all.line());
  if (z == kMissing) return false;
  while (all.next()) {
    if (!is_zero(all.line(), z)) return true;
  }
  return false;
}

template <>
PointFile<2> read_csv<2>(const text::Share& share) {
  return read_columns<2>(share, kPlaneColumns);
}

template <>
PointFile<3> read_csv<3>(const text::Share& share) {
  return read_columns<3>(share, kSpaceColumns);
}

template <>
PointFile<3> read_csv_sizes<2>(const std::string& path) {
  return read_columns<3>(text::whole_file(path), kSizes);
}

template <>
PointFile<4> read_csv_sizes<3>(const std::string& path) {
  return read_columns<4>(text::whole_file(path), kSpaceSizes);
}

}  // namespace mesher
