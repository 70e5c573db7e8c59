// The line of progress.
#include "progress.hpp"

#include <cstdio>

#include "mesher/extra/edit_script.hpp"
#include "platform/process.hpp"

namespace tool {
namespace {

constexpr double kPatience = 2;     // seconds before the first line
constexpr double kInterval = 0.25;  // and between lines

const char* name(mesher::Phase phase, int dimension) {
  switch (phase) {
    case mesher::Phase::quadtree:
      return dimension == 2 ? "quadtree (1 of 3)" : "octree (1 of 3)";
    case mesher::Phase::steiner:
      return "Steiner points (2 of 3)";
    case mesher::Phase::triangulate:
      return dimension == 2 ? "triangles (3 of 3)" : "tetrahedra (3 of 3)";
    case mesher::Phase::update:
      return "update";
  }
  return "";
}

std::string text(const mesher::Progress& p, int dimension) {
  const std::string what = name(p.phase, dimension);
  if (p.of == 0) return what + ": " + std::to_string(p.done) + " calls";
  if (p.phase == mesher::Phase::update) {
    return what + ": " + std::to_string(p.done) + " of " + std::to_string(p.of) + " calls";
  }
  return what + ": " + std::to_string(100 * p.done / p.of) + "%";
}

}  // namespace

Progress::Progress(bool quiet, int dimension)
    : enabled_(!quiet && platform::shows_errors_to_people()),
      dimension_(dimension),
      next_(mesher::now() + kPatience) {}

mesher::RunControl Progress::control() {
  return {.progress =
              [this](const mesher::Progress& progress) {
                tick(progress);
                return (meanwhile_ == nullptr || meanwhile_(progress)) && !interrupted();
              },
          .stop = {}};
}

void Progress::tick(const mesher::Progress& progress) {
  if (!enabled_ || mesher::now() < next_) return;
  std::fprintf(stderr, "\r\033[K%s%s", task_.c_str(), text(progress, dimension_).c_str());
  shown_ = true;
  next_ = mesher::now() + kInterval;
}

void Progress::erase() {
  if (shown_) std::fputs("\r\033[K", stderr);
  shown_ = false;
}

}  // namespace tool
