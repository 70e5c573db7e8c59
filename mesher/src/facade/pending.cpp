// Keeping the announced edits: by point, and by the cell that a point shall be in.
#include "facade/pending.hpp"

#include <algorithm>
#include <tuple>

namespace mesher::detail {

template <int D>
auto Pending<D>::find(PointId id) const -> const Edit* {
  const auto it = edits_.find(id);
  return it == edits_.end() || it->second.to == it->second.was ? nullptr : &it->second;
}

template <int D>
void Pending<D>::erase_arrival(const Point<D>& p, PointId id) noexcept {
  const auto [first, last] = arrivals_.equal_range(box_.fixed(p));
  arrivals_.erase(std::find_if(first, last, [&](const auto& entry) { return entry.second == id; }));
}

// What may throw comes first; the old place leaves last. Where a point is back at its old place the
// entry stays, so that setting it back to what it was needs no memory.
template <int D>
void Pending<D>::set(PointId id, const Place& was, const Place& to) {
  const auto [it, fresh] = edits_.try_emplace(id, Edit{id, was, was});
  Edit& edit = it->second;
  const bool arrives = to && to != was;
  try {
    if (arrives) arrivals_.emplace(box_.fixed(*to), id);
  } catch (...) {
    if (fresh) edits_.erase(it);
    throw;
  }
  growth_ += static_cast<int>(to.has_value()) - static_cast<int>(edit.to.has_value());
  if (edit.to && edit.to != was) erase_arrival(*edit.to, id);
  edit.to = to;
  if (!to && !was) edits_.erase(it);
}

template <int D>
auto Pending<D>::arrival_near(const Point<D>& p, PointId id) const -> const Edit* {
  const Edit* nearest = nullptr;  // the least id, whatever the order in the table
  const auto [first, last] = arrivals_.equal_range(box_.fixed(p));
  for (auto it = first; it != last; ++it) {
    if (it->second == id || (nearest != nullptr && nearest->id < it->second)) continue;
    nearest = find(it->second);
  }
  return nearest;
}

template <int D>
auto Pending<D>::sorted() const -> std::vector<Edit> {
  struct Placed {
    bool stays;  // those that go are the first
    std::uint64_t order;
    PointId id;
    const Edit* edit;
    [[nodiscard]] auto key() const { return std::tie(stays, order, id); }
  };
  std::vector<Placed> placed;
  placed.reserve(edits_.size());
  for (const auto& [id, edit] : edits_) {
    if (edit.to == edit.was) continue;
    const std::uint64_t order = edit.to ? morton<D>(box_.fixed(*edit.to)) : 0;
    placed.push_back({edit.to.has_value(), order, id, &edit});
  }
  std::sort(placed.begin(), placed.end(),
            [](const Placed& a, const Placed& b) { return a.key() < b.key(); });
  std::vector<Edit> all;
  all.reserve(placed.size());
  for (const Placed& p : placed) all.push_back(*p.edit);
  return all;
}

// Tables that were large once are given back: to clear them again takes time in their size.
template <int D>
void Pending<D>::clear() noexcept {
  edits_ = decltype(edits_)();  // not {}, an empty list, for which a table keeps its size
  arrivals_ = decltype(arrivals_)();
  growth_ = 0;
}

template class Pending<2>;
#ifndef MESHER_PLANE_ONLY
template class Pending<3>;
#endif

}  // namespace mesher::detail
