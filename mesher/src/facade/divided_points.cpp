// What processes tell each other of their points.
#include "facade/divided_points.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <tuple>

#include "geometry/input_point.hpp"

namespace mesher::detail {

std::vector<Bytes> told_each(const std::vector<Packer>& out, Peers& peers) {
  Peers::Views views;
  together(peers, [&] {
    for (const Packer& parcel : out) views.push_back(parcel.bytes());
  });
  return peers.exchange(views);
}

template <int D>
std::vector<Point<D>> sample_of_all(const PointEdits<D>& share, std::size_t tiles, Peers& peers) {
  constexpr std::size_t kPerTile = 256;  // parts differ by a few percent
  Packer mine;
  together(peers, [&] {
    const std::size_t wanted = kPerTile * tiles / peers.size() + 1;
    const std::size_t step = std::max<std::size_t>(1, share.size() / wanted);
    std::vector<Point<D>> some;
    for (std::size_t i = 0; i < share.size(); i += step) {
      if (share[i].to) some.push_back(*share[i].to);
    }
    mine.put_all(some);
  });
  const std::vector<Bytes> all = peers.gather(mine.bytes());
  std::vector<Point<D>> sample;
  together(peers, [&] {
    for (const Bytes& one : all) {
      const auto some = Unpacker(one).take_all<Point<D>>();
      sample.insert(sample.end(), some.begin(), some.end());
    }
    std::sort(sample.begin(), sample.end());
  });
  return sample;
}

template <int D>
PointEdits<D> arrivals_here(const PointEdits<D>& share, const MeshBox<D>& box,
                            const TiledMesher<D>& tiles, Peers& peers) {
  std::vector<Packer> out;
  together(peers, [&] {
    out.resize(peers.size());
    for (const auto& edit : share) {
      if (edit.to) out[tiles.process_of(*edit.to)].put(NamedPlace<D>{edit.id, *edit.to});
    }
  });
  std::vector<Bytes> come = told_each(out, peers);
  PointEdits<D> here;
  together(peers, [&] {
    Pending<D> pending(box);
    for (Bytes& some : come) {
      for (Unpacker rest(some); !rest.is_empty();) {
        const auto point = rest.take<NamedPlace<D>>();
        pending.set(point.id, {}, point.p);
      }
      some = Bytes();
    }
    here = pending.sorted();
  });
  return here;
}

template <int D>
Pending<D> edits_of_all(const PointEdits<D>& share, const MeshBox<D>& box, Peers& peers) {
  Packer mine;
  together(peers, [&] { mine.put_all(share); });
  const std::vector<Bytes> all = peers.gather(mine.bytes());
  Pending<D> pending(box);
  together(peers, [&] {
    for (const Bytes& some : all) {
      using Edit = typename Pending<D>::Edit;
      for (const Edit& edit : Unpacker(some).take_all<Edit>()) {
        pending.set(edit.id, edit.was, edit.to);
      }
    }
  });
  return pending;
}

// --- Clashes ---------------------------------------------------------------------------------

template <int D>
void Clashes<D>::add(const NamedPlace<D>& comes, const NamedPlace<D>& other, bool other_stays) {
  const Fixed<D> cell = box_.fixed(comes.p);
  members_.push_back({cell, false, comes});
  members_.push_back({cell, other_stays, other});
}

// In each cell those that come are before the one that stays.
template <int D>
bool Clashes<D>::is_before(const Member& a, const Member& b) {
  const auto key = [](const Member& m) { return std::tuple(m.stays, morton<D>(m.cell), m.point); };
  return key(a) < key(b);
}

template <int D>
void Clashes<D>::require_none(Peers& peers) const {
  std::uint64_t is_none = members_.empty() ? 1 : 0;
  peers.least({&is_none, 1});
  if (is_none != 0) return;
  Packer mine;
  together(peers, [&] {  // of the first cell
    std::vector<Member> some;
    const auto first = std::min_element(members_.begin(), members_.end(), &is_before);
    std::copy_if(members_.begin(), members_.end(), std::back_inserter(some),
                 [&](const Member& m) { return m.cell == first->cell; });
    mine.put_all(some);
  });
  const std::vector<Bytes> told = peers.gather(mine.bytes());
  together(peers, [&] {
    std::vector<Member> all;
    for (const Bytes& one : told) {
      const auto some = Unpacker(one).take_all<Member>();
      all.insert(all.end(), some.begin(), some.end());
    }
    const Member first = *std::min_element(all.begin(), all.end(), &is_before);
    std::erase_if(
        all, [&](const Member& m) { return m.cell != first.cell || m.point.id == first.point.id; });
    const Member other = *std::min_element(all.begin(), all.end(), &is_before);
    fail_too_near(first.point.p, first.point.id, other.point.p, other.point.id);
  });
}

// --- Blocks ----------------------------------------------------------------------------------

template <int D>
BlockAround<D>::BlockAround(const Point<D>& p, int level, const MeshBox<D>& box)
    : mesh_box_(box), level_(level) {
  const Fixed<D> f = box.fixed(p);
  for (std::size_t i = 0; i < D; ++i) {
    cell_[i] = static_cast<std::int64_t>(f[i] >> (kLevels - level));
  }
}

template <int D>
bool BlockAround<D>::contains(const Point<D>& q) const {
  const BlockAround there(q, level_, mesh_box_);
  for (std::size_t i = 0; i < D; ++i) {
    if (std::abs(there.cell_[i] - cell_[i]) > 1) return false;
  }
  return true;
}

template <int D>
Box<D> BlockAround<D>::box() const {
  const double side = mesh_box_.cell_side(level_), more = 4 * mesh_box_.cell_side(kLevels);
  Box<D> box;
  for (std::size_t i = 0; i < D; ++i) {
    box.lo[i] = mesh_box_.lo[i] + static_cast<double>(cell_[i] - 1) * side - more;
    box.hi[i] = mesh_box_.lo[i] + static_cast<double>(cell_[i] + 2) * side + more;
  }
  return box;
}

#define MESHER_INSTANTIATE(D)                                                                 \
  template std::vector<Point<D>> sample_of_all<D>(const PointEdits<D>&, std::size_t, Peers&); \
  template PointEdits<D> arrivals_here<D>(const PointEdits<D>&, const MeshBox<D>&,            \
                                          const TiledMesher<D>&, Peers&);                     \
  template Pending<D> edits_of_all<D>(const PointEdits<D>&, const MeshBox<D>&, Peers&);       \
  template class Clashes<D>;                                                                  \
  template class BlockAround<D>

MESHER_INSTANTIATE(2);
#ifndef MESHER_PLANE_ONLY
MESHER_INSTANTIATE(3);
#endif
#undef MESHER_INSTANTIATE

}  // namespace mesher::detail
