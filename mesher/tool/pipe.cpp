// Copies of what comes through pipes.
#include "pipe.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <utility>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"

namespace tool {
namespace {

namespace fs = std::filesystem;
using mesher::Error;
using mesher::ErrorCode;

// Folders with the names of those whose files they stand for. Removed when the process ends.
struct Copies {
  struct Copy {
    std::string folder;  // with a '/' at its end
    std::string path, own_path;
  };
  std::vector<Copy> all;

  ~Copies() { drop(); }
  void drop() noexcept {
    for (const Copy& copy : all) {
      std::error_code ignored;
      fs::remove_all(copy.folder, ignored);
    }
  }
};
Copies& copies() {
  static Copies of_this_process;
  return of_this_process;
}

Error cannot_read(const std::string& path) {
  return {ErrorCode::cannot_read, std::string("cannot be read: ") + std::strerror(errno), {path}};
}

std::string all_of(const std::string& path) {
  errno = 0;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) throw cannot_read(path);
  std::string content;
  std::vector<char> part(1 << 16);
  while (const auto n = std::fread(part.data(), 1, part.size(), file.get())) {
    content.append(part.data(), n);
  }
  if (std::ferror(file.get())) throw cannot_read(path);
  return content;
}

std::string new_folder(const std::string& path) {
  std::error_code failed;
  std::string folder = (fs::temp_directory_path(failed) / "mesher-XXXXXX").string();
  errno = 0;
  if (::mkdtemp(folder.data()) == nullptr) throw cannot_read(path);
  return folder + "/";
}

void write(const std::string& content, const std::string& at, const std::string& own_path) {
  std::ofstream file(at, std::ios::binary);
  file << content;
  if (!file.flush()) throw cannot_read(own_path);
}

// A .node beside a .poly, and the like.
void link_companions(const fs::path& own_path, const std::string& folder) {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(fs::absolute(own_path).parent_path(), none)) {
    const fs::path& beside = entry.path();
    if (beside.stem() != own_path.stem() || beside.filename() == own_path.filename()) continue;
    if (!entry.is_regular_file(none)) continue;
    fs::create_symlink(beside, folder / beside.filename(), none);
  }
}

}  // namespace

std::string readable(const std::string& path, const std::string& format) {
  std::error_code failed;
  const auto status = fs::status(path, failed);
  if (failed || !fs::exists(status) || fs::is_directory(status)) return path;
  const bool is_file = fs::is_regular_file(status);
  const std::string own = mesher::format_of(path);
  const std::string extension =
      format.empty() ? own : mesher::format_of(format[0] == '.' ? "x" + format : "x." + format);
  if (is_file && extension == own) return path;
  if (extension.empty()) {
    throw Error(ErrorCode::unknown_format, "a pipe has no extension: give its format by --format",
                {path});
  }
  const std::string content = is_file ? "" : all_of(path);
  const std::string folder = new_folder(path);
  const std::string at = folder + fs::path(path).stem().string() + extension;
  copies().all.push_back({folder, at, path});
  link_companions(path, folder);
  fs::remove(at, failed);  // of a companion
  if (is_file) {
    fs::create_symlink(fs::absolute(path), at, failed);
  } else {
    write(content, at, path);
  }
  return at;
}

std::string with_own_paths(std::string text) {
  const auto replace = [&](const std::string& is, const std::string& by) {
    for (std::size_t at = text.find(is); at != std::string::npos; at = text.find(is, at)) {
      text.replace(at, is.size(), by);
      at += by.size();
    }
  };
  for (const Copies::Copy& copy : copies().all) {
    replace(copy.path, copy.own_path);
    const std::string beside = fs::path(copy.own_path).parent_path().string();
    replace(copy.folder, beside.empty() ? "" : beside + "/");
  }
  return text;
}

void drop_copies() noexcept { copies().drop(); }

}  // namespace tool
