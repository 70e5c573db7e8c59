// A folder for files that are made to be sent.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "archive.hpp"
#include "mesher/error.hpp"

namespace tool::view {

/// A folder that goes when this does. Throws: Error(cannot_write).
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "mesher-view-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw mesher::Error(mesher::ErrorCode::cannot_write,
                          "no folder for a file to save can be made", {name});
    }
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Its files, by name.
inline std::vector<ArchivedFile> files_in(const std::filesystem::path& folder) {
  std::vector<ArchivedFile> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    std::ostringstream content;
    content << file.rdbuf();
    files.push_back({entry.path().filename().string(), content.str()});
  }
  std::sort(files.begin(), files.end(),
            [](const ArchivedFile& a, const ArchivedFile& b) { return a.name < b.name; });
  return files;
}

}  // namespace tool::view
