#include "sac/internal/watches.hpp"

#include <algorithm>

#include "sac/mod.hpp"

namespace sac {

namespace detail {

void Watches::touch(Handle head) noexcept {
  Watch& watch = *all_.find(head)->second;
  if (!std::exchange(watch.touched, true)) touched_.push_back(head);  // there is room
}

void Watches::forget(Handle from, std::size_t bytes) noexcept {
  const auto first = all_.lower_bound(from);
  auto last = first;
  while (last != all_.end() && (last->first - from) * Arena::kGranule < bytes) {
    std::erase(touched_, last->first);
    ++last;
  }
  all_.erase(first, last);
}

// A function that is called may watch, edit, and propagate.
void Watches::report() {
  changed_.clear();
  changed_.reserve(touched_.size());
  std::vector<std::shared_ptr<Watch>> called;
  called.reserve(touched_.size());
  std::sort(touched_.begin(), touched_.end());
  while (!touched_.empty()) {
    const Handle head = touched_.back();
    const std::shared_ptr<Watch>& watch = all_.find(head)->second;
    if (watch->update(mods_.newest(head))) {
      changed_.push_back(head);
      called.push_back(watch);
    }
    watch->touched = false;
    touched_.pop_back();
  }
  std::reverse(changed_.begin(), changed_.end());
  for (auto watch = called.rbegin(); watch != called.rend(); ++watch) (*watch)->call();
}

}  // namespace detail

detail::Watches& Engine::watches() {
  if (watches_ == nullptr) watches_ = std::make_unique<detail::Watches>(*mods_);
  core_.watching_ = true;
  return *watches_;
}

void Engine::unwatch(Handle head) noexcept {
  mods_->set_watched(head, false);
  if (watches_ != nullptr) watches_->forget(head, Arena::kGranule);
}

bool Engine::changed(Handle head) const noexcept {
  if (watches_ == nullptr) return false;
  const auto& all = watches_->changed();
  return std::binary_search(all.begin(), all.end(), head);
}

void Engine::touched(Handle head) noexcept { watches_->touch(head); }

void Engine::forget_watches(Handle from, std::size_t bytes) noexcept {
  if (watches_ != nullptr) watches_->forget(from, bytes);
}

void Engine::report_changes() {
  if (watches_ != nullptr) watches_->report();
}

void Engine::report_no_change() noexcept {
  if (watches_ != nullptr) watches_->report_nothing();
}

}  // namespace sac
