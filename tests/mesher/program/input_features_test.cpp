// Observations of crowding in space: after edits, calls run again if their answers have changed,
// and what they know is what a look at all features says.
#include "program/input_features.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <memory>
#include <variant>
#include <vector>

#include "feature_scene.hpp"

namespace {

using namespace mesher::detail;

// Of pieces whether they are crowded; of polygons' whether they are hemmed in, too.
struct HemmedIn {
  FacetPiece piece;
};
using Question = std::variant<EdgePiece, FacetPiece, HemmedIn>;

// One call for each question; answers are kept, and who ran is noted.
struct Asking {
  explicit Asking(std::uint64_t seed) : scene(seed, engine) { engine.set_environment(this); }
  sac::Engine engine;
  support::FeatureScene<sac::Scope> scene;
  std::vector<Question> questions;
  std::vector<bool> answers;
  std::vector<bool> ran;

  bool answer(sac::Scope& s, const EdgePiece& p) { return scene.features().crowded(s, p); }
  bool answer(sac::Scope& s, const FacetPiece& p) { return scene.features().crowded(s, p); }
  bool answer(sac::Scope& s, const HemmedIn& q) { return scene.features().hemmed_in(s, q.piece); }
  bool naive(const EdgePiece& p) const { return scene.naive_any_in(EdgeBall(p)); }
  bool naive(const FacetPiece& p) const { return scene.naive_any_in(FacetBall(p)); }
  bool naive(const HemmedIn& q) const { return scene.naive_any_in(HingeBall(q.piece)); }
};

struct Ask {
  static constexpr std::string_view kName = "ask";
  void operator()(sac::Scope& s, std::size_t i) const {
    auto& all = s.environment<Asking>();
    all.ran[i] = true;
    all.answers[i] = std::visit([&](const auto& q) { return all.answer(s, q); }, all.questions[i]);
  }
};
inline constexpr Ask ask{};

struct AskAll {
  static constexpr std::string_view kName = "ask_all";
  void operator()(sac::Scope& s) const {
    for (std::size_t i = 0; i < s.environment<Asking>().questions.size(); ++i) s.call<ask>(i);
  }
};
inline constexpr AskAll ask_all{};

// Questions about features that stay; then what comes and goes.
class Editor {
 public:
  explicit Editor(std::uint64_t seed) : asking_(std::make_unique<Asking>(seed)) {
    auto& scene = asking_->scene;
    asking_->engine.set_audit(true);
    for (int i = 0; i < 10; ++i) {
      FacetPiece piece{&scene.add_polygon()};
      for (int halved = 0; halved < 10; ++halved) {
        asking_->questions.push_back(piece);
        asking_->questions.push_back(HemmedIn{piece});
        piece = piece.halves()[scene.random().below(2)];
      }
    }
    for (int i = 0; i < 40; ++i) {
      EdgePiece piece{&scene.add_edge()};
      for (int halved = 0; halved < 14; ++halved) {
        asking_->questions.push_back(piece);
        const bool upper = scene.random().below(2) == 1;
        piece = upper ? EdgePiece{piece.edge, piece.middle(), piece.hi}
                      : EdgePiece{piece.edge, piece.lo, piece.middle()};
      }
    }
    asking_->answers.resize(asking_->questions.size());
    asking_->ran.resize(asking_->questions.size());
    asking_->engine.run<ask_all>();
  }

  Asking& asking() { return *asking_; }

  void edit() {
    auto& scene = asking_->scene;
    auto& random = scene.random();
    switch (random.below(6)) {
      case 0:
        edges_.push_back(&scene.add_edge());
        break;
      case 1:
        polygons_.push_back(&scene.add_polygon());
        break;
      case 2:
        points_.push_back(scene.add_point(scene.place())->self);
        break;
      case 3:
        remove(edges_, [&](const Edge* e) { scene.features().erase(*e); });
        break;
      case 4:
        remove(polygons_, [&](const Polygon* f) { scene.features().erase(*f); });
        break;
      default:
        remove_point();
        break;
    }
  }
  /// A batch of edits, all of which may be taken back by the engine.
  void edit_some() {
    for (auto count = 1 + asking_->scene.random().below(3); count > 0; --count) edit();
  }
  void update() {
    std::fill(asking_->ran.begin(), asking_->ran.end(), false);
    asking_->engine.propagate();
    asking_->scene.features().commit();
  }

