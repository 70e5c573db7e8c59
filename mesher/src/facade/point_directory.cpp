// Announcements go to the processes that know of their points.
#include "facade/point_directory.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "sac/label.hpp"

namespace mesher::detail {

namespace {

// An announcement, and its number in its process.
template <int D>
struct Numbered {
  std::uint64_t number;
  typename PointDirectory<D>::Announcement edit;
};

// What a process refuses, and the number of its announcement.
struct Refused {
  std::uint64_t from, number;
  Error error;
};

template <int D>
void make(const typename PointDirectory<D>::Announcement& edit, const KnownPoints<D>& known,
          AnnouncedPoints<D>& edits) {
  using Kind = typename PointDirectory<D>::Kind;
  using Judged = typename AnnouncedPoints<D>::Judged;
  if (edit.kind == Kind::insert) edits.insert(known, edit.id, edit.p, Judged::at_the_end);
  if (edit.kind == Kind::remove) edits.remove(known, edit.id);
  if (edit.kind == Kind::move) edits.move(known, edit.id, edit.p);
}

// The first that any process has refused is thrown in all. Of all.
void require_none(const std::optional<Refused>& mine, Peers& peers) {
  std::uint64_t is_none = mine ? 0 : 1;
  peers.least({&is_none, 1});
  if (is_none != 0) return;
  Packer packed;
  together(peers, [&] {
    if (!mine) return;
    packed.put(mine->from), packed.put(mine->number);
    pack(mine->error, packed);
  });
  const std::vector<Bytes> told = peers.gather(packed.bytes());
  together(peers, [&] {
    std::optional<Refused> first;
    for (const Bytes& one : told) {
      if (one.empty()) continue;
      Unpacker rest(one);
      const auto from = rest.take<std::uint64_t>(), number = rest.take<std::uint64_t>();
      if (first && std::tie(first->from, first->number) < std::tie(from, number)) continue;
      first.emplace(Refused{from, number, unpack_error(rest)});
    }
    throw Error(first->error);
  });
}

}  // namespace

template <int D>
std::size_t PointDirectory<D>::process_of(PointId id) const noexcept {
  return sac::mix(static_cast<std::uint64_t>(id)) % peers_.size();
}

template <int D>
std::optional<Point<D>> PointDirectory<D>::place(PointId id) const {
  const auto it = places_.find(id);
  return it == places_.end() ? std::nullopt : std::optional(it->second);
}

template <int D>
std::vector<GraphPoint<D>> PointDirectory<D>::points() const {
  std::vector<GraphPoint<D>> all;
  all.reserve(places_.size());
  for (const auto& [id, p] : places_) all.push_back({id, p});
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return all;
}

template <int D>
void PointDirectory<D>::collect(const std::vector<Announcement>& announced,
                                AnnouncedPoints<D>& edits) {
  std::vector<Packer> out;
  together(peers_, [&] {
    out.resize(peers_.size());
    std::uint64_t number = 0;
    for (const Announcement& edit : announced) {
      out[process_of(edit.id)].put(Numbered<D>{number++, edit});
    }
  });
  std::vector<Bytes> come = told_each(out, peers_);
  std::optional<Refused> refused;
  together(peers_, [&] {
    std::uint64_t from = 0, number = 0;
    try {
      for (; from < come.size(); ++from) {
        for (Unpacker rest(come[from]); !rest.is_empty();) {
          const auto next = rest.take<Numbered<D>>();
          number = next.number;
          make<D>(next.edit, *this, edits);
        }
        come[from] = {};
      }
    } catch (const Error& error) {
      refused.emplace(Refused{from, number, error});
    }
  });
  require_none(refused, peers_);
}

template <int D>
void PointDirectory<D>::prepare(const Pending<D>& edits) {
  prepared_ = edits.sorted();
  coming_ = Places();
  for (const auto& edit : prepared_) {
    if (!edit.was) coming_.emplace(edit.id, *edit.to);
  }
  if (places_.bucket_count() * places_.max_load_factor() <
      static_cast<float>(places_.size() + coming_.size())) {
    places_.reserve(std::max(places_.size() + coming_.size(), 2 * places_.size()));
  }
}

template <int D>
void PointDirectory<D>::commit() noexcept {
  for (const auto& edit : prepared_) {
    if (edit.was && edit.to) places_.find(edit.id)->second = *edit.to;
    if (!edit.to) places_.erase(edit.id);
  }
  while (!coming_.empty()) places_.insert(coming_.extract(coming_.begin()));
  prepared_ = {}, coming_ = Places();
}

template <int D>
std::vector<GraphPoint<D>> points_of_all(const std::vector<GraphPoint<D>>& known, Peers& peers) {
  Packer mine;
  together(peers, [&] {
    for (const auto& p : known) mine.put(NamedPlace<D>{p.id, p.at});
  });
  const std::vector<Bytes> told = peers.gather(mine.bytes());
  std::vector<GraphPoint<D>> all;
  together(peers, [&] {
    for (const Bytes& some : told) {
      for (Unpacker rest(some); !rest.is_empty();) {
        const auto p = rest.take<NamedPlace<D>>();
        all.push_back({p.id, p.p});
      }
    }
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  });
  return all;
}

template <int D>
AllPoints<D>::AllPoints(std::vector<GraphPoint<D>> points, const MeshBox<D>& box)
    : box_(box), points_(std::move(points)) {
  by_cell_.reserve(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    by_cell_.emplace_back(box.fixed(points_[i].at), static_cast<std::uint32_t>(i));
  }
  std::sort(by_cell_.begin(), by_cell_.end());
}

template <int D>
std::optional<Point<D>> AllPoints<D>::place(PointId id) const {
  const auto it = std::lower_bound(points_.begin(), points_.end(), id,
                                   [](const auto& p, PointId of) { return p.id < of; });
  return it == points_.end() || it->id != id ? std::nullopt : std::optional(it->at);
}

template <int D>
auto AllPoints<D>::obstacle(const Point<D>& p) const
    -> std::optional<typename KnownPoints<D>::Named> {
  const std::pair<Fixed<D>, std::uint32_t> first(box_.fixed(p), 0);
  const auto it = std::lower_bound(by_cell_.begin(), by_cell_.end(), first);
  if (it == by_cell_.end() || it->first != first.first) return std::nullopt;
  const auto& there = points_[it->second];
  return typename KnownPoints<D>::Named{there.id, there.at};
}

#define MESHER_INSTANTIATE(D)                                                                   \
  template class PointDirectory<D>;                                                             \
  template std::vector<GraphPoint<D>> points_of_all(const std::vector<GraphPoint<D>>&, Peers&); \
  template class AllPoints<D>

MESHER_INSTANTIATE(2);
#ifndef MESHER_PLANE_ONLY
MESHER_INSTANTIATE(3);
#endif
#undef MESHER_INSTANTIATE

}  // namespace mesher::detail
