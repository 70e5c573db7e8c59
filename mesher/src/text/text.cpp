// Lines, fields and checked numbers of text files.
#include "text/text.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <utility>

#include "sac/check.hpp"

namespace mesher::text {
namespace {

constexpr std::string_view kBlanks = " \t\v\f";
constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
constexpr std::string_view kSpace = " \t\v\f\r\n";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return text.substr(text.size());
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string_view without_comment(std::string_view text) { return text.substr(0, text.find('#')); }

Error cannot_read(const std::string& path) {
  return {ErrorCode::cannot_read, std::string("cannot be read: ") + std::strerror(errno), {path}};
}

// "+5" is 5, but "+-5" is not a number.
std::string_view without_plus(std::string_view text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return plus ? text.substr(1) : text;
}

// "1e-9999" may come back as 0 without complaint.
bool has_nonzero_digit(std::string_view text) {
  const auto mantissa = text.substr(0, text.find_first_of("eE"));
  return mantissa.find_first_of("123456789") != std::string_view::npos;
}

// The numbers of fields; `fail(code, message)` makes the error that is thrown.
template <class Fail>
double parse_finite(std::string_view text, Fail fail) {
  const auto field = without_plus(text);
  double value = 0;
  const auto [end, status] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (status == std::errc::invalid_argument || end != field.data() + field.size()) {
    throw fail(ErrorCode::bad_number, quoted(text) + " is not a number");
  }
  if (status == std::errc::result_out_of_range || (value == 0 && has_nonzero_digit(field))) {
    throw fail(ErrorCode::magnitude, quoted(text) + " is beyond the range of a double");
  }
  if (!std::isfinite(value)) {
    throw fail(ErrorCode::not_finite, quoted(text) + " is not a finite number");
  }
  return value;
}

template <class Fail>
double parse_coordinate(std::string_view text, Fail fail) {
  const double value = parse_finite(text, fail);
  if (is_coordinate(value)) return value + 0.0;
  throw fail(ErrorCode::magnitude,
             "coordinate " + quoted(text) + " is neither 0 nor of magnitude 2^-100 to 2^100");
}

template <class Fail>
std::int64_t parse_integer(std::string_view text, Fail fail) {
  const auto field = without_plus(text);
  std::int64_t value = 0;
  const auto [end, status] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (status == std::errc{} && end == field.data() + field.size()) return value;
  throw fail(ErrorCode::bad_number, quoted(text) + " is not an integer of 64 bits");
}

// Makes errors of a place that `where.error` understands.
template <class Where, class At>
auto failing_at(const Where& where, At at) {
  return [&where, at](ErrorCode code, const std::string& message) {
    return where.error(code, message, at);
  };
}

}  // namespace

std::string read_file(const std::string& path, std::size_t most) {
  errno = 0;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) throw cannot_read(path);
  // Of a pipe the size is not known. One byte more than it, and the end is seen at once.
  constexpr std::size_t kLeast = 1 << 16;
  std::error_code unknown;
  const auto bytes = std::filesystem::file_size(path, unknown);
  std::string content(std::min(unknown ? kLeast : static_cast<std::size_t>(bytes) + 1, most), '\0');
  std::size_t size = 0;
  while (const auto n = std::fread(content.data() + size, 1, content.size() - size, file.get())) {
    size += n;
    if (size == content.size()) content.resize(std::min(2 * size + kLeast, most));
  }
  if (std::ferror(file.get())) throw cannot_read(path);
  content.resize(size);
  return content;
}

Share whole_file(const std::string& path) { return {path, read_file(path)}; }

