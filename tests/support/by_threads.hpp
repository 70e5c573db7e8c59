// Meshers on several threads beside one: what must be equal, and tiles that lose a message.
#pragma once

#include <array>
#include <catch2/catch.hpp>
#include <cstddef>
#include <exception>
#include <string>
#include <vector>

#include "facade/box_mesher.hpp"
#include "mesher/error.hpp"
#include "tiles/tile_mesher.hpp"

namespace support {

template <int D>
bool is_same(const mesher::Change<D>& a, const mesher::Change<D>& b) {
  return a.vertices_added == b.vertices_added && a.kinds_added == b.kinds_added &&
         a.vertices_removed == b.vertices_removed && a.kinds_changed == b.kinds_changed &&
         a.simplices_added == b.simplices_added && a.simplices_removed == b.simplices_removed &&
         a.edges_added == b.edges_added && a.edges_removed == b.edges_removed &&
         a.angles == b.angles;
}

/// stats() are of all tiles, engine() is of the first one.
template <int D>
bool is_tiled(const mesher::BoxMesher<D>& m) {
  return m.stats().calls != m.engine().live_calls();
}

/// The code of an error, its text, and its features.
inline std::string said(const mesher::Error& e) {
  std::string text = std::string(mesher::code_name(e.code())) + ": " + e.what();
  for (const auto& f : e.features()) text += "; " + mesher::text_of(f);
  return text;
}

/// Runs two tiles that have their edits, and exchange all messages but the one with the number
/// `lost`; visit(message) is called for each, and they are counted. Returns what the certificate
/// says.
template <int D, class Visit>
std::string fault_without(mesher::detail::TileMesher<D>& a, mesher::detail::TileMesher<D>& b,
                          std::size_t lost, std::size_t& messages, Visit&& visit) {
  using Tile = mesher::detail::TileMesher<D>;
  using Messages = std::vector<mesher::detail::Message<D>>;
  const std::array<Tile*, 2> tiles{&a, &b};
  messages = 0;
  const auto lose = [&](Messages& some) {
    for (std::size_t i = 0; i < some.size();) {
      visit(some[i]);
      messages++ == lost ? static_cast<void>(some.erase(some.begin() + static_cast<long>(i)))
                         : static_cast<void>(++i);
    }
  };
  const auto run_all = [&](auto&& run) {
    std::array<Messages, 2> out;
    for (std::size_t t = 0; t < 2; ++t) run(*tiles[t]), out[t] = tiles[t]->collect(nullptr);
    while (!out[0].empty() || !out[1].empty()) {
      lose(out[0]), lose(out[1]);
      b.receive(0, out[0]), a.receive(1, out[1]);
      for (std::size_t t = 0; t < 2; ++t) {
        out[t].clear();
        if (!tiles[t]->is_dirty()) continue;
        tiles[t]->propagate();
        out[t] = tiles[t]->collect(nullptr);
      }
      // Answers to a message that was lost may be about what is not there: then it is seen.
    }
  };
  run_all([](Tile& t) { t.run_quadtree(); });
  for (int part = 0; part < a.parts(); ++part) {
    run_all([&](Tile& t) { t.run_part(part); });
  }
  run_all([](Tile& t) { t.run_stars(); });
  const std::string fault = a.fault_with(b);
  return fault.empty() ? b.fault_with(a) : fault;
}

/// Of every `step`-th of `all` messages, the part of which fault(lost) tells that it was lost. (One
/// that others take back is not missed.)
template <class Fault>
double noticed(std::size_t all, std::size_t step, Fault&& fault) {
  std::size_t seen = 0, tried = 0;
  for (std::size_t lost = 0; lost < all; lost += step) {
    CAPTURE(lost);
    ++tried;
    try {
      if (!fault(lost).empty()) ++seen;
    } catch (const std::exception&) {
      ++seen;  // the end of what never began
    }
  }
  return static_cast<double>(seen) / static_cast<double>(tried);
}

}  // namespace support
