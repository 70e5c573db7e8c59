// An example of the engine (an App of sac/examples/apps/app.hpp) under its random edits, as a
// subject for stability and for recordings.
#pragma once

#include <cstdint>
#include <string>

#include "apps/app.hpp"
#include "traces/recorder.hpp"
#include "traces/stability.hpp"

namespace tool {

/// A program under random edits that can be recorded into a file.
class RecordedSubject : public traces::Subject {
 public:
  virtual traces::Recording record(const std::string& path, traces::Edges edges) const = 0;
};

template <class App>
class AppSubject final : public RecordedSubject {
 public:
  /// Its first input has about `size` elements.
  AppSubject(std::uint64_t seed, int size)
      : random_(seed), input_(App::random_input(random_, size)), run_(input_) {}

  Edit edit() override {
    const auto e = App::random_edit(random_, input_);
    App::apply(input_, e);
    run_.world.edit(e);
    return {run_.engine.propagate(), {}};
  }
  [[nodiscard]] traces::Trace trace() const override { return run_.trace(); }
  [[nodiscard]] traces::Trace fresh_trace() const override { return Run(input_).trace(); }
  traces::Recording record(const std::string& path, traces::Edges edges) const override {
    traces::Recorder recorder(run_.engine);
    run_.world.name(recorder);
    return recorder.record(path, edges);
  }

 private:
  struct Run {
    sac::Engine engine;
    typename App::template World<sac::Engine> world;

    explicit Run(const typename App::Input& input)
        : world((engine.record_weights(), engine), input) {}
    [[nodiscard]] traces::Trace trace() const {
      traces::Recorder recorder(engine);
      world.name(recorder);
      return recorder.trace();
    }
  };

  apps::Random random_;
  typename App::Input input_;
  Run run_;
};

}  // namespace tool
