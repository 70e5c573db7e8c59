// Journals: records with checksums, appended one by one.
#include "journal.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string_view>

#include "mesher/error.hpp"
#include "platform/process.hpp"

namespace tool {
namespace {

namespace fs = std::filesystem;
using mesher::Error;
using mesher::ErrorCode;

constexpr std::string_view kTitle = "mesher journal ";
constexpr std::string_view kFirstLine = "mesher journal 1\n";
constexpr std::string_view kWord = "upd\n";
constexpr std::size_t kHead = 24, kHeadChecked = 20;
constexpr std::size_t kLongest = std::size_t{1} << 31;
constexpr std::string_view kFolded = "# folded ";

std::uint32_t checksum(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      ::crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

void add_number(std::string& bytes, std::uint64_t number, int size) {
  for (int i = 0; i < size; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xff);
}
std::uint64_t number_at(std::string_view bytes, std::size_t at, int size) {
  std::uint64_t number = 0;
  for (int i = size; i-- > 0;) number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

std::string record_of(std::uint64_t number, const std::string& text) {
  std::string record(kWord);
  add_number(record, text.size(), 4);
  add_number(record, number, 8);
  add_number(record, checksum(text), 4);
  add_number(record, checksum(record), 4);
  return record + text;
}

// What stands at an offset: a record, the beginning of one, or neither.
struct Found {
  enum class What { record, unfinished, damaged } what = What::damaged;
  std::uint64_t number = 0;
  std::string_view text;
};

Found record_at(std::string_view all, std::size_t offset) {
  const std::string_view rest = all.substr(offset);
  if (rest.size() < kHead) return {Found::What::unfinished, 0, {}};
  const bool is_head = rest.substr(0, kWord.size()) == kWord &&
                       number_at(rest, kHeadChecked, 4) == checksum(rest.substr(0, kHeadChecked));
  if (!is_head) return {};
  const std::size_t length = number_at(rest, 4, 4);
  if (rest.size() - kHead < length) return {Found::What::unfinished, 0, {}};
  const std::string_view text = rest.substr(kHead, length);
  if (number_at(rest, 16, 4) != checksum(text)) return {};
  return {Found::What::record, number_at(rest, 8, 8), text};
}

// Whether a whole record follows: then what is damaged before it was not left by a kill.
bool has_record_after(std::string_view all, std::size_t offset) {
  for (std::size_t at = all.find(kWord, offset + 1); at != std::string_view::npos;
       at = all.find(kWord, at + 1)) {
    if (record_at(all, at).what == Found::What::record) return true;
  }
  return false;
}

Error damaged(const std::string& path, std::size_t offset, const std::string& what) {
  return {ErrorCode::bad_syntax,
          "the journal is damaged at byte " + std::to_string(offset) + ": " + what,
          {path}};
}

Error failed(ErrorCode code, const std::string& path, int error, const std::string& more = "") {
  const bool reads = code == ErrorCode::cannot_read;
  return {
      code,
      std::string(reads ? "cannot be read: " : "cannot be written: ") + std::strerror(error) + more,
      {path}};
}

std::string all_of_journal(const std::string& path) {
  errno = 0;
  std::FILE* const file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) throw failed(ErrorCode::cannot_read, path, errno);
  std::string content;
  std::array<char, 1 << 16> part;
  while (const auto n = std::fread(part.data(), 1, part.size(), file)) {
    content.append(part.data(), n);
  }
  const int error = std::ferror(file) != 0 ? (errno != 0 ? errno : EIO) : 0;
  std::fclose(file);
  if (error != 0) throw failed(ErrorCode::cannot_read, path, error);
  return content;
}

// All of it, or why not.
int write_all(std::FILE* file, const std::string& bytes, bool sync) {
  errno = 0;
  if (std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size() || std::fflush(file) != 0) {
    return errno != 0 ? errno : EIO;
  }
  return sync ? platform::sync(file) : 0;
}

std::string text_of_identity(const JournalIdentity& identity) {
  std::string text;
  for (const auto& [name, value] : identity) text += name + " " + value + "\n";
  return text;
}

std::uint64_t hash_of(std::uint64_t hash, std::string_view text) {  // FNV-1a
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

std::optional<JournalPlace> folded_place(const std::string& text) {
  if (!text.starts_with(kFolded)) return std::nullopt;
  JournalPlace place;
  const char* const end = text.data() + text.find('\n');
  const auto number = std::from_chars(text.data() + kFolded.size(), end, place.updates);
  if (number.ec != std::errc{} || number.ptr == end) return std::nullopt;
  const auto hash = std::from_chars(number.ptr + 1, end, place.hash, 16);
  if (hash.ec != std::errc{} || hash.ptr != end) return std::nullopt;
  return place;
}

std::string folded_line(const JournalPlace& place) {
  char digits[17];
  const auto end = std::to_chars(digits, digits + sizeof digits, place.hash, 16).ptr;
  return std::string(kFolded) + std::to_string(place.updates) + " " + std::string(digits, end) +
         "\n";
}

}  // namespace

std::string edit_lines(const std::string& script) {
  std::istringstream stream(script);
  std::string lines;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line[0] == '#' || line == "begin" || line == "commit") continue;
    lines += line + "\n";
  }
  return lines;
}

JournalPlace JournalPlace::after(const std::string& lines) const {
  return {updates + 1, hash_of(hash_of(hash, lines), "\n")};
}

Journal::Journal(std::string path, const JournalIdentity& identity, bool sync)
    : path_(std::move(path)), identity_(identity), sync_(sync) {
  std::error_code none;
  if (fs::is_directory(path_, none)) throw failed(ErrorCode::cannot_write, path_, EISDIR);
  errno = 0;
  file_ = File(platform::open_to_append(path_));
  if (!file_) throw failed(ErrorCode::cannot_write, path_, errno);
  if (!platform::lock(file_.get())) {
    throw Error(ErrorCode::bad_option, "the journal is in use by another process", {path_});
  }
  const std::string content = all_of_journal(path_);
  const std::string start = beginning();
  if (content.size() < start.size() && start.starts_with(content)) {
    if (!content.empty()) cut(0, content.size());
    begin();
  } else {
    read(content);
  }
}

std::string Journal::beginning() const {
  return std::string(kFirstLine) + record_of(0, text_of_identity(identity_));
}

void Journal::begin() {
  const std::string start = beginning();
  if (const int error = write_all(file_.get(), start, sync_)) {
    file_.reset();
    std::error_code ignored;
    fs::remove(path_, ignored);
    throw failed(ErrorCode::cannot_write, path_, error);
  }
  if (sync_) platform::sync_folder_of(path_);
  bytes_ = start.size();
  records_ = 1;
}

// Removes what an unfinished record has left.
void Journal::cut(std::size_t offset, std::size_t size) {
  if (const int error = platform::shorten(file_.get(), path_, offset)) {
    throw failed(ErrorCode::cannot_write, path_, error);
  }
  notes_.push_back(std::to_string(size - offset) + " bytes at byte " + std::to_string(offset) +
                   " are of an update that was not finished; they are removed");
}

void Journal::read(const std::string& content) {
  if (!content.starts_with(kFirstLine)) {
    const std::string line = content.substr(0, content.find('\n'));
    throw Error(ErrorCode::bad_header,
                line.starts_with(kTitle) && line.size() < 40
                    ? "a journal of version " + line.substr(kTitle.size()) +
                          "; this program reads version 1"
                    : "not a journal: it does not begin with 'mesher journal 1'",
                {path_});
  }
  std::size_t offset = kFirstLine.size();
  while (offset < content.size()) {
    const Found found = record_at(content, offset);
    if (found.what != Found::What::record) {
      if (has_record_after(content, offset)) throw damaged(path_, offset, "a record is not whole");
      if (records_ == 0) throw damaged(path_, offset, "what it belongs to is lost");
      cut(offset, content.size());
      break;
    }
    if (found.number != records_) {
      throw damaged(path_, offset,
                    "record " + std::to_string(found.number) + " follows record " +
                        std::to_string(records_ - 1));
    }
    if (records_ == 0) {
      take_identity(std::string(found.text));
    } else {
      take_update(std::string(found.text), offset);
    }
    ++records_;
    offset += kHead + found.text.size();
  }
  bytes_ = offset;
}

void Journal::take_identity(const std::string& text) const {
  std::istringstream stream(text);
  JournalIdentity was;
  for (std::string line; std::getline(stream, line);) {
    const auto blank = line.find(' ');
    if (blank != std::string::npos) was.emplace_back(line.substr(0, blank), line.substr(blank + 1));
  }
  for (const auto& [name, value] : identity_) {
    const auto same = std::find_if(was.begin(), was.end(),
                                   [&n = name](const auto& part) { return part.first == n; });
    const std::string before = same == was.end() ? "none" : same->second;
    if (before == value) continue;
    throw Error(ErrorCode::bad_option,
                name == "input" ? "the journal belongs to another input: the hash of its points, "
                                  "lines, polygons, holes and regions was " +
                                      before + ", here it is " + value
                                : "the journal belongs to another run: " + name + " was " + before +
                                      ", here it is " + value,
                {path_});
  }
}

void Journal::take_update(std::string text, std::size_t offset) {
  if (text.starts_with(kFolded)) {
    const auto place = records_ == 1 ? folded_place(text) : std::nullopt;
    if (!place) throw damaged(path_, offset, "it does not say which updates it stands for");
    place_ = *place;
  } else {
    place_ = place_.after(edit_lines(text));
  }
  found_.push_back(std::move(text));
}

void Journal::append(const std::string& text, const std::string& lines) {
  const JournalPlace next = place_.after(lines);
  const std::string more = "; update " + std::to_string(next.updates) +
                           " is not in the journal, the " + std::to_string(place_.updates) +
                           " before it are";
  if (broken_) throw failed(ErrorCode::cannot_write, path_, EIO, more);
  if (text.size() > kLongest) throw failed(ErrorCode::cannot_write, path_, EFBIG, more);
  const std::string record = record_of(records_, text);
  if (const int error = write_all(file_.get(), record, sync_)) {
    std::clearerr(file_.get());
    broken_ = platform::shorten(file_.get(), path_, bytes_) != 0;
    throw failed(ErrorCode::cannot_write, path_, error, more);
  }
  bytes_ += record.size();
  ++records_;
  place_ = next;
}

void Journal::replace(const std::string& text) {
  std::error_code ignored;
  const fs::path resolved = fs::canonical(path_, ignored);  // a link stays a link
  const std::string target = ignored ? path_ : resolved.string(), beside = target + ".new";
  fs::remove(beside, ignored);
  errno = 0;
  File file(platform::open_to_append(beside));
  if (!file) throw failed(ErrorCode::cannot_write, beside, errno);
  const std::string content = beginning() + record_of(1, folded_line(place_) + text);
  int error = platform::lock(file.get()) ? write_all(file.get(), content, true) : EACCES;
  if (error == 0) {
    std::error_code renamed;
    fs::rename(beside, target, renamed);
    error = renamed.value();
  }
  if (error != 0) {
    fs::remove(beside, ignored);
    throw failed(ErrorCode::cannot_write, beside, error);
  }
  platform::sync_folder_of(target);
  file_ = std::move(file);
  bytes_ = bytes_replaced_ = content.size();
  records_ = 2;
  broken_ = false;
}

std::string Journal::script() const {
  const std::string content = all_of_journal(path_);
  std::string all;
  std::uint64_t number = 0;
  for (std::size_t at = kFirstLine.size(); at < bytes_; ++number) {
    const Found found = record_at(content, at);
    if (found.what != Found::What::record) throw damaged(path_, at, "a record is not whole");
    if (number > 0) all += found.text;
    at += kHead + found.text.size();
  }
  return all;
}

}  // namespace tool