std::string read_lines(const std::string& path, std::uint64_t from, std::uint64_t to) {
  SAC_EXPECTS(from <= to);
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  // A line begins behind the end of another.
  const std::uint64_t start = from - std::min<std::uint64_t>(from, 1);
  if (!file.seekg(static_cast<std::streamoff>(start))) throw cannot_read(path);
  std::string text(static_cast<std::size_t>(to - start), '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (file.bad()) throw cannot_read(path);
  if (from > 0) {
    const std::size_t end = text.find('\n');
    if (end == std::string::npos || end + 1 == to - start) return {};
    text.erase(0, end + 1);
  }
  std::string more;
  if (!text.empty() && text.back() != '\n' && std::getline(file, more)) {
    text += more;
    if (!file.eof()) text += '\n';
  }
  if (file.bad()) throw cannot_read(path);
  return text;
}

std::string extension(const std::string& path) {
  std::string ext = std::filesystem::path(path).extension().string();
  std::transform(ext.begin(), ext.end(), ext.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return ext;
}

std::string with_extension(const std::string& path, const std::string& extension) {
  return std::filesystem::path(path).replace_extension(extension).string();
}

std::string to_text(double value) {
  char digits[32];  // the longest shortest form has 24 characters
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  return {digits, end};
}

bool is_coordinate(double value) noexcept {
  const double size = std::abs(value);
  return value == 0 || (size >= 0x1p-100 && size <= 0x1p100);
}

void Line::split_blanks(long number, std::string_view text) {
  number_ = number;
  fields_.clear();
  continued_.clear();
  const char* const end = add_fields(text);
  text_ = text.substr(0, static_cast<std::size_t>(end - text.data()));
}

void Line::continue_blanks(long number, std::string_view text) {
  fields_.back().remove_suffix(1);
  if (fields_.back().empty()) fields_.pop_back();
  continued_.push_back({number, text.data()});
  add_fields(text);
}

const char* Line::add_fields(std::string_view text) {
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end && *at != '#') {
    if (is_blank(*at)) {
      ++at;
      continue;
    }
    const char* const from = at;
    while (at != end && *at != '#' && !is_blank(*at)) ++at;
    fields_.emplace_back(from, static_cast<std::size_t>(at - from));
  }
  return at;
}

void Line::split_separated(long number, std::string_view text, char separator) {
  number_ = number;
  text_ = text;
  fields_.clear();
  continued_.clear();
  bool in_quotes = false;
  for (std::size_t at = 0, begin = 0; at <= text.size(); ++at) {
    if (at < text.size() && text[at] == '"') in_quotes = !in_quotes;
    if (at < text.size() && (in_quotes || text[at] != separator)) continue;
    auto field = trim(text.substr(begin, at - begin));
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
      field = trim(field.substr(1, field.size() - 2));
    }
    fields_.push_back(field);
    begin = at + 1;
  }
}

std::string_view Line::trimmed() const { return trim(text_); }

FilePosition Line::position(std::size_t i) const {
  const char* at = text_.data();
  if (i < fields_.size())
    at = fields_[i].data();
  else if (!fields_.empty())
    at = fields_.back().data() + fields_.back().size();
  Start start{number_, text_.data()};
  for (const Start& next : continued_) {
    if (next.at <= at) start = next;
  }
  return {start.number, at - start.at + 1};
}

double Line::finite(std::size_t i) const { return parse_finite(fields_[i], failing_at(*this, i)); }

double Line::coordinate(std::size_t i) const {
  return parse_coordinate(fields_[i], failing_at(*this, i));
}

std::int64_t Line::integer_before(std::size_t i, std::size_t size) const {
  return parse_integer(fields_[i].substr(0, size), failing_at(*this, i));
}

Source::Source(const std::string& path) : file_(path), content_(read_file(path)) {}

FilePosition Source::position(std::string_view at) const {
  if (line_starts_.empty()) {
    line_starts_.push_back(0);
    for (std::size_t i = 0; i < content_.size(); ++i) {
      if (content_[i] == '\n') line_starts_.push_back(i + 1);
    }
  }
  const auto offset = static_cast<std::size_t>(at.data() - content_.data());
  const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  return {after - line_starts_.begin(), static_cast<long>(offset - *(after - 1)) + 1};
}

double Source::finite(std::string_view field) const {
  return parse_finite(field, failing_at(*this, field));
}

double Source::coordinate(std::string_view field) const {
  return parse_coordinate(field, failing_at(*this, field));
}

std::int64_t Source::integer(std::string_view field) const {
  return parse_integer(field, failing_at(*this, field));
}

std::string_view Fields::next() {
  const auto begin = std::min(rest_.find_first_not_of(kSpace), rest_.size());
  const auto end = std::min(rest_.find_first_of(kSpace, begin), rest_.size());
  const auto field = rest_.substr(begin, end - begin);
  rest_.remove_prefix(end);
  return field;
}

Lines::Lines(std::string_view text) : rest_(text) {
  if (rest_.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
    rest_.remove_prefix(kByteOrderMark.size());
  }
}

Lines::Lines(const Share& share) : Lines(share.is_first ? share.lines : share.head) {
  if (!share.is_first) behind_head_ = share.lines, lines_before_ = share.lines_before;
  is_followed_ = share.is_followed;
}

bool Lines::next() {
  if (rest_.empty() && !behind_head_.empty()) {
    rest_ = std::exchange(behind_head_, {});
    number_ = lines_before_;
  }
  if (rest_.empty()) return false;
  const auto end = std::min(rest_.find('\n'), rest_.size());
  line_ = rest_.substr(0, end);
  if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  ++number_;
  return true;
}

bool Lines::at_end() const {
  if (is_followed_) return false;
  Lines ahead = *this;
  while (ahead.next()) {
    if (!trim(without_comment(ahead.text())).empty()) return false;
  }
  return true;
}

bool FieldLines::next() {
  while (lines_.next()) {
    line_.split_blanks(lines_.number(), lines_.text());
    while (continued_ == Continued::by_backslash && line_.is_continued() && lines_.next()) {
      line_.continue_blanks(lines_.number(), lines_.text());
    }
    if (line_.size() > 0) return true;
  }
  return false;
}

}  // namespace mesher::text
