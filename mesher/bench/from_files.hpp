// `mesher mesh` of points in space from file to file, and TetGen beside it, each a process.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sample.hpp"
#include "tetgen.hpp"

namespace bench {

/// What a process took.
struct Process {
  double seconds = 0;  // of the processor, its own and the system's
  double megabytes = 0;
  std::size_t vertices = 0;
  double user_seconds = 0;  // its own alone
};

/// Runs a command, silently. Nothing if it does not end well; `most_seconds`, of the processor, and
/// `most_gigabytes` are limits.
inline std::optional<Process> run_process(const std::vector<std::string>& command,
                                          rlim_t most_seconds, rlim_t most_gigabytes) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    const rlimit seconds{most_seconds, most_seconds};
    const rlimit bytes{most_gigabytes << 30, most_gigabytes << 30};
    setrlimit(RLIMIT_CPU, &seconds);
    setrlimit(RLIMIT_AS, &bytes);
    const int nothing = open("/dev/null", O_WRONLY);
    dup2(nothing, 1), dup2(nothing, 2);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  int status = 0;
  rusage used{};
  wait4(child, &status, 0, &used);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return std::nullopt;
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return Process{seconds(used.ru_utime) + seconds(used.ru_stime),
                 static_cast<double>(used.ru_maxrss) / 1024, 0, seconds(used.ru_utime)};
}

/// The path of mesher, which is in the benchmark's folder.
[[nodiscard]] inline std::string tool_beside(const char* benchmark) {
  return std::filesystem::path(benchmark).replace_filename("mesher").string();
}

/// Both read the points and write vertices, tetrahedra and faces of the border. TetGen's options
/// are -pq2.0O0/0: with others it leaves tetrahedra above its own bound; it gets the box, six times
/// as wide, in its file.
class FromFiles {
 public:
  static constexpr rlim_t kMostSeconds = 120, kMostGigabytes = 12;

  struct Result {
    std::size_t n = 0;
    std::optional<Process> ours, tetgen;  // medians; nothing: beyond the limits, or not run
  };

  /// `tool`: mesher's path.
  FromFiles(std::string tool, std::string algorithm)
      : tool_(std::move(tool)), algorithm_(std::move(algorithm)) {}

  [[nodiscard]] const std::string& algorithm() const { return algorithm_; }
  [[nodiscard]] Result run(const std::vector<Point<3>>& points, bool with_tetgen,
                           int rounds) const {
    const TemporaryFolder folder;
    const std::string node = folder.file("points.node"), boxed = folder.file("boxed.poly"),
                      meshed = folder.file("meshed.node"), theirs = folder.file("boxed.1.node");
    mesher::OutputFiles files;
    mesher::write_points<3>(points, files.open(node));
    files.commit();
    if (with_tetgen) write_boxed(points, boxed);
    std::vector<Process> of_ours, of_tetgen;
    for (int round = 0; round < rounds; ++round) {
      add(of_ours, {tool_, "mesh", node, "--algorithm", algorithm_, "-o", meshed}, meshed);
      if (!with_tetgen) continue;
      with_tetgen = add(of_tetgen, {"tetgen", "-pq2.0O0/0", boxed}, theirs);
    }
    return {points.size(), median(of_ours), median(of_tetgen)};
  }

 private:
  // Whether it ended well.
  static bool add(std::vector<Process>& all, const std::vector<std::string>& command,
                  const std::string& node_file) {
    auto done = run_process(command, kMostSeconds, kMostGigabytes);
    if (!done) return false;
    std::ifstream(node_file) >> done->vertices;
    all.push_back(*done);
    return true;
  }
  static std::optional<Process> median(std::vector<Process> all) {
    if (all.empty()) return std::nullopt;
    std::sort(all.begin(), all.end(),
              [](const Process& a, const Process& b) { return a.seconds < b.seconds; });
    return all[(all.size() - 1) / 2];
  }

  std::string tool_, algorithm_;
};

/// A JSON line, from "bench" on; time_ratio: TetGen's seconds over ours.
inline void print(const char* name, const std::string& more, const std::string& algorithm,
                  const FromFiles::Result& result) {
  std::printf("{\"bench\":\"%s\",%s,\"n\":%zu,\"algorithm\":\"%s\"", name, more.c_str(), result.n,
              algorithm.c_str());
  const auto& [n, ours, tetgen] = result;
  if (ours) {
    std::printf(",\"vertices\":%zu,\"seconds\":%.3f,\"megabytes\":%.0f", ours->vertices,
                ours->seconds, ours->megabytes);
  }
  if (tetgen) {
    std::printf(",\"tetgen_vertices\":%zu,\"tetgen_seconds\":%.3f,\"tetgen_megabytes\":%.0f",
                tetgen->vertices, tetgen->seconds, tetgen->megabytes);
  }
  if (ours && tetgen) {
    std::printf(",\"time_ratio\":%.2f,\"vertex_ratio\":%.3f", tetgen->seconds / ours->seconds,
                static_cast<double>(ours->vertices) / static_cast<double>(tetgen->vertices));
  }
  std::printf("}\n");
  std::fflush(stdout);
}

}  // namespace bench
