#include "sac/internal/watches.hpp"

#include <algorithm>

#include "sac/mod.hpp"

namespace sac {

namespace detail {

void Watches::touch(Handle head) noexcept {
  Watch& watch = *all_.find(head)->second;
  if (!std::exchange(watch.touched, true)) touched_.push_back(head);  // there is room
}

void Watches::drop(Handle head) noexcept {
  if (!all_.contains(head)) return;
  mods_.set_watched(head, false);
  forget(head, Arena::kGranule);
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
    if (watch->prepare(mods_.newest(head))) prepared_.emplace_back(head, watch);
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

bool Watches::has_changed(Handle head) const noexcept {
  const auto at = std::lower_bound(changed_.begin(), changed_.end(), head,
                                   [](const auto& c, Handle h) { return c.first < h; });
  return at != changed_.end() && at->first == head && !at->second->gone;
}

}  // namespace detail

detail::Watches& Engine::watches() {
  if (watches_ == nullptr) watches_ = std::make_unique<detail::Watches>(*mods_);
  core_.settings.watching = true;
  return *watches_;
}

void Engine::unwatch(Handle head) noexcept {
  if (watches_ != nullptr) watches_->drop(head);
}

bool Engine::changed(Handle head) const noexcept {
  return watches_ != nullptr && watches_->has_changed(head);
}

void Engine::touched(Handle head) noexcept { watches_->touch(head); }

void Engine::forget_watches(Handle from, std::size_t bytes) noexcept {
  if (watches_ != nullptr) watches_->forget(from, bytes);
}

void Engine::prepare_changes() {
  if (watches_ != nullptr) watches_->prepare();
}

// Everything is done; who wants to know is told.
Counts Engine::finish_changes() {
  const Counts work = core_.finish();
  if (watches_ != nullptr) {
    watches_->commit();
    watches_->call();
  }
  return work;
}

void Engine::forget_changes() noexcept {
  if (watches_ != nullptr) watches_->clear();
}

}  // namespace sac
