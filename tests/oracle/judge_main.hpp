// What the judges of meshes have in common: their arguments, the failures they print, and their
// exit codes. None of the mesher's own code.
#pragma once

#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace oracle {

struct Job {
  std::string nodes;
  std::string elements;
  std::string input;    // empty: none
  std::string complex;  // likewise; in space
  std::optional<double> rho;
};

/// Throws: std::runtime_error.
inline Job parse_job(const std::vector<std::string>& words) {
  Job job;
  std::vector<std::string> files;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] != "--input" && words[i] != "--rho" && words[i] != "--complex") {
      files.push_back(words[i]);
      continue;
    }
    if (i + 1 == words.size()) throw std::runtime_error(words[i] + " needs a value");
    if (words[i] == "--input")
      job.input = words[i + 1];
    else if (words[i] == "--complex")
      job.complex = words[i + 1];
    else
      job.rho = std::stod(words[i + 1]);
    ++i;
  }
  if (files.size() != 2)
    throw std::runtime_error(
        "usage: MESH.node MESH.ele [--input FILE.node] [--rho R] | --batch FILE");
  job.nodes = files[0];
  job.elements = files[1];
  return job;
}

/// What is wrong with a mesh, by kind. The first of every kind are printed as they come.
class Failures {
 public:
  explicit Failures(std::string mesh) : mesh_(std::move(mesh)) {}

  void add(const std::string& kind, const std::string& what) {
    if (++counts_[kind] <= kShown) std::cout << mesh_ << ": " << kind << ": " << what << '\n';
  }
  [[nodiscard]] bool none() const { return counts_.empty(); }
  /// Ends the judgement of the mesh: `good` describes it if it is.
  void report(const std::string& good) const {
    std::cout << (none() ? "ok " : "FAILED ") << mesh_ << ':';
    if (none()) std::cout << ' ' << good;
    for (const auto& [kind, count] : counts_) std::cout << ' ' << kind << ' ' << count;
    std::cout << std::endl;
  }

 private:
  static constexpr int kShown = 5;  // of each kind
  std::string mesh_;
  std::map<std::string, long> counts_;
};

template <class Judge>
bool judge_batch(std::istream& lines) {
  long judged = 0;
  long failed = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream in(line.substr(0, line.find('#')));
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    if (words.empty()) continue;
    ++judged;
    failed += !Judge(parse_job(words)).verdict();
  }
  if (judged == 0) throw std::runtime_error("a batch of no meshes");
  std::cout << judged << " meshes judged, " << failed << " failed" << std::endl;
  return failed == 0;
}

template <class Judge>
bool judge(const std::vector<std::string>& words) {
  if (words.size() != 2 || words[0] != "--batch") return Judge(parse_job(words)).verdict();
  if (words[1] == "-") return judge_batch<Judge>(std::cin);
  std::ifstream file(words[1]);
  if (!file) throw std::runtime_error(words[1] + ": cannot open");
  return judge_batch<Judge>(file);
}

/// All of a judge `name`: MESH.node MESH.ele [--input FILE.node] [--rho R], or --batch FILE, where
/// each line of FILE (or of stdin: '-') holds such arguments.
template <class Judge>
int judge_main(const std::string& name, const std::vector<std::string>& words) {
  try {
    return judge<Judge>(words) ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << name << ": " << error.what() << '\n';
    return 2;
  }
}

}  // namespace oracle
