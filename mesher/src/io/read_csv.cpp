// Reads `.csv` files: columns by name where the first line names them, else exactly D numbers.
#include <algorithm>
#include <array>
#include <optional>

#include "io/read_points.hpp"
#include "io/text.hpp"

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
using Names = std::array<std::string_view, D>;

const std::vector<Names<2>> kPlane{{"x", "y"}, {"lon", "lat"}, {"longitude", "latitude"}};
const std::vector<Names<3>> kSpace{{"x", "y", "z"}};
const std::vector<Names<3>> kSizes{
    {"x", "y", "h"}, {"lon", "lat", "h"}, {"longitude", "latitude", "h"}};

template <int D>
std::string text_of(const std::vector<Names<D>>& sets) {
  std::string text;
  for (const auto& names : sets) {
    text += text.empty() ? "" : " or ";
    for (const auto& name : names) text += (name == names[0] ? "" : ",") + std::string(name);
  }
  return text;
}

// The columns of the first set of names that the header has in full.
template <int D>
Columns<D> named_columns(const text::Line& header, const std::vector<Names<D>>& sets) {
  for (const Names<D>& names : sets) {
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
Columns<D> unnamed_columns(const text::Line& line) {
  if (line.size() > D) {
    throw line.error(ErrorCode::bad_dimension,
                     std::to_string(line.size()) + " columns, expected " + std::to_string(D) +
                         ": name the columns in a first line (x,y)",
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

// Columns of the first of `sets` that the file names in full, or its D columns if it names none.
template <int D>
PointFile<D> read_columns(const std::string& path, const std::vector<Names<D>>& sets) {
  const std::string content = text::read_file(path);
  PointFile<D> rows{path, {}, {}, {}};
  text::Line line(path);
  std::optional<Columns<D>> columns;
  std::size_t width = 0;
  char separator = ',';
  for (text::Lines lines(content); lines.next();) {
    if (!columns) separator = separator_of(lines.text());
    line.split_separated(lines.number(), lines.text(), separator);
    if (is_blank_or_comment(line)) continue;
    if (!columns) {
      const bool named = is_header(line);
      columns = named ? named_columns<D>(line, sets) : unnamed_columns<D>(line);
      width = named ? line.size() : D;
      if (named) continue;
    }
    require_fields(line, width, lines);
    add_row<D>(rows, read_point<D>(line, *columns), line.number());
  }
  return rows;
}

}  // namespace

template <>
PointFile<2> read_csv<2>(const std::string& path) {
  return read_columns<2>(path, kPlane);
}

template <>
PointFile<3> read_csv<3>(const std::string& path) {
  return read_columns<3>(path, kSpace);
}

PointFile<3> read_csv_sizes(const std::string& path) { return read_columns<3>(path, kSizes); }

}  // namespace mesher
