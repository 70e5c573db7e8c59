// Output files that appear whole or not at all: temporaries, then renames.
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <system_error>
#include <utility>

#include "mesher/write.hpp"
#include "platform/files.hpp"
#include "text/digits.hpp"

namespace mesher {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBufferBytes = 1 << 16;
// A long long has 20 characters at the most, the shortest form of a double 24.
constexpr std::size_t kMostDigits = 32;

Error cannot_write(const std::string& path, const std::error_code& error) {
  return {ErrorCode::cannot_write, "cannot be written: " + error.message(), {path}};
}
Error cannot_write(const std::string& path, int error) {
  return cannot_write(path, std::error_code(error, std::generic_category()));
}

Error not_a_file(const std::string& path) {
  return {ErrorCode::cannot_write, "cannot be written: not a regular file", {path}};
}

// Names in the directory of `target`, one after the other.
class Names {
 public:
  Names(const std::string& target, std::string ending)
      : stem_((fs::path(target).parent_path() /
               (".mesher-" + std::to_string(platform::process_number()) + "-"))
                  .string()),
        ending_(std::move(ending)) {}
  std::string next() { return stem_ + std::to_string(number_++) + ending_; }

 private:
  std::string stem_, ending_;
  int number_ = 0;
};

// A name in the directory of `target` that nobody has, created at once so that nobody takes it and
// so that a directory one may not write to is found before the work begins.
std::string create_temporary(const std::string& target, const std::string& shown_as) {
  for (Names names(target, ".part");;) {
    const std::string path = names.next();
    const std::error_code error = platform::create(path);
    if (!error) return path;
    if (error != std::errc::file_exists) throw cannot_write(shown_as, error);
  }
}

// The file a target stands for: behind symbolic links, so that a link stays a link.
std::string resolve(const std::string& target) {
  std::error_code error;
  const auto path = fs::weakly_canonical(fs::absolute(target, error), error);
  if (error) throw cannot_write(target, error);
  if (fs::is_directory(path, error)) throw cannot_write(target, EISDIR);
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) {
    throw not_a_file(target);
  }
  if (fs::exists(path, error)) {
    if (const auto forbidden = platform::why_not_writable(path.string())) {
      throw cannot_write(target, forbidden);
    }
  }
  return path.string();
}

}  // namespace

TextFile::TextFile(const std::string& path, std::string shown_as)
    : shown_as_(std::move(shown_as)), file_(platform::open_to_write(path)) {
  if (!file_) fail();
  std::setvbuf(file_, nullptr, _IONBF, 0);  // buffer_ is the buffer
  buffer_.resize(kBufferBytes);
}

TextFile::~TextFile() {
  if (file_) std::fclose(file_);
}

void TextFile::fail() { throw cannot_write(shown_as_, errno); }

void TextFile::flush() {
  if (std::fwrite(buffer_.data(), 1, used_, file_) != used_) fail();
  used_ = 0;
}

TextFile& TextFile::operator<<(std::string_view text) {
  while (text.size() > buffer_.size() - used_) {
    const std::size_t fits = buffer_.size() - used_;
    std::copy_n(text.data(), fits, buffer_.data() + used_);
    used_ += fits;
    text.remove_prefix(fits);
    flush();
  }
  std::copy_n(text.data(), text.size(), buffer_.data() + used_);
  used_ += text.size();
  return *this;
}

TextFile& TextFile::operator<<(double value) {
  add_up_to(kMostDigits, [&](char* at) { return std::to_chars(at, at + kMostDigits, value).ptr; });
  return *this;
}

TextFile& TextFile::add_integer(long long value) {
  add_up_to(kMostDigits, [&](char* at) {
    if (value >= 0 && value <= UINT32_MAX)
      return detail::put_number(at, static_cast<std::uint32_t>(value));
    return std::to_chars(at, at + kMostDigits, value).ptr;
  });
  return *this;
}

void TextFile::close() {
  if (!file_) return;
  flush();
  std::FILE* const file = std::exchange(file_, nullptr);
  if (std::fclose(file) != 0) fail();
}

OutputFiles::~OutputFiles() {
  for (const auto& path : temporaries()) platform::remove(path);
}

void OutputFiles::require_free(const Entry& entry) const {
  for (const auto& other : entries_) {
    if (other.resolved != entry.resolved) continue;
    throw Error(ErrorCode::bad_option, "is written twice: name each output once", {entry.target});
  }
  std::error_code error;
  for (const auto& path : protected_) {
    if (fs::weakly_canonical(fs::absolute(path, error), error).string() != entry.resolved) continue;
    throw Error(ErrorCode::bad_option, "is an input: write the output elsewhere", {entry.target});
  }
}

TextFile& OutputFiles::open(const std::string& target) {
  Entry entry{target, resolve(target), {}, {}, nullptr};
  require_free(entry);
  entries_.reserve(entries_.size() + 1);  // nothing may throw once there is a temporary
  entry.temporary = create_temporary(entry.resolved, target);
  try {
    entry.file = std::make_unique<TextFile>(entry.temporary, target);
  } catch (...) {
    platform::remove(entry.temporary);
    throw;
  }
  entries_.push_back(std::move(entry));
  return *entries_.back().file;
}

// Gives what has the target's name another one: a second one where the file system has links, so
// that the target is there all the time.
void OutputFiles::keep(Entry& entry) {
  std::error_code error;
  const auto there = fs::symlink_status(entry.resolved, error);
  if (!fs::exists(there)) return;  // if it is there, renaming tells
  if (!fs::is_regular_file(there)) throw not_a_file(entry.target);
  for (Names names(entry.resolved, ".kept");;) {
    std::string name = names.next();
    fs::create_hard_link(entry.resolved, name, error);
    if (error) {
      if (error == std::errc::file_exists) continue;
      if (fs::exists(fs::symlink_status(name, error))) continue;
      if (const auto failure = platform::rename(entry.resolved, name)) {
        throw cannot_write(entry.target, failure);
      }
    }
    entry.kept = std::move(name);
    return;
  }
}

void OutputFiles::replace(Entry& entry) {
  keep(entry);
  const std::error_code error = platform::rename(entry.temporary, entry.resolved);
  if (!error) return;
  if (!entry.kept.empty()) restore(entry);
  throw cannot_write(entry.target, error);
}

// Renaming one name of a file to another of it does nothing: the name that is left over goes.
void OutputFiles::restore(Entry& entry) noexcept {
  if (entry.kept.empty()) {
    platform::remove(entry.resolved);
  } else if (!platform::rename(entry.kept, entry.resolved)) {
    platform::remove(entry.kept);
  }
}

void OutputFiles::commit() {
  for (auto& entry : entries_) entry.file->close();
  std::size_t done = 0;
  try {
    for (; done < entries_.size(); ++done) replace(entries_[done]);
  } catch (...) {
    while (done-- > 0) restore(entries_[done]);
    throw;
  }
  for (const auto& entry : entries_) {
    if (!entry.kept.empty()) platform::remove(entry.kept);
  }
  entries_.clear();
}

std::vector<std::string> OutputFiles::temporaries() const {
  std::vector<std::string> paths;
  for (const auto& entry : entries_) paths.push_back(entry.temporary);
  return paths;
}

std::vector<std::string> OutputFiles::targets() const {
  std::vector<std::string> paths;
  for (const auto& entry : entries_) paths.push_back(entry.target);
  return paths;
}

}  // namespace mesher
