// Targets that are built of sources and of other targets, on demand, each once.
//
// Idea: a target is a query (sac/query.hpp): the first that needs it builds it, the others get what
// it has made. What is built is a hash here, of the source and of what has been built of the
// targets needed.
//
// Cost of an update: the targets that have another hash, and those that ask for them. A target that
// another one is the first to need is built anew with those that it was the first to need.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "sac/sac.hpp"

namespace examples::build_graph {

template <class S>
struct Project {
  std::vector<typename S::template ModType<int>> sources;             // inputs: of each target
  std::vector<typename S::template ModType<std::vector<int>>> needs;  // inputs: other targets
  typename S::template ModType<std::vector<int>> wanted;              // input
  typename S::template ModType<std::vector<std::uint64_t>> built;     // what is wanted

  template <class Host>
  Project(Host& host, int size)
      : wanted(host.input(std::vector<int>{})),
        built(host.template cell<std::vector<std::uint64_t>>()) {
    for (int t = 0; t < size; ++t) {
      sources.push_back(host.input(int{}));
      needs.push_back(host.input(std::vector<int>{}));
    }
    host.set_environment(this);
  }
  Project(const Project&) = delete;  // it is the environment
  Project& operator=(const Project&) = delete;
};

struct Build {
  static constexpr std::string_view kName = "build";
  template <class S>
  std::uint64_t operator()(S& s, int target) const {
    auto& project = s.template environment<Project<S>>();
    auto hash = static_cast<std::uint64_t>(s.read(project.sources[target]));
    for (const int t : s.read(project.needs[target])) {
      hash = sac::mix(hash + s.template query<Build{}>(t));
    }
    return hash;
  }
};

struct BuildAll {
  static constexpr std::string_view kName = "build all";
  template <class S>
  void operator()(S& s) const {
    auto& project = s.template environment<Project<S>>();
    std::vector<std::uint64_t> all;
    for (const int t : s.read(project.wanted)) all.push_back(s.template query<Build{}>(t));
    s.write(project.built, std::move(all));
  }
};
inline constexpr BuildAll build_all{};

}  // namespace examples::build_graph
