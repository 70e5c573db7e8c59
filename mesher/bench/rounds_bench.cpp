// First runs of points by several ranks, step by step, as counts: what each does and says.
//
//   rounds_bench [--steps] [[3d:]FAMILY:N:RANKS]...
//
// default: uniform:100000:1 uniform:100000:4. Ranks are threads of this process that meet where
// ranks of MPI would, with one tile each; their counts are those of MPI. One JSON line per case:
//   calls        that ran, of all ranks; live_calls: that are kept at the end
//   steps_calls  the most calls of a rank in each step, summed: a step ends where all meet
//   agreements   reductions over all ranks; each round has one more, and an exchange of sizes
//   rounds, horizons, messages, bytes, most_bytes, seen   as `mesher-mpi --stats`
//   peers        to how many others a rank ever sends: mean, most
//   rank_*       of a rank: mean and most
//   rank_s       of the processor, for the first run of a rank, without meetings: mean, most
//   undivided_s  of the processor, for what each rank does for all points: levels and cuts
// --steps: before it a line for each step in which something ran or was sent: calls, messages and
// bytes of a rank (mean, most), the ranks that sent, horizon.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "../../tests/support/thread_peers.hpp"
#include "bench_help.hpp"
#include "index/feature_tree.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/mesher.hpp"
#include "rules/mesh_box.hpp"
#include "sample.hpp"
#include "tiles/tiled_mesher.hpp"

namespace {

using mesher::Point;
using mesher::detail::Bytes;
using mesher::detail::Peers;
using mesher::detail::TiledMesher;

// What a rank has done between two meetings.
struct Step {
  std::uint64_t calls = 0, messages = 0, bytes = 0, horizon = 0;
};

// Of the processor, on this thread.
double thread_seconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Passes everything on, and notes what has been done before.
template <int D>
class Watched final : public Peers {
 public:
  explicit Watched(std::unique_ptr<Peers> peers) : peers_(std::move(peers)) {
    make_room(size());
    met_.resize(size());
  }
  void watch(const TiledMesher<D>* tiles) { tiles_ = tiles; }

  [[nodiscard]] std::size_t size() const noexcept override { return peers_->size(); }
  [[nodiscard]] std::size_t self() const noexcept override { return peers_->self(); }
  void least(Values values) noexcept override {
    end_step();
    const double start = thread_seconds();
    peers_->least(values);
    seconds_ += thread_seconds() - start;
  }
  void sum(Values values) noexcept override {
    end_step();
    const double start = thread_seconds();
    peers_->sum(values);
    seconds_ += thread_seconds() - start;
  }
  [[nodiscard]] std::vector<Bytes> exchange(const Views& out) override {
    for (std::size_t k = 0; k < size(); ++k) met_[k] = met_[k] || !out[k].empty();
    const double start = thread_seconds();
    std::vector<Bytes> in = peers_->exchange(out);
    seconds_ += thread_seconds() - start;
    return in;
  }
  /// That it took to meet.
  [[nodiscard]] double seconds() const noexcept { return seconds_; }

  /// Until now.
  [[nodiscard]] std::vector<Step> take_steps() {
    end_step();
    return std::move(steps_);
  }
  [[nodiscard]] std::size_t met() const {
    return static_cast<std::size_t>(std::count(met_.begin(), met_.end(), true));
  }

 private:
  void end_step() {
    const auto& e = tiles_->exchanges();
    const Step now{tiles_->calls(), e.messages_out, e.bytes_out, e.horizons};
    steps_.push_back({now.calls - before_.calls, now.messages - before_.messages,
                      now.bytes - before_.bytes, now.horizon});
    before_ = now;
  }

