#include "sac/internal/watches.hpp"

#include <algorithm>

#include "sac/mod.hpp"

namespace sac {

namespace detail {

void Watches::touch(ModRef mod) noexcept {
  Watch& watch = *all_.find(mod.handle())->second;
  if (!std::exchange(watch.touched, true)) touched_.push_back(mod.handle());  // there is room
}

void Watches::drop(ModRef mod) noexcept {
  if (!all_.contains(mod.handle())) return;
  mods_.set_watched(mod, false);
  forget(mod.handle(), Arena::kGranule);
}

void Watches::forget(Handle from, std::size_t bytes) noexcept {
  const auto first = all_.lower_bound(from);
  auto last = first;
  for (; last != all_.end() && (last->first - from) * Arena::kGranule < bytes; ++last) {
    last->second->gone = true;
    std::erase(touched_, last->first);
  }
  all_.erase(first, last);
}

void Watches::prepare() {
  prepared_.clear();
  prepared_.reserve(touched_.size());
  std::sort(touched_.begin(), touched_.end());
  for (const Handle head : touched_) {
    const std::shared_ptr<Watch>& watch = all_.find(head)->second;
    if (watch->prepare(mods_.newest(ModRef(head)))) prepared_.emplace_back(head, watch);
  }
  to_call_ = prepared_;
}

void Watches::commit() noexcept {
  for (const Handle head : touched_) all_.find(head)->second->touched = false;
  touched_.clear();
  changed_.swap(prepared_);
  prepared_.clear();
  for (const auto& [head, watch] : changed_) watch->commit();
}

// A function that is called may watch, edit, and propagate.
void Watches::call() {
  const Changes told = std::exchange(to_call_, {});
  for (const auto& [head, watch] : told) watch->call();
}

bool Watches::has_changed(ModRef mod) const noexcept {
  const auto at = std::lower_bound(changed_.begin(), changed_.end(), mod.handle(),
                                   [](const auto& c, Handle h) { return c.first < h; });
  return at != changed_.end() && at->first == mod.handle() && !at->second->gone;
}

}  // namespace detail

void Engine::touched(ModRef mod) noexcept { watches_->touch(mod); }

void Engine::forget_watches(Handle from, std::size_t bytes) noexcept {
  watches_->forget(from, bytes);
}

}  // namespace sac
