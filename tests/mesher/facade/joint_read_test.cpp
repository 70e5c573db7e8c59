// Files that several processes read, here threads: what they have together, and what is wrong, is
// what one process finds, wherever the file is cut.
#include "facade/joint_read.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "random.hpp"
#include "scratch_file.hpp"
#include "thread_peers.hpp"

namespace {

using mesher::GraphFile;
using mesher::detail::Peers;

// What reading says: points and where they stand, or an error.
struct Said {
  std::vector<std::string> points;
  std::vector<std::string> notes;
  std::string error;
  friend bool operator==(const Said&, const Said&) = default;
};

template <int D>
void add(const GraphFile<D>& file, Said& said) {
  REQUIRE(file.points.size() == file.graph.points.size());
  for (std::size_t i = 0; i < file.points.size(); ++i) {
    const auto& p = file.graph.points[i];
    std::string text = std::to_string(static_cast<std::int64_t>(p.id));
    for (const double x : p.at) text += " " + std::to_string(x);
    text += " m" + std::to_string(p.marker) + " @" + std::to_string(file.points[i].line) + ":" +
            std::to_string(file.points[i].column);
    said.points.push_back(text);
  }
  for (const auto& note : file.notes) said.notes.push_back(note.text + text_of(note.location));
}

std::string text_of_error(const mesher::Error& error) {
  std::string text = error.what();
  text += " @" + text_of(error.location()) + ":" + std::to_string(error.location().column);
  for (const auto& feature : error.features()) text += " " + text_of(feature);
  for (const auto& at : error.locations()) text += " " + text_of(at);
  return text;
}

template <int D>
Said read_alone(const std::string& path, const mesher::ReadOptions& how) {
  Said said;
  try {
    add(mesher::read<D>(path, how), said);
  } catch (const mesher::Error& error) {
    said.error = text_of_error(error);
  }
  return said;
}

template <int D>
Said read_together(const std::string& path, const mesher::ReadOptions& how, std::size_t processes) {
  std::vector<GraphFile<D>> parts(processes);
  std::vector<std::string> errors(processes);
  support::in_processes(processes, [&](std::unique_ptr<Peers> peers, std::size_t self) {
    try {
      parts[self] = mesher::detail::joint_read<D>(path, how, *peers);
    } catch (const mesher::Error& error) {
      errors[self] = text_of_error(error);
    }
  });
  Said said;
  said.error = errors[0];
  for (const std::string& error : errors) REQUIRE(error == said.error);
  if (!said.error.empty()) return said;
  for (const auto& part : parts) add(part, said);
  return said;
}

// Or what is wrong.
template <class Find>
std::string dimension(const Find& find) {
  try {
    return std::to_string(find());
  } catch (const mesher::Error& error) {
    return text_of_error(error);
  }
}

std::string dimension_together(const std::string& path, std::size_t processes) {
  std::vector<std::string> all(processes);
  support::in_processes(processes, [&](std::unique_ptr<Peers> peers, std::size_t self) {
    all[self] = dimension([&] { return mesher::detail::joint_dimension(path, *peers); });
  });
  for (const std::string& one : all) REQUIRE(one == all[0]);
  return all[0];
}

void check(const std::string& path, const mesher::ReadOptions& how = {}) {
  for (std::size_t processes = 1; processes <= 7; ++processes) {
    CAPTURE(processes, path);
    const std::string alone = dimension([&] { return mesher::dimension_of(path); });
    REQUIRE(dimension_together(path, processes) == alone);
    REQUIRE(read_together<2>(path, how, processes) == read_alone<2>(path, how));
    REQUIRE(read_together<3>(path, how, processes) == read_alone<3>(path, how));
  }
}

// Files of points, good and bad, with what may stand between rows.
class RandomFile {
 public:
  RandomFile(const std::string& format, std::uint64_t seed) : format_(format), random_(seed) {}

  std::string text() {
    end_ = chance(4) ? "\r\n" : "\n";
    std::string text = chance(8) ? "\xEF\xBB\xBF" : "";
    const int rows = random_(chance(4) ? 40 : 9);
    in_space_ = chance(2);
    markers_ = chance(2);
    add_filler(text);
    if (format_ == ".node" && !chance(30)) {
      const int said = chance(6) ? std::max(0, rows + random_(5) - 2) : rows;
      text += std::to_string(said) + (in_space_ ? " 3" : " 2") + " 0" + (markers_ ? " 1" : " 0");
      text += end_;
    } else if (format_ == ".csv" && chance(2)) {
      text += chance(9) ? "x,x,y" : in_space_ ? "z,x,name,y" : "name,y,x";
      text += end_, named_ = true;
    }
    for (int i = 0; i < rows; ++i) {
      add_filler(text);
      text += row(i);
      if (i + 1 < rows || !chance(3)) text += end_;
    }
    add_filler(text);
    return text;
  }

 private:
  bool chance(int of) { return random_(of) == 0; }

  void add_filler(std::string& text) {
    while (chance(4)) {
      const std::string more[] = {"", "# 1 2 3", "   ", "#", "  # \xEF\xBB\xBF 7"};
      text += more[random_(5)] + end_;
    }
  }

  std::string number() {
    if (chance(90)) return chance(2) ? "x" : "1e400";
    return std::to_string(random_(chance(6) ? 3 : 1000)) + ".25";
  }

