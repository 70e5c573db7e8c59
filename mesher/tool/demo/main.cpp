// mesher_demo LAKES POINTS FOLDER: meshes real lakes and points, edits them, and shows what
// following edits costs beside meshing anew.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "demo.hpp"
#include "mesher/error.hpp"
#include "mesher/extra/edit_script.hpp"

namespace demo {

double seconds_of(const std::function<void()>& run) {
  std::vector<double> seconds;
  for (int i = 0; i < 5; ++i) {
    const double start = mesher::now();
    run();
    seconds.push_back(mesher::now() - start);
  }
  std::sort(seconds.begin(), seconds.end());
  return seconds[2];
}

void print_seconds(double scratch, std::vector<double> updates) {
  std::sort(updates.begin(), updates.end());
  const double median = updates[updates.size() / 2], p99 = updates[updates.size() * 99 / 100];
  std::printf("  from scratch              %10.3f ms\n", scratch * 1e3);
  std::printf("  update, median            %10.3f ms  (%zu updates)\n", median * 1e3,
              updates.size());
  std::printf("  update, 99 of 100 below   %10.3f ms\n", p99 * 1e3);
  std::printf("  speed-up, median          %10.1f times\n", scratch / median);
}

namespace {

void run(const std::string& lakes, const std::string& cities, const std::string& folder) {
  std::filesystem::create_directories(folder);
  mesher::OutputFiles files;
  show_lakes(lakes, folder, files);
  show_cities(cities, folder, files);
  std::printf("Written; coloured orange, the triangles that an update has replaced or made:\n");
  for (const auto& path : files.targets()) std::printf("  %s\n", path.c_str());
  files.commit();
}

}  // namespace
}  // namespace demo

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: mesher_demo LAKES POINTS FOLDER\n");
    return static_cast<int>(mesher::ExitCode::usage);
  }
  try {
    demo::run(argv[1], argv[2], argv[3]);
    return 0;
  } catch (const mesher::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(mesher::exit_code(error.code()));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error[bug]: %s\n", error.what());
    return static_cast<int>(mesher::ExitCode::bug);
  }
}
