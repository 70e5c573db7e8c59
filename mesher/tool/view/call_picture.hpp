// Which calls of the engine an update ran, as a picture of the package traces.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "mesher/error.hpp"
#include "scratch_folder.hpp"
#include "traces/recorder.hpp"
#include "traces/render.hpp"
#include "traces/trace_file.hpp"

namespace tool::view {

/// The traces before and after an update, and a picture of what they differ in.
class CallPicture {
 public:
  static constexpr std::uint64_t kMostCalls = 4000000;  // a recording takes a second for 10^6

  /// Throws: Error (too_many, cannot_write).
  explicit CallPicture(const sac::Engine& engine, std::uint64_t calls) {
    require_few(calls);
    record(engine, "before.trace");
  }

  /// After an update. Throws: likewise.
  void follow(const sac::Engine& engine, std::uint64_t calls) {
    require_few(calls);
    record(engine, "after.trace");
    picture_ = traces::render_difference(path("before.trace"), path("after.trace"));
    std::filesystem::rename(path("after.trace"), path("before.trace"));
  }
  [[nodiscard]] const std::string& picture() const { return picture_; }

 private:
  static void require_few(std::uint64_t calls) {
    if (calls <= kMostCalls) return;
    throw mesher::Error(mesher::ErrorCode::too_many,
                        "the trace has " + std::to_string(calls) + " calls; above " +
                            std::to_string(kMostCalls) + " they are not drawn");
  }
  [[nodiscard]] std::string path(const char* name) const {
    return (folder_.path() / name).string();
  }
  void record(const sac::Engine& engine, const char* name) {
    try {
      static_cast<void>(traces::Recorder(engine).record(path(name)));
    } catch (const traces::FileError& error) {
      throw mesher::Error(mesher::ErrorCode::cannot_write, error.what());
    }
  }

  ScratchFolder folder_;
  std::string picture_;
};

}  // namespace tool::view