  std::string row(int i) {
    const std::string blank = format_ == ".csv" ? "," : chance(3) ? "\t " : " ";
    const std::string x = number(), y = number();
    std::string z = chance(2) ? "0" : number();
    if (format_ == ".csv") {
      if (named_) {
        return in_space_ ? z + blank + x + blank + "a b" + blank + y
                         : "\"n\"" + blank + y + blank + x;
      }
      return x + blank + y + (in_space_ ? blank + z : chance(60) ? blank : "");
    }
    if (format_ == ".xyz") return x + (chance(60) ? "" : blank + y) + (in_space_ ? blank + z : "");
    const int id = chance(40) ? random_(9) : descending_ ? 100 - i : i + 1;
    std::string text = std::to_string(id) + blank + x + blank + y;
    if (in_space_) text += blank + z;
    if (markers_) text += blank + std::to_string(random_(4));
    if (chance(60)) text += blank + "9";
    if (chance(60)) text.resize(text.size() / 2);
    return text;
  }

  std::string format_, end_;
  support::Random random_;
  bool in_space_ = false, markers_ = false, named_ = false;
  bool descending_ = chance(3);
};

}  // namespace

TEST_CASE("several processes read what one reads, and find what it finds wrong") {
  const support::ScratchFolder folder;
  int good = 0, bad = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    for (const std::string format : {".node", ".xyz", ".csv"}) {
      const std::string path = folder.write("a" + format, RandomFile(format, seed).text());
      CAPTURE(seed);
      const mesher::ReadOptions how{.coinciding = seed % 3 == 0
                                                      ? mesher::CoincidingPoints::kept
                                                      : mesher::CoincidingPoints::refused};
      check(path, how);
      ++(read_alone<2>(path, how).error.empty() || read_alone<3>(path, how).error.empty() ? good
                                                                                          : bad);
    }
  }
  CHECK(good > 40);
  CHECK(bad > 40);
}

TEST_CASE("shares that are cut in one line, or hold none") {
  const support::ScratchFolder folder;
  check(folder.write("empty.node", ""));
  check(folder.write("blank.node", "\n\n  \n# nothing\n"));
  check(folder.write("none.node", "0 2 0 0\n"));
  check(folder.write("none.csv", "x,y\n"));
  check(folder.write("blank.csv", "\n#\n"));
  check(folder.write("blank.xyz", ""));
  check(folder.write("one.xyz", "1 2"));
  check(folder.write(
      "long.xyz", "1 2\n" + std::string(3000, ' ') + "3 4 # " + std::string(3000, 'c') + "\n5 6"));
  check(folder.write("head.node", "#" + std::string(5000, 'c') + "\n1 2\n7 0.5 0.25"));
  check(folder.write("comment.node", "#" + std::string(5000, 'c')));
  check(folder.write("mark.xyz",
                     "1 2\n\xEF\xBB\xBF"
                     "3 4\n5 6\n"));
  check(folder.write("inner_mark.xyz", "1 2\n3\n\xEF\xBB\xBF\n"));
  check(folder.write("onto.csv", "1,2\n3,4\n5,6\n3,4\n"));
  check(folder.write("inner_mark.csv", "1,2\n3\n\xEF\xBB\xBF\n"));
  check(folder.write("ends.node", "5 2 0 0\n1 0 0\n2 1 1\n# more\n\n  \n# and more\n"));
  check(folder.write("long_head.csv", "#" + std::string(200000, 'c') + "\nx,y\n1,2\n3,4\n"));
#ifdef __linux__
  // A file that says that it has no bytes.
  std::filesystem::create_symlink("/proc/sys/kernel/pid_max", folder.path("one_number.xyz"));
  std::filesystem::create_symlink("/proc/sys/net/ipv4/ip_local_port_range",
                                  folder.path("proc.xyz"));
  check(folder.path("one_number.xyz"));
  check(folder.path("proc.xyz"));
#endif
  std::filesystem::create_symlink(folder.path("loop.node"), folder.path("loop.node"));
  check(folder.path("loop.node"));
  check(folder.path(std::string(5000, 'n') + ".node"));
  check(folder.path("missing.node"));
  check(folder.path("missing.xyz"));
  check(folder.write("a.poly", "3 2\n1 0 0\n2 1 0\n3 0 1\n1\n1 1 2\n0\n"));
}

TEST_CASE("an error names the line of a feature that any of the processes has read") {
  const support::ScratchFolder folder;
  const std::string path = folder.write("a.node", "3\n1 0 0\n\n2 1 0\n3 0 1\n");
  const mesher::Error error(
      mesher::ErrorCode::too_close, "too close", {},
      {mesher::Feature(mesher::PointId{3}), mesher::Feature(mesher::PointId{8}),
       mesher::Feature(mesher::PointId{2})});
  const std::string expected = text_of_error(located(error, mesher::read<2>(path)));
  CHECK(expected.find("a.node:5") != std::string::npos);
  CHECK(expected.find("a.node:4") != std::string::npos);
  support::in_processes(3, [&](std::unique_ptr<Peers> peers, std::size_t) {
    const auto share = mesher::detail::joint_read<2>(path, {}, *peers);
    const auto found = mesher::detail::joint_located(error, share, *peers);
    if (text_of_error(found) != expected) throw std::runtime_error(text_of_error(found));
  });
}
