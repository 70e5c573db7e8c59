// The mesher under edits of lines, by its traces: a propagated trace is that of a fresh run, the
// work is within twice the distance, and the audits have nothing to say.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "facade/box_mesher.hpp"
#include "mesher/extra/generate.hpp"
#include "traces/audit.hpp"
#include "traces/distance.hpp"
#include "traces/recorder.hpp"

namespace {

using mesher::BoxMesher;
using mesher::LineId;
using mesher::Point;
using mesher::PointId;

// What is there, by id, and a mesher that follows it.
class Followed {
 public:
  explicit Followed(const mesher::Graph<2>& pslg) {
    for (const auto& v : pslg.points) points_[v.id] = v.at;
    for (const auto& s : pslg.segments) lines_[s.id] = {s.from, s.to};
    fill(mesher_);
    mesher_.update();
  }

  BoxMesher<2>& mesher() { return mesher_; }
  [[nodiscard]] traces::Trace trace() const { return traces::Recorder(mesher_.engine()).trace(); }
  [[nodiscard]] traces::Trace fresh_trace() const {
    BoxMesher<2> fresh(mesher_.options());
    fill(fresh);
    fresh.update();
    return traces::Recorder(fresh.engine()).trace();
  }

  void insert(PointId p, const Point<2>& at) { mesher_.insert(p, at), points_[p] = at; }
  void remove(PointId p) { mesher_.remove(p), points_.erase(p); }
  void move(PointId p, const Point<2>& at) { mesher_.move(p, at), points_[p] = at; }
  void insert_line(LineId l, const std::vector<PointId>& along) {
    mesher_.insert_polyline(l, along), lines_[l] = along;
  }
  void remove_line(LineId l) { mesher_.remove_line(l), lines_.erase(l); }
  [[nodiscard]] const Point<2>& at(PointId p) const { return points_.at(p); }

  // Makes the edits and updates; false, with all as before, if that is refused.
  bool update(const std::function<void()>& edits, mesher::CallCounts& calls) {
    const auto points = points_;
    const auto lines = lines_;
    try {
      edits();
      calls = mesher_.update().calls;
      return true;
    } catch (const mesher::Error&) {
      mesher_.discard_edits();
      points_ = points, lines_ = lines;
      mesher_.update();  // calls that were asked for go with the next update
      return false;
    }
  }

 private:
  void fill(BoxMesher<2>& m) const {
    for (const auto& [p, at] : points_) m.insert(p, at);
    for (const auto& [l, along] : lines_) m.insert_polyline(l, along);
  }

  BoxMesher<2> mesher_{{.domain = {{0, 0}, {1, 1}}}};
  std::map<PointId, Point<2>> points_;
  std::map<LineId, std::vector<PointId>> lines_;
};

// A line of `n` points from somewhere on, each at most `step` from the one before.
class RandomLines {
 public:
  RandomLines(Followed& f, std::uint64_t seed) : f_(f), random_(seed) {}

  void come(int n, double step) {
    Point<2> p{random_.unit(), random_.unit()};
    std::vector<PointId> along;
    for (int i = 0; i < n; ++i) {
      along.push_back(PointId{next_++});
      f_.insert(along.back(), p);
      p = near(p, step);
    }
    if (n > 1) f_.insert_line(line_of(along), along);
    announced_ = along;
  }
  void accept() { there_.push_back(announced_); }
  void go() {
    std::swap(there_[random_.below(there_.size())], there_.back());
    if (there_.back().size() > 1) f_.remove_line(line_of(there_.back()));
    for (const PointId p : there_.back()) f_.remove(p);
  }
  void gone() { there_.pop_back(); }
  void move_one(double step) {
    const auto& along = there_[random_.below(there_.size())];
    const PointId p = along[random_.below(along.size())];
    f_.move(p, near(f_.at(p), step));
  }
  [[nodiscard]] bool any() const { return !there_.empty(); }
  [[nodiscard]] std::uint64_t below(std::uint64_t n) { return random_.below(n); }

 private:
  // It has the number of its first point.
  static LineId line_of(const std::vector<PointId>& along) {
    return LineId{static_cast<std::int64_t>(along.front())};
  }
  Point<2> near(const Point<2>& p, double step) {
    const auto moved = [&](double x) {
      return std::clamp(x + step * (2 * random_.unit() - 1), 0.0, 1.0);
    };
    return {moved(p[0]), moved(p[1])};
  }

  Followed& f_;
  mesher::SplitMix64 random_;
  std::int64_t next_ = 1'000'000;
  std::vector<PointId> announced_;
  std::vector<std::vector<PointId>> there_;
};

// The functions of which the traces have different calls, and how many.
std::string drift(const traces::Trace& after, const traces::Trace& fresh) {
  std::string text;
  for (const auto& [name, counts] : traces::distance(after, fresh).by_function) {
    if (counts.distance() == 0) continue;
    text += name + " " + std::to_string(counts.calls_a - counts.common) + " more, " +
            std::to_string(counts.calls_b - counts.common) + " fewer; ";
  }
  return text;
}

struct Totals {
  std::uint64_t work = 0, distance = 0, refused = 0;
  double worst = 0;
};

// `edits` random edits, each checked against a fresh run.
Totals follow(mesher::PslgKind kind, std::uint64_t seed, int edits) {
  Followed f(mesher::generate_pslg({kind, 60, seed}));
  RandomLines lines(f, seed);
  Totals totals;
  traces::Trace before = f.trace();
  for (int i = 0; i < edits; ++i) {
    const auto which = lines.any() ? lines.below(5) : 0;
    mesher::CallCounts calls;
    const bool made = f.update(
        [&] {
          if (which < 2) lines.come(1 + static_cast<int>(lines.below(10)), 0.05);
          if (which == 2) lines.go();
          if (which > 2) lines.move_one(0.03);
        },
        calls);
    INFO("family " << static_cast<int>(kind) << ", seed " << seed << ", edit " << i << ", kind "
                   << which << (made ? "" : ", refused"));
    if (made && which < 2) lines.accept();
    if (made && which == 2) lines.gone();
    const traces::Trace after = f.trace();
    REQUIRE(drift(after, f.fresh_trace()) == "");
    REQUIRE(traces::check_concise(after).surplus == 0);
    REQUIRE(traces::check_monotone(before, after).moved == 0);
    const std::uint64_t distance = traces::distance(before, after).all.distance();
    if (!made) REQUIRE(distance == 0);
    const std::uint64_t work = calls.created + calls.discarded + calls.executed;
    totals.refused += !made;
    totals.work += work, totals.distance += distance;
    if (distance > 0) {
      totals.worst =
          std::max(totals.worst, static_cast<double>(work) / static_cast<double>(distance));
    }
    before = after;
  }
  return totals;
}

}  // namespace

TEST_CASE("edits of lines leave the trace of a fresh run, at twice its distance at most") {
  for (const auto kind : {mesher::PslgKind::segments, mesher::PslgKind::polylines,
                          mesher::PslgKind::trees, mesher::PslgKind::lengths}) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const Totals totals = follow(kind, seed, 60);
      INFO("family " << static_cast<int>(kind) << ", seed " << seed << ": work " << totals.work
                     << ", distance " << totals.distance << ", of one edit at most " << totals.worst
                     << " times");
      CHECK(totals.work <= 2 * totals.distance);
      CHECK(totals.worst <= 4);
      CHECK(totals.refused < 50);
    }
  }
}