  std::unique_ptr<Peers> peers_;
  const TiledMesher<D>* tiles_ = nullptr;
  Step before_;
  std::vector<Step> steps_;
  std::vector<bool> met_;
  double seconds_ = 0;
};

struct Rank {
  std::vector<Step> steps;
  double seconds = 0;
  std::uint64_t calls = 0, live_calls = 0, seen = 0, vertices = 0, met = 0, bytes = 0;
  mesher::detail::Exchanges exchanges;
};

template <int D>
using Edit = typename mesher::detail::TileMesher<D>::Edit;

// Each point with its deepest crowded level.
template <int D>
std::vector<Edit<D>> edits_of(const std::vector<Point<D>>& points,
                              const mesher::detail::MeshBox<D>& box) {
  mesher::detail::VertexPool<D> pool;
  mesher::detail::FeatureTree<D> tree(box, pool);
  for (const Point<D>& p : points) tree.insert_only(pool.create(p));
  std::vector<Edit<D>> edits;
  typename mesher::detail::FeatureTree<D>::Path path;
  pool.for_each([&](const auto& v) {
    using Located = typename mesher::detail::TileMesher<D>::Located;
    edits.push_back({v.p, std::nullopt, Located(tree.crowded_level(v, path))});
  });
  return edits;
}

template <int D>
struct Case {
  std::string family;
  std::size_t n, ranks;
  std::vector<Point<D>> points;
  mesher::Options<D> options;

  Rank run(std::unique_ptr<Peers> peers, const std::vector<Edit<D>>& edits) const {
    Watched<D> watched(std::move(peers));
    TiledMesher<D> tiles(options, mesher::detail::mesh_box(options), points, ranks, 1, watched);
    watched.watch(&tiles);
    typename TiledMesher<D>::Edits mine(tiles.size());
    for (const auto& edit : edits) {
      if (const auto tile = tiles.own_tile(edit.p)) mine[*tile].push_back(edit);
    }
    const double start = thread_seconds();
    tiles.first_run(mine, {});
    const double seconds = thread_seconds() - start - watched.seconds();
    Rank rank{watched.take_steps(), seconds, tiles.calls(),    0, 0, tiles.vertices(),
              watched.met(),        0,       tiles.exchanges()};
    for (std::size_t t = 0; t < tiles.size(); ++t) {
      rank.live_calls += tiles[t].engine().live_calls();
      rank.seen += tiles[t].counts().seen;
      rank.bytes += tiles[t].bytes();
    }
    return rank;
  }
};

struct MeanAndMost {
  double mean = 0;
  std::uint64_t most = 0;
  template <class Number>
  MeanAndMost(const std::vector<Rank>& ranks, Number&& number) {
    for (const Rank& r : ranks) {
      const std::uint64_t x = number(r);
      mean += static_cast<double>(x) / static_cast<double>(ranks.size());
      most = std::max(most, x);
    }
  }
  [[nodiscard]] std::string text() const {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "[%.3f,%llu]", mean,
                  static_cast<unsigned long long>(most));
    return buffer;
  }
};

void print_step(const std::vector<Rank>& ranks, std::size_t k) {
  const auto of = [&](auto member) {
    return MeanAndMost(ranks, [&](const Rank& r) { return r.steps[k].*member; });
  };
  const auto calls = of(&Step::calls), messages = of(&Step::messages), bytes = of(&Step::bytes);
  if (calls.most == 0 && messages.most == 0) return;
  const auto talk = std::count_if(ranks.begin(), ranks.end(),
                                  [&](const Rank& r) { return r.steps[k].messages > 0; });
  std::printf(
      "{\"bench\":\"rounds\",\"figure\":\"step\",\"step\":%zu,\"horizon\":%llu,\"calls\":%s,"
      "\"messages\":%s,\"bytes\":%s,\"talking\":%td}\n",
      k, static_cast<unsigned long long>(ranks[0].steps[k].horizon), calls.text().c_str(),
      messages.text().c_str(), bytes.text().c_str(), talk);
}

std::string seconds_text(const std::vector<Rank>& ranks) {
  double sum = 0, most = 0;
  for (const Rank& r : ranks) sum += r.seconds, most = std::max(most, r.seconds);
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "[%.4f,%.4f]", sum / static_cast<double>(ranks.size()),
                most);
  return buffer;
}

std::uint64_t calls_of_steps(const std::vector<Rank>& ranks) {
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < ranks[0].steps.size(); ++k) {
    sum += MeanAndMost(ranks, [&](const Rank& r) { return r.steps[k].calls; }).most;
  }
  return sum;
}

