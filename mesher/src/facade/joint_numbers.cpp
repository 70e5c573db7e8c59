// Owners of vertices are asked for their numbers.
#include "facade/joint_numbers.hpp"

#include <algorithm>

#include "sets/make_set.hpp"

namespace mesher::detail {

namespace {

template <int D>
class JointCount {
 public:
  JointCount(const Mesh<D>& own, const TiledMesher<D>& tiles, Peers& peers)
      : own_(own),
        tiles_(tiles),
        peers_(peers),
        asked_(peers.size()),
        wanted_(peers.size()),
        parcels_(peers.size()),
        views_(peers.size()) {}

  // Steps of all processes.
  JointNumbers<D> run() {
    together(peers_, [&] { ask(); });
    const std::vector<Bytes> questions = exchange();
    together(peers_, [&] { note(questions); });
    const std::vector<Bytes> sizes = peers_.gather(sizes_.bytes());
    together(peers_, [&] { count(sizes), answer(); });
    const std::vector<Bytes> answers = exchange();
    together(peers_, [&] { take(answers); });
    return std::move(numbers_);
  }

 private:
  std::vector<Bytes> exchange() {
    for (std::size_t k = 0; k < views_.size(); ++k) views_[k] = parcels_[k].bytes();
    return peers_.exchange(views_);
  }

  void ask() {
    for (std::uint32_t i = 0; i < own_.vertices.size(); ++i) {
      asked_[tiles_.process_of(own_.vertices[i])].push_back(i);
    }
    for (std::size_t k = 0; k < asked_.size(); ++k) {
      std::vector<Point<D>> places;
      for (const std::uint32_t i : asked_[k]) places.push_back(own_.vertices[i]);
      parcels_[k].put_all(places);
    }
  }

  // What others want may be vertices of which no simplex is in this part.
  void note(const std::vector<Bytes>& questions) {
    std::vector<Point<D>>& owned = numbers_.owned;
    for (std::size_t k = 0; k < wanted_.size(); ++k) {
      wanted_[k] = Unpacker(questions[k]).template take_all<Point<D>>();
      owned.insert(owned.end(), wanted_[k].begin(), wanted_[k].end());
    }
    make_set(owned);
    sizes_.put(std::uint64_t{owned.size()});
    sizes_.put(std::uint64_t{own_.simplices.size()});
  }

  void count(const std::vector<Bytes>& sizes) {
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      Unpacker of(sizes[k]);
      const auto vertices = of.take<std::uint64_t>(), simplices = of.take<std::uint64_t>();
      if (k < peers_.self()) numbers_.first_owned += vertices, numbers_.first_simplex += simplices;
      numbers_.all_vertices += vertices, numbers_.all_simplices += simplices;
    }
  }

  void answer() {
    const std::vector<Point<D>>& owned = numbers_.owned;
    for (std::size_t k = 0; k < wanted_.size(); ++k) {
      std::vector<std::uint64_t> answers;
      for (const Point<D>& p : wanted_[k]) {
        const auto at = std::lower_bound(owned.begin(), owned.end(), p);
        answers.push_back(numbers_.first_owned + static_cast<std::uint64_t>(at - owned.begin()));
      }
      parcels_[k].clear();
      parcels_[k].put_all(answers);
    }
  }

  void take(const std::vector<Bytes>& told) {
    numbers_.vertices.resize(own_.vertices.size());
    for (std::size_t k = 0; k < told.size(); ++k) {
      const auto answers = Unpacker(told[k]).template take_all<std::uint64_t>();
      for (std::size_t i = 0; i < answers.size(); ++i) numbers_.vertices[asked_[k][i]] = answers[i];
    }
  }

  const Mesh<D>& own_;
  const TiledMesher<D>& tiles_;
  Peers& peers_;
  std::vector<std::vector<std::uint32_t>> asked_;  // by process: vertices of the part
  std::vector<std::vector<Point<D>>> wanted_;      // by process: of which numbers are asked for
  std::vector<Packer> parcels_;
  Peers::Views views_;
  Packer sizes_;
  JointNumbers<D> numbers_;
};

}  // namespace

template <int D>
JointNumbers<D> joint_numbers(const Mesh<D>& own, const TiledMesher<D>& tiles, Peers& peers) {
  std::optional<JointCount<D>> count;
  together(peers, [&] { count.emplace(own, tiles, peers); });
  return count->run();
}

template JointNumbers<2> joint_numbers(const Mesh<2>&, const TiledMesher<2>&, Peers&);
#ifndef MESHER_PLANE_ONLY
template JointNumbers<3> joint_numbers(const Mesh<3>&, const TiledMesher<3>&, Peers&);
#endif

}  // namespace mesher::detail
