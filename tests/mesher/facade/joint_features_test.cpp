// Lines, polygons and slivers in meshers of several processes, here threads: at every step the
// mesh, the change and the errors are those of one process, whatever happens on the way.
#include <catch2/catch.hpp>

#include "facade/joint_mesher.hpp"
#include "joint_twin.hpp"
#include "plc_families.hpp"
#include "space_parcels.hpp"
#include "thread_peers.hpp"

namespace {

using mesher::Box;
using mesher::Options;
using mesher::PslgKind;
using mesher::detail::JointMesher;
using mesher::detail::Peers;

template <int D>
using Twin = support::JointTwin<D, JointMesher<D>>;

// --- The plane

Options<2> in_square(int threads) { return {.domain = {{0, 0}, {1, 1}}, .threads = threads}; }

struct Lines {
  PslgKind kind;
  std::size_t n;
  std::uint64_t seed;
  std::optional<double> angle{};
};

// Limits in boxes, sometimes everywhere.
template <class Edits>
void edit_limits(Twin<2>& twin, Edits& edits) {
  const mesher::SizeLimits<2> limits{.max_measure = 0.001 * static_cast<double>(edits.below(4))};
  if (edits.below(6) == 0) return twin.limit(limits);
  const double x = 0.1 * static_cast<double>(edits.below(8));
  twin.limit({{x, 0.2}, {x + 0.2, 0.2 + 0.05 * static_cast<double>(1 + edits.below(4))}}, limits);
}

void check_lines(const Lines& lines, std::size_t processes, int threads, int steps,
                 double measure) {
  CAPTURE(static_cast<int>(lines.kind), lines.seed, processes, threads, measure);
  const auto graph = mesher::generate_pslg({lines.kind, lines.n, lines.seed, lines.angle});
  const auto run = [&](std::unique_ptr<Peers> peers, std::size_t self) {
    Options<2> options = in_square(threads);
    options.max_measure = measure;
    JointMesher<2> joint(std::move(peers), options);
    Twin<2> twin(joint, self, processes);
    support::JointLines edits(twin, lines.seed + 5);
    edits.insert(graph);
    twin.update();
    int done = 0;
    for (int step = 0; step < steps; ++step) {
      for (std::uint64_t i = 1 + edits.below(3); i > 0; --i) edits.edit();
      if (measure != 0 && edits.below(3) == 0) edit_limits(twin, edits);
      try {
        twin.update();
        ++done;
      } catch (const mesher::Error&) {  // of both
      } catch (const std::exception& fault) {
        throw std::logic_error("step " + std::to_string(step) + ": " + fault.what());
      }
    }
    twin.check();
    support::demand(steps < 6 || done > 0, "nothing was done");
  };
  REQUIRE_NOTHROW(support::in_processes(processes, run));
}

constexpr PslgKind kFamilies[] = {PslgKind::segments, PslgKind::lengths,   PslgKind::polylines,
                                  PslgKind::trees,    PslgKind::corridors, PslgKind::zigzag,
                                  PslgKind::fan,      PslgKind::bundle};
std::size_t size_of(PslgKind kind) {
  return kind == PslgKind::fan || kind == PslgKind::bundle ? 12 : 40;
}

// --- Space

constexpr double kAcross = support::SpaceParcels<Twin<3>>::kAcross;

Options<3> in_cube(int threads, double measure, double min_dihedral) {
  Options<3> options;
  options.domain = {{0, 0, 0}, {kAcross, kAcross, kAcross}};
  options.threads = threads;
  options.max_measure = measure;
  options.min_dihedral = min_dihedral;
  return options;
}

void check_complexes(std::uint64_t seed, const Options<3>& options, std::size_t processes,
                     int updates) {
  CAPTURE(seed, processes, options.threads, options.max_measure, options.min_dihedral);
  const auto run = [&](std::unique_ptr<Peers> peers, std::size_t self) {
    JointMesher<3> joint(std::move(peers), options);
    Twin<3> twin(joint, self, processes);
    support::SpaceParcels<Twin<3>> parcels(twin, seed);
    int done = 0;
    for (int update = 0; update < updates; ++update) {
      const std::uint64_t count = update == 0 ? 6 : 1 + parcels.below(3);
      try {
        done += parcels.edit_and(count, [&] { twin.update(); });
      } catch (const std::exception& fault) {
        throw std::logic_error("update " + std::to_string(update) + ": " + fault.what());
      }
    }
    twin.check();
    support::demand(done > updates / 2, "little was done");
  };
  REQUIRE_NOTHROW(support::in_processes(processes, run));
}

}  // namespace

TEST_CASE("with lines, in several processes every update is that of one") {
  std::uint64_t seed = 1;
  for (const PslgKind kind : kFamilies) {
    check_lines({kind, size_of(kind), seed}, seed % 2 == 0 ? 2 : 5, seed % 3 == 0 ? 2 : 1, 10, 0);
    ++seed;
  }
}
TEST_CASE("with lines and limits of size, in several processes every update is that of one") {
  check_lines({PslgKind::segments, 30, 11}, 3, 1, 8, 0.002);
  check_lines({PslgKind::trees, 30, 12}, 2, 2, 8, 0.002);
}
TEST_CASE("lines at tiny angles, in several processes") {
  for (const double angle : {1e-6, 0.001, 0.5, 5.0}) {
    check_lines({PslgKind::bundle, 6, 3, angle}, 3, 1, 5, 0);
    check_lines({PslgKind::fan, 6, 3, angle}, 2, 1, 5, 0);
  }
}
TEST_CASE("soak: with lines, in several processes every update is that of one", "[.soak][soak]") {
  std::uint64_t seed = 20;
  for (const PslgKind kind : kFamilies) {
    for (const std::size_t processes : {2, 3, 4, 7}) {
      check_lines({kind, size_of(kind), seed}, processes, 1 + static_cast<int>(seed % 2), 16,
                  seed % 3 == 0 ? 0.002 : 0);
      ++seed;
    }
  }
}

TEST_CASE("with complexes, in several processes every update is that of one") {
  check_complexes(1, in_cube(1, 0, 0), 2, 6);
  check_complexes(2, in_cube(2, 0, 0), 3, 4);
  check_complexes(3, in_cube(1, 0.02, 10), 3, 4);
}
TEST_CASE("soak: with complexes, in several processes every update is that of one",
          "[.soak][soak]") {
  for (std::uint64_t seed = 20; seed < 40; ++seed) {
    check_complexes(seed, in_cube(1, seed % 3 == 0 ? 0.01 : 0, seed % 4 == 0 ? 10 : 0),
                    2 + seed % 4, 12);
  }
}
