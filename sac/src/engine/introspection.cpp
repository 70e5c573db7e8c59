// What the client is told.
#include <algorithm>
#include <sstream>

#include "sac/agenda.hpp"
#include "sac/engine.hpp"
#include "sac/mod.hpp"
#include "sac/query.hpp"

namespace sac {

std::string Engine::describe(const Call& call) {
  std::ostringstream out;
  out << call.function().name << '(';
  call.function().print(call, out);
  out << ')';
  return out.str();
}

std::string Engine::describe_mod(ModRef mod) const {
  if (mod == nullptr) return "a modifiable that is null";
  const std::string handle = '@' + std::to_string(mod.handle());
  const auto name = settings.names.find(mod.handle());
  return name == settings.names.end() ? "modifiable " + handle
                                      : "modifiable '" + name->second + "' (" + handle + ')';
}

Memory Engine::memory() const noexcept {
  const Core::Sizes known = sizes();
  Memory m;
  m.calls_and_edges_live = arena().bytes_used();
  m.calls_and_edges_held = arena().bytes_held();
  m.time_stamps = known.time_stamps;
  m.memo_table = known.memo_table;
  m.queue = known.queue;
  for (const auto& agenda : agendas_) m.agendas += agenda->bytes();
  m.versions = mods_->bytes();
  if (queries_ != nullptr) m.queries = queries_->bytes();
  m.outside = (outside_.capacity() + released_.capacity()) * sizeof(outside_[0]) +
              rollback_.capacity() * sizeof(rollback_[0]);
  return m;
}

std::vector<FunctionProfile> Engine::profile() const {
  const Registry<Function>& known = functions();
  std::vector<FunctionProfile> functions(known.size());
  walk([&](const Call& c, std::size_t) {
    FunctionProfile& f = functions[c.function_number];
    ++f.calls;
    f.bytes += c.function().frame_bytes;
    for_each_edge(c, [&](const Edge& edge) {
      ++f.edges;
      f.edge_bytes += edge.granules * Arena::kGranule;
    });
  });
  for (std::size_t i = 0; i < functions.size(); ++i) {
    functions[i].name = known[static_cast<std::uint16_t>(i)].name;
  }
  std::erase_if(functions, [](const FunctionProfile& f) { return f.calls == 0; });
  std::stable_sort(functions.begin(), functions.end(), [](const auto& a, const auto& b) {
    return a.bytes + a.edge_bytes > b.bytes + b.edge_bytes;
  });
  return functions;
}

void Engine::shrink() {
  begin_edit("shrink");
  Core::shrink();
  mods_->shrink();
  outside_.shrink_to_fit();
  released_.shrink_to_fit();
  rollback_.shrink_to_fit();
}

void Engine::set_progress(std::function<bool(const Progress&)> report, std::uint64_t every) {
  require_idle("set_progress");
  SAC_EXPECTS(every > 0);
  settings.progress = std::move(report);
  settings.progress_every = every;
}

void Engine::check_invariants() const {
  std::uint64_t waiting = 0;
  for (const auto& agenda : agendas_) waiting += agenda->waiting_calls();
  Core::check_invariants(waiting);
  for (std::size_t i = 0; i < outside_.size(); ++i) {
    SAC_INVARIANT(arena()[outside_[i]].position == i);
  }
  for_each_structure([](const Structure& s) { s.check_invariants(); });
}

}  // namespace sac
