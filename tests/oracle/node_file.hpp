// Reading .node and .ele files for the judges: on purpose none of the mesher's own code.
//
// Comments run from '#' to the end of the line; records are read by lines. A coordinate is what
// std::from_chars makes of its whole token, so it is the double that was meant, bit for bit.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace oracle {

struct Site {
  double x = 0;
  double y = 0;
};

/// What has an id: ids as written, in the order of the file.
template <class Item>
struct Numbered {
  std::vector<long> ids;
  std::vector<Item> items;
};

/// A .node file in the plane.
struct NodeFile {
  std::vector<long> ids;
  std::vector<Site> sites;
};

/// A .ele file: corners are positions in the .node file, not ids.
template <std::size_t N>
using EleFile = Numbered<std::array<std::size_t, N>>;

/// The lines of a file that hold something, as tokens.
class TokenLines {
 public:
  explicit TokenLines(const std::string& path) : path_(path), in_(path) {
    if (!in_) throw std::runtime_error(path + ": cannot open");
  }

  /// Requires `least` tokens; throws when the file ends.
  std::vector<std::string> next(std::size_t least) {
    for (std::string line; std::getline(in_, line);) {
      ++number_;
      std::istringstream words(line.substr(0, line.find('#')));
      std::vector<std::string> tokens;
      for (std::string word; words >> word;) tokens.push_back(word);
      if (tokens.empty()) continue;
      if (tokens.size() < least) fail("too few values");
      return tokens;
    }
    fail("file ends too early");
  }

  template <class Number>
  Number parse(const std::string& token) const {
    Number value{};
    const char* end = token.data() + token.size();
    const auto [stop, error] = std::from_chars(token.data(), end, value);
    if (error != std::errc() || stop != end) fail("not a number: " + token);
    return value;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(path_ + ":" + std::to_string(number_) + ": " + what);
  }

 private:
  std::string path_;
  std::ifstream in_;
  long number_ = 0;
};

/// The points of a .node or .poly file in dimension D; a header that does not say so means the
/// plane.
template <std::size_t D>
Numbered<std::array<double, D>> read_places(TokenLines& lines) {
  const auto header = lines.next(1);
  const auto count = lines.parse<std::size_t>(header[0]);
  const std::size_t dimension = header.size() > 1 ? lines.parse<std::size_t>(header[1]) : 2;
  if (dimension != D) lines.fail(D == 2 ? "not in the plane" : "not in space");
  Numbered<std::array<double, D>> file;
  for (std::size_t i = 0; i < count; ++i) {
    const auto tokens = lines.next(D + 1);
    file.ids.push_back(lines.parse<long>(tokens[0]));
    std::array<double, D> place{};
    for (std::size_t k = 0; k < D; ++k) place[k] = lines.parse<double>(tokens[k + 1]);
    file.items.push_back(place);
  }
  return file;
}

template <std::size_t D>
Numbered<std::array<double, D>> read_places(const std::string& path) {
  TokenLines lines(path);
  return read_places<D>(lines);
}

inline NodeFile read_node(const std::string& path) {
  auto [ids, places] = read_places<2>(path);
  NodeFile file{std::move(ids), {}};
  for (const auto& [x, y] : places) file.sites.push_back({x, y});
  return file;
}

/// Simplices of N corners; `ids`: of the vertices. A header that does not say so means triangles.
template <std::size_t N>
EleFile<N> read_ele(const std::string& path, const std::vector<long>& ids) {
  std::unordered_map<long, std::size_t> position;
  for (std::size_t i = 0; i < ids.size(); ++i) position[ids[i]] = i;
  TokenLines lines(path);
  const auto header = lines.next(1);
  const auto count = lines.parse<std::size_t>(header[0]);
  const std::size_t size = header.size() > 1 ? lines.parse<std::size_t>(header[1]) : 3;
  if (size != N) lines.fail(N == 3 ? "not triangles" : "not tetrahedra");
  EleFile<N> file;
  for (std::size_t i = 0; i < count; ++i) {
    const auto tokens = lines.next(N + 1);
    file.ids.push_back(lines.parse<long>(tokens[0]));
    std::array<std::size_t, N> corners{};
    for (std::size_t k = 0; k < N; ++k) {
      const auto found = position.find(lines.parse<long>(tokens[k + 1]));
      if (found == position.end()) lines.fail("unknown vertex " + tokens[k + 1]);
      corners[k] = found->second;
    }
    file.items.push_back(corners);
  }
  return file;
}

}  // namespace oracle
