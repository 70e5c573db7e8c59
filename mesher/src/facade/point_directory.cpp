// Announcements go to the processes that know of their points.
#include "facade/point_directory.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "facade/make_room.hpp"
#include "sac/label.hpp"

namespace mesher::detail {

namespace {

// An announcement, and its number in its process.
template <int D>
struct Numbered {
  std::uint64_t number;
  typename PointDirectory<D>::Announcement edit;
};

}  // namespace

template <int D>
void PointDirectory<D>::Announcement::make(const KnownPoints<D>& known,
                                           AnnouncedPoints<D>& edits) const {
  using Judged = typename AnnouncedPoints<D>::Judged;
  if (kind == Kind::insert) edits.insert(known, id, p, Judged::at_the_end);
  if (kind == Kind::remove) edits.remove(known, id);
  if (kind == Kind::move) edits.move(known, id, p);
}

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
  using Number = std::array<std::uint64_t, 2>;  // of an announcement: its process, and there
  std::optional<std::pair<Number, Error>> refused;
  together(peers_, [&] {
    std::uint64_t from = 0, number = 0;
    try {
      for (; from < come.size(); ++from) {
        for (Unpacker rest(come[from]); !rest.is_empty();) {
          const auto next = rest.take<Numbered<D>>();
          number = next.number;
          next.edit.make(*this, edits);
        }
        come[from] = Bytes();
      }
    } catch (const Error& error) {
      refused.emplace(Number{from, number}, error);
    }
  });
  require_none(peers_, refused);
}

template <int D>
void PointDirectory<D>::prepare(const Pending<D>& edits) {
  prepared_ = edits.sorted();
  coming_ = Places();
  for (const auto& edit : prepared_) {
    if (!edit.was) coming_.emplace(edit.id, *edit.to);
  }
  make_room_for(places_, coming_);
}

template <int D>
void PointDirectory<D>::commit() noexcept {
  for (const auto& edit : prepared_) {
    if (edit.was && edit.to) places_.find(edit.id)->second = *edit.to;
    if (!edit.to) places_.erase(edit.id);
  }
  places_.merge(coming_);
  prepared_ = std::vector<typename Pending<D>::Edit>(), coming_ = Places();
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

template class PointDirectory<2>;
template class AllPoints<2>;
#ifndef MESHER_PLANE_ONLY
template class PointDirectory<3>;
template class AllPoints<3>;
#endif

}  // namespace mesher::detail