template <int D>
void print(const Case<D>& c, const std::vector<Rank>& ranks, double undivided_s) {
  const auto text = [&](auto number) { return MeanAndMost(ranks, number).text(); };
  const auto sum = [&](auto number) {
    std::uint64_t all = 0;
    for (const Rank& r : ranks) all += number(r);
    return static_cast<unsigned long long>(all);
  };
  std::uint64_t most_bytes = 0;
  for (const Rank& r : ranks) most_bytes = std::max(most_bytes, r.exchanges.most_bytes_out);
  const mesher::detail::Exchanges& e = ranks[0].exchanges;
  std::printf(
      "{\"bench\":\"rounds\",\"figure\":\"run\",\"family\":\"%s\",\"dimension\":%d,\"n\":%zu,"
      "\"ranks\":%zu,\"vertices\":%llu,\"calls\":%llu,\"live_calls\":%llu,\"steps_calls\":%llu,"
      "\"agreements\":%zu,\"rounds\":%llu,\"horizons\":%llu,\"messages\":%llu,\"bytes\":%llu,"
      "\"most_bytes\":%llu,\"seen\":%llu,\"peers\":%s,\"rank_calls\":%s,\"rank_bytes_out\":%s,"
      "\"rank_seen\":%s,\"rank_vertices\":%s,\"rank_trace_bytes\":%s,\"rank_s\":%s,"
      "\"undivided_s\":%.2f}\n",
      c.family.c_str(), D, c.n, c.ranks, sum([](const Rank& r) { return r.vertices; }),
      sum([](const Rank& r) { return r.calls; }), sum([](const Rank& r) { return r.live_calls; }),
      static_cast<unsigned long long>(calls_of_steps(ranks)), ranks[0].steps.size() - 1,
      static_cast<unsigned long long>(e.rounds), static_cast<unsigned long long>(e.horizons),
      sum([](const Rank& r) { return r.exchanges.messages_out; }),
      sum([](const Rank& r) { return r.exchanges.bytes_out; }),
      static_cast<unsigned long long>(most_bytes), sum([](const Rank& r) { return r.seen; }),
      text([](const Rank& r) { return r.met; }).c_str(),
      text([](const Rank& r) { return r.calls; }).c_str(),
      text([](const Rank& r) { return r.exchanges.bytes_out; }).c_str(),
      text([](const Rank& r) { return r.seen; }).c_str(),
      text([](const Rank& r) { return r.vertices; }).c_str(),
      text([](const Rank& r) { return r.bytes; }).c_str(), seconds_text(ranks).c_str(),
      undivided_s);
  std::fflush(stdout);
}

template <int D>
bool bench_points(const std::string& family, std::size_t n, std::size_t ranks, bool steps) {
  const auto kind = mesher::point_kind(family);
  if (!kind || n == 0 || ranks == 0) return false;
  Case<D> c{family, n, ranks, mesher::generate_points<D>(*kind, n, 1), {}};
  c.options.domain = mesher::snapped_domain<D>(c.points);
  std::vector<Edit<D>> edits;
  const double undivided_s = bench::seconds_of([&] {
    edits = edits_of<D>(c.points, mesher::detail::mesh_box(c.options));
    static_cast<void>(mesher::detail::Territories<D>(c.points, ranks));
  });
  std::vector<Rank> all(ranks);
  support::in_processes(ranks, [&](std::unique_ptr<Peers> peers, std::size_t self) {
    all[self] = c.run(std::move(peers), edits);
  });
  for (std::size_t k = 0; steps && k < all[0].steps.size(); ++k) print_step(all, k);
  print(c, all, undivided_s);
  return true;
}

bool bench_argument(std::string_view text, bool steps) {
  const bool in_space = text.substr(0, 3) == "3d:";
  if (in_space) text.remove_prefix(3);
  const std::size_t colon = text.find(':'), second = text.find(':', colon + 1);
  if (colon == text.npos || second == text.npos) return false;
  const std::string family(text.substr(0, colon));
  const std::size_t n = std::strtoull(text.data() + colon + 1, nullptr, 10);
  const std::size_t ranks = std::strtoull(text.data() + second + 1, nullptr, 10);
  return in_space ? bench_points<3>(family, n, ranks, steps)
                  : bench_points<2>(family, n, ranks, steps);
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  std::vector<std::string_view> cases(argv + 1, argv + argc);
  const bool steps = std::erase(cases, "--steps") != 0;
  if (cases.empty()) cases = {"uniform:100000:1", "uniform:100000:4"};
  for (const std::string_view text : cases) {
    if (bench_argument(text, steps)) continue;
    std::fprintf(stderr, "%s: not [3d:]FAMILY:N:RANKS\n", std::string(text).c_str());
    return 2;
  }
}
