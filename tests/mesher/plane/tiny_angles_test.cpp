// Angles at which rounding decides on which side of a right angle a vertex is: wedges end all the
// same, and fans do or are refused by name.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <set>
#include <string>

#include "any_id.hpp"
#include "facade/box_mesher.hpp"
#include "feature_ids.hpp"
#include "pslg_judge.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Error;
using mesher::ErrorCode;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using support::Pslg;
using support::PslgJudge;

AnyId id(std::int64_t i) { return AnyId{i}; }

const Options<2> kOptions{.domain = {{-2, -2}, {2, 2}}, .max_vertices = 5000};

// Legs of these lengths from `apex`, point 1, the first in direction `turn`, each `degrees` on from
// the one before: segments 1, 2, ... to points 2, 3, ...
Pslg fan(double degrees, double turn, const std::vector<double>& lengths, Point<2> apex = {0, 0}) {
  const Point<2> u = turn == 0 ? Point<2>{1, 0} : Point<2>{std::cos(turn), std::sin(turn)};
  Pslg pslg;
  pslg.points[1] = apex;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const double angle = static_cast<double>(i) * degrees * 3.14159265358979323846 / 180;
    const double along = lengths[i] * std::cos(angle), across = lengths[i] * std::sin(angle);
    const auto leg = static_cast<std::int64_t>(i) + 1;
    pslg.points[leg + 1] = {apex[0] + (along * u[0] - across * u[1]),
                            apex[1] + (along * u[1] + across * u[0])};
    pslg.segments[{1, leg + 1}] = leg;
  }
  return pslg;
}

// The mesh by one update a leg.
BoxMesher<2> follow(const Pslg& pslg, const Options<2>& options) {
  BoxMesher<2> m(options);
  for (const auto& [i, p] : pslg.points) m.insert(id(i), p);
  m.update();
  for (const auto& [ends, line] : pslg.segments) {
    m.insert_segment(id(line), id(ends.first), id(ends.second));
    m.update();
  }
  return m;
}

int inner_vertices(const Mesh<2>& mesh) {
  const auto boundary =
      std::count(mesh.kinds.begin(), mesh.kinds.end(), mesher::VertexKind::boundary);
  return static_cast<int>(mesh.vertices.size()) - static_cast<int>(boundary);
}

constexpr double kTurns[] = {0, 1.5707963267948966, 0.3, 2.2, 4.0};

double angle_told(const std::string& message) {
  const std::string before = "angles down to ";
  return std::stod(message.substr(message.find(before) + before.size()));
}

}  // namespace

TEST_CASE("Wedges below double precision need vertices as the logarithm of their angle") {
  struct Row {
    double ratio;
    int at_one_degree, each_decade;
  };
  for (const Row& row : {Row{1, 51, 21}, Row{0.7, 75, 30}}) {
    for (const int decades : {5, 6, 8, 10}) {
      for (const double turn : kTurns) {
        INFO("1e-" << decades << " degrees, legs 1 : " << row.ratio << ", turned by " << turn);
        const Pslg pslg = fan(std::pow(10, -decades), turn, {1, row.ratio});
        const Mesh<2> mesh = static_mesh(pslg, kOptions);
        CHECK(PslgJudge(mesh, pslg).fault(kOptions) == "");
        CHECK(inner_vertices(mesh) <= row.at_one_degree + decades * row.each_decade);
        const BoxMesher<2> m = follow(pslg, kOptions);
        CHECK(m.mesh() == mesh);
        m.check_invariants();
      }
    }
  }
}

TEST_CASE("A wedge below double precision follows edits of its legs and of points near it") {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    const auto uniform = [&](double lo, double hi) {
      return std::uniform_real_distribution<double>(lo, hi)(random);
    };
    const double angle = std::pow(10, uniform(-10, -6));
    const Point<2> apex{uniform(-0.5, 0.5), uniform(-0.5, 0.5)};
    Pslg pslg = fan(angle, uniform(0, 6.28), {1, seed % 2 == 0 ? 1 : uniform(0.4, 1)}, apex);
    BoxMesher<2> m = follow(pslg, kOptions);
    for (std::int64_t step = 0; step < 14; ++step) {
      const std::int64_t leg = step / 2 % 2 + 1;
      if (random() % 3 != 0) {
        pslg.points[10 + step] = {uniform(-2, 2), uniform(-2, 2)};
        m.insert(id(10 + step), pslg.points[10 + step]);
      } else if (pslg.segments.erase({1, leg + 1}) == 1) {
        m.remove_line(id(leg));
      } else {
        pslg.segments[{1, leg + 1}] = leg;
        m.insert_segment(id(leg), id(1), id(leg + 1));
      }
      m.update();
      const Mesh<2> mesh = static_mesh(pslg, kOptions);
      REQUIRE(PslgJudge(mesh, pslg).fault(kOptions) == "");
      REQUIRE(m.mesh() == mesh);
      m.check_invariants();
    }
  }
}

// Between two others a leg can lose its edges to them.
TEST_CASE("Fans below double precision conform, or are refused by name and leave the mesh") {
  int refused = 0, meshed = 0;
  for (const int legs : {3, 5}) {
    for (const int decades : {4, 6, 7, 8, 9}) {
      for (const double turn : {0.0, 0.3, 2.2}) {
        INFO(legs << " legs, 1e-" << decades << " degrees, turned by " << turn);
        std::vector<double> lengths;
        for (int i = 0; i < legs; ++i) lengths.push_back(1 - 0.07 * (i * 3 % legs));
        Pslg pslg = fan(std::pow(10, -decades), turn, lengths);
        const auto last = *std::prev(pslg.segments.end());
        const auto judge = [&](const Mesh<2>& mesh) {
          return PslgJudge(mesh, pslg).fault(kOptions);
        };
        const auto is_named = [&](const Error& error) {
          std::set<std::int64_t> ids;
          for (const mesher::Feature& f : error.features()) ids.insert(f.number);
          return ids.size() >= 2 && std::all_of(ids.begin(), ids.end(), [&](std::int64_t i) {
                   return i >= 1 && i <= legs + 1;
                 });
        };
        bool is_meshed = true;
        try {
          const Mesh<2> mesh = static_mesh(pslg, kOptions);
          CHECK(judge(mesh) == "");
          ++meshed;
        } catch (const Error& error) {
          CHECK(error.code() == ErrorCode::too_close);
          CHECK(is_named(error));
          CHECK(error.message().find(" meet at (0, 0) at angles down to ") != std::string::npos);
          const double told = angle_told(error.message());
          CHECK(told > 0.9 * std::pow(10, -decades));
          CHECK(told < 1.1 * legs * std::pow(10, -decades));
          ++refused;
          is_meshed = false;
        }
        BoxMesher<2> m(kOptions);
        for (const auto& [i, p] : pslg.points) m.insert(id(i), p);
        m.update();
        const Mesh<2> before = m.mesh();
        for (const auto& [ends, line] : pslg.segments) {
          m.insert_segment(id(line), id(ends.first), id(ends.second));
        }
        try {
          m.update();
          CHECK(is_meshed);
          CHECK(judge(m.mesh()) == "");
        } catch (const Error& error) {
          CHECK_FALSE(is_meshed);
          CHECK(is_named(error));
          CHECK(m.mesh() == before);
          m.insert_segment(id(last.second), id(last.first.first), id(last.first.second));
          m.update();
          pslg.segments = {last};
          CHECK(m.mesh() == static_mesh(pslg, kOptions));
        }
        m.check_invariants();
      }
    }
  }
  CHECK(refused > 0);
  CHECK(meshed > 0);
}
