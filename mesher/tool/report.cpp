// Figures for programs and for people.
#include "report.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tool {
namespace {

std::uint64_t peak_rss_bytes() {
  constexpr std::uint64_t kBytesPerUnit = 1024;  // Linux counts in kB
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * kBytesPerUnit;
}

// The value below which a share of the sorted values lies. Requires: values not empty.
double quantile(const std::vector<double>& sorted, double share) {
  const auto at = static_cast<std::size_t>(share * static_cast<double>(sorted.size()));
  return sorted[std::min(at, sorted.size() - 1)];
}

void print_row(const char* name, const std::string& value) {
  std::printf("  %-22s%s\n", name, value.c_str());
}

std::string format(const char* form, double value) {
  if (std::isnan(value)) return "-";
  char text[64];
  std::snprintf(text, sizeof text, form, value);
  return text;
}

std::string milliseconds(double seconds) { return format("%.3f ms", seconds * 1000); }

}  // namespace

Json json_of(const Run& run) {
  Json json;
  json["vertices"] = run.stats.vertices;
  json["simplices"] = run.stats.simplices;
  json["min_angle_deg"] = run.quality.min_angle_deg;  // NaN is written as null
  json["max_radius_edge"] = run.quality.max_radius_edge;
  json["seconds"] = {{"quadtree", run.stats.seconds_quadtree},
                     {"steiner", run.stats.seconds_steiner},
                     {"triangulate", run.stats.seconds_triangulate},
                     {"total", run.seconds_total}};
  json["calls"] = run.stats.calls;
  json["edges"] = run.stats.edges;
  json["trace_bytes"] = run.stats.trace_bytes;
  json["peak_rss_bytes"] = peak_rss_bytes();
  return json;
}

Json json_of(const mesher::Update<2>& update) {
  const mesher::Change<2>& change = update.change;
  Json json;
  json["edit"] = update.text();
  json["seconds"] = update.seconds;
  json["calls"] = {{"executed", change.calls.executed},
                   {"reused", change.calls.reused},
                   {"created", change.calls.created},
                   {"discarded", change.calls.discarded}};
  json["vertices"] = {{"added", change.vertices_added.size()},
                      {"removed", change.vertices_removed.size()}};
  json["simplices"] = {{"added", change.simplices_added.size()},
                       {"removed", change.simplices_removed.size()}};
  return json;
}

void print_run(const std::string& input, std::size_t points, const Run& run) {
  std::printf("%s: %zu points\n", input.c_str(), points);
  print_row("vertices", std::to_string(run.stats.vertices));
  print_row("triangles", std::to_string(run.stats.simplices));
  print_row("smallest angle", format("%.2f degrees", run.quality.min_angle_deg));
  print_row("largest radius-edge", format("%.4f", run.quality.max_radius_edge));
  print_row("time", format("%.3f s", run.seconds_total));
}

void print_updates(std::vector<double> seconds) {
  print_row("updates", std::to_string(seconds.size()));
  if (seconds.empty()) return;
  std::sort(seconds.begin(), seconds.end());
  print_row("  median", milliseconds(quantile(seconds, 0.5)));
  print_row("  99 of 100 below", milliseconds(quantile(seconds, 0.99)));
  print_row("  longest", milliseconds(seconds.back()));
}

void print_outputs(const std::vector<std::string>& paths) {
  std::string all;
  for (const auto& path : paths) all += (all.empty() ? "" : ", ") + path;
  if (!all.empty()) print_row("written", all);
}

}  // namespace tool