  void require_right(const std::vector<bool>& before) {
    auto& all = *asking_;
    all.scene.features().check_invariants();
    for (std::size_t i = 0; i < all.questions.size(); ++i) {
      CAPTURE(i);
      REQUIRE(all.answers[i] ==
              std::visit([&](const auto& q) { return all.naive(q); }, all.questions[i]));
      if (all.answers[i] != before[i]) REQUIRE(all.ran[i]);
    }
  }

 private:
  template <class T, class Erase>
  void remove(std::vector<const T*>& all, Erase&& erase) {
    if (all.empty()) return;
    std::swap(all[asking_->scene.random().below(all.size())], all.back());
    erase(all.back());
    all.pop_back();
  }
  // One that no feature uses.
  void remove_point() {
    auto& scene = asking_->scene;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const VertexHandle h = points_[i];
      bool used = scene.store().visit_edges_at(h, [](const Edge&) { return true; });
      scene.store().polygons().for_each([&](const Polygon& f) { used = used || f.has(h); });
      if (used) continue;
      scene.remove_point(h);
      points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(i));
      return;
    }
  }

  std::unique_ptr<Asking> asking_;
  std::vector<const Edge*> edges_;
  std::vector<const Polygon*> polygons_;
  std::vector<VertexHandle> points_;
};

}  // namespace

TEST_CASE("After edits every answer is that of a look at all features, and no other call has run") {
  const std::uint64_t seed = GENERATE(1, 2, 3, 4, 5, 6);
  CAPTURE(seed);
  Editor editor(seed);
  auto& all = editor.asking();
  std::array<std::size_t, 3> changed{};  // by kind of question
  for (int round = 0; round < 160; ++round) {
    CAPTURE(round);
    const std::vector<bool> before = all.answers;
    editor.edit_some();
    editor.update();
    editor.require_right(before);
    for (std::size_t i = 0; i < before.size(); ++i) {
      changed[all.questions[i].index()] += all.answers[i] != before[i];
    }
  }
  REQUIRE(changed[0] > 20);
  REQUIRE(changed[1] > 20);
  REQUIRE(changed[2] > 0);
}

TEST_CASE("One edit runs only the calls whose answers it changes") {
  const std::uint64_t seed = GENERATE(11, 12, 13, 14);
  CAPTURE(seed);
  Editor editor(seed);
  auto& all = editor.asking();
  for (int round = 0; round < 120; ++round) {
    CAPTURE(round);
    const std::vector<bool> before = all.answers;
    editor.edit();
    editor.update();
    for (std::size_t i = 0; i < before.size(); ++i) {
      CAPTURE(i);
      REQUIRE(all.ran[i] == (all.answers[i] != before[i]));
    }
  }
}

TEST_CASE("Edits that are taken back leave no trace") {
  const std::uint64_t seed = GENERATE(21, 22, 23);
  CAPTURE(seed);
  Editor editor(seed);
  auto& all = editor.asking();
  const auto& store = all.scene.store();
  for (int round = 0; round < 40; ++round) {
    const std::vector<bool> before = all.answers;
    const std::size_t edges = store.live_edges(), polygons = store.live_polygons();
    all.scene.add_edge();
    all.scene.add_polygon();
    REQUIRE(store.live_polygons() == polygons + 1);
    all.engine.undo_edits();
    REQUIRE(store.live_edges() == edges);
    REQUIRE(store.live_polygons() == polygons);
    editor.update();
    REQUIRE(all.answers == before);
    all.scene.features().check_invariants();
  }
}
