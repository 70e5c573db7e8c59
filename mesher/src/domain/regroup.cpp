#include "domain/regroup.hpp"

#include <algorithm>

#include "sets/make_set.hpp"

namespace mesher::detail {
namespace {

template <int D>
class Regroup {
 public:
  using Tile = TileOf<D>;
  using Tiles = TilesOf<D>;
  using Seams = SeamsOf<D>;

  Regroup(Tiles& tiles, Components& components, Marks& marks, const Seams& seams)
      : tiles_(tiles),
        components_(components),
        marks_(marks),
        seams_(seams),
        clusters_(tiles, seams),
        fragment_of_(clusters_.members().size(), kNone) {}

  Regrouped run() {
    take_removed();
    part();
    add_rests();
    unite();
    name_targets();
    assign();
    make_set(result_.touched);
    return std::move(result_);
  }

 private:
  void take_removed() {
    for (const Tile& t : seams_.removed) {
      Component& c = components_.edit(t.component);
      --c.size;
      c.exits -= t.exits();
      result_.touched.push_back(t.component);
    }
    for (const typename Seams::Exits& e : seams_.exits) {
      components_.edit(tiles_[e.survivor].component).exits += static_cast<std::uint32_t>(e.more);
    }
    for (const Member& m : clusters_.members()) result_.touched.push_back(m.component);
  }

  // --- Fragments -----------------------------------------------------------------------------

  struct Suspect {
    std::uint32_t component, cluster;
    friend auto operator<=>(const Suspect&, const Suspect&) = default;
  };

  // The clusters of each cut that has several.
  [[nodiscard]] std::vector<Suspect> suspects() const {
    std::vector<Suspect> all;
    const auto& bonds = seams_.bonds;
    for (std::size_t i = 0, end = 0; i < bonds.size(); i = end) {
      bool several = false;
      const std::uint32_t first = clusters_.of(bonds[i].survivor);
      for (end = i; end < bonds.size() && bonds[end].cut == bonds[i].cut; ++end) {
        several = several || clusters_.of(bonds[end].survivor) != first;
      }
      for (std::size_t k = i; several && k < end; ++k) {
        const Slot s = bonds[k].survivor;
        all.push_back({tiles_[s].component, clusters_.of(s)});
      }
    }
    make_set(all);
    return all;
  }

  void part() {
    const auto all = suspects();
    std::vector<std::uint32_t> starts;
    for (std::size_t i = 0; i < all.size();) {
      const std::uint32_t component = all[i].component;
      starts.clear();
      for (; i < all.size() && all[i].component == component; ++i) {
        starts.push_back(all[i].cluster);
      }
      part(component, starts);
    }
  }

  void part(std::uint32_t component, const std::vector<std::uint32_t>& starts) {
    Parting<D> parting(tiles_, clusters_, marks_, component, starts);
    parting.run();
    result_.visited += parting.visited();
    const auto base = static_cast<std::uint32_t>(fragments_.size());
    for (Fragment& f : parting.listed()) fragments_.push_back(std::move(f));
    const auto members = clusters_.members(component);
    const std::size_t offset = index_of(members.front());
    for (std::size_t i = 0; i < members.size(); ++i) {
      const std::uint32_t listed = parting.listed_with(members[i].slot);
      if (listed != kNone) fragment_of_[offset + i] = base + listed;
    }
  }

  // What is left of each component is a fragment too. Listed ones and members are both in the order
  // of components.
  void add_rests() {
    const auto members = clusters_.members();
    const std::size_t listed = fragments_.size();
    std::size_t f = 0;
    for (std::size_t i = 0; i < members.size();) {
      const std::uint32_t component = members[i].component;
      std::uint32_t size = components_[component].size;
      for (; f < listed && fragments_[f].component <= component; ++f) size -= fragments_[f].size;
      const auto rest = static_cast<std::uint32_t>(fragments_.size());
      fragments_.push_back({component, size, false, {}});
      for (; i < members.size() && members[i].component == component; ++i) {
        if (fragment_of_[i] == kNone) fragment_of_[i] = rest;
      }
    }
  }

  [[nodiscard]] std::size_t index_of(const Member& m) const {
    return static_cast<std::size_t>(&m - clusters_.members().data());
  }

  // --- Regions -------------------------------------------------------------------------------

  // Clusters come first, then fragments.
  void unite() {
    sets_ = UnionFind(clusters_.count() + fragments_.size());
    const auto members = clusters_.members();
    for (std::size_t i = 0; i < members.size(); ++i) {
      sets_.unite(members[i].cluster, clusters_.count() + fragment_of_[i]);
    }
  }

  [[nodiscard]] std::uint32_t set_of_fragment(std::uint32_t f) {
    return sets_.find(clusters_.count() + f);
  }

  // Of the fragments that are not listed the largest gives its number.
  void name_targets() {
    std::vector<std::uint32_t> best(clusters_.count() + fragments_.size(), kNone);
    for (std::uint32_t f = 0; f < fragments_.size(); ++f) {
      if (fragments_[f].listed) continue;
      std::uint32_t& b = best[set_of_fragment(f)];
      if (b == kNone || fragments_[b].size < fragments_[f].size) b = f;
    }
    target_.assign(best.size(), kNone);
    for (const Slot s : clusters_.nodes()) {
      const std::uint32_t set = sets_.find(clusters_.of(s));
      if (target_[set] != kNone) continue;
      const std::uint32_t b = best[set];
      target_[set] = b == kNone ? components_.create() : fragments_[b].component;
      components_.edit(target_[set]).any = s;
      result_.touched.push_back(target_[set]);
    }
  }

  void assign() {
    for (std::uint32_t f = 0; f < fragments_.size(); ++f) {
      const std::uint32_t target = target_[set_of_fragment(f)];
      if (fragments_[f].listed && target != fragments_[f].component) move_listed(f, target);
    }
    for (std::uint32_t f = 0; f < fragments_.size(); ++f) {
      const std::uint32_t target = target_[set_of_fragment(f)];
      if (!fragments_[f].listed && target != fragments_[f].component) move_rest(f, target);
    }
    for (const Slot s : seams_.added) {
      const std::uint32_t target = target_[sets_.find(clusters_.of(s))];
      tiles_.edit(s).component = target;
      components_.edit(target).size += 1;
      components_.edit(target).exits += tiles_[s].exits();
    }
  }

  // What moves, in triangles and exits.
  struct Weight {
    std::uint32_t size = 0, exits = 0;
  };

  void move_listed(std::uint32_t f, std::uint32_t target) {
    Weight weight;
    for (const Slot s : fragments_[f].tiles) move(s, target, weight);
    shift(weight, fragments_[f].component, target);
  }

  // A flood among its survivors from those of the frontier, through which all others are connected.
  void move_rest(std::uint32_t f, std::uint32_t target) {
    const std::uint32_t from = fragments_[f].component;
    const auto members = clusters_.members(from);
    const std::size_t offset = index_of(members.front());
    Weight weight;
    std::vector<Slot> reached;
    const auto take = [&](Slot s) {
      if (s == kNone || tiles_[s].component != from) return;
      move(s, target, weight);
      reached.push_back(s);
    };
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (fragment_of_[offset + i] == f) take(members[i].slot);
    }
    while (!reached.empty()) {
      const Slot s = reached.back();
      reached.pop_back();
      ++result_.visited;
      for (int i = 0; i <= D; ++i) take(tiles_[s].open_neighbour(i));
    }
    shift(weight, from, target);
  }

  void move(Slot s, std::uint32_t target, Weight& weight) {
    Tile& tile = tiles_.edit(s);
    result_.moved.push_back({s, tile.component});
    tile.component = target;
    ++weight.size;
    weight.exits += tile.exits();
  }
  void shift(const Weight& weight, std::uint32_t from, std::uint32_t target) {
    components_.edit(from).size -= weight.size;
    components_.edit(from).exits -= weight.exits;
    components_.edit(target).size += weight.size;
    components_.edit(target).exits += weight.exits;
  }

  Tiles& tiles_;
  Components& components_;
  Marks& marks_;
  const Seams& seams_;
  Clusters<D> clusters_;
  std::vector<Fragment> fragments_;
  std::vector<std::uint32_t> fragment_of_;  // one per member
  UnionFind sets_{0};
  std::vector<std::uint32_t> target_;  // one per set
  Regrouped result_;
};

}  // namespace

template <int D>
Regrouped regroup(TilesOf<D>& tiles, Components& components, Marks& marks,
                  const SeamsOf<D>& seams) {
  return Regroup<D>(tiles, components, marks, seams).run();
}
template Regrouped regroup(TilesOf<2>&, Components&, Marks&, const SeamsOf<2>&);
#ifndef MESHER_PLANE_ONLY
template Regrouped regroup(TilesOf<3>&, Components&, Marks&, const SeamsOf<3>&);
#endif

}  // namespace mesher::detail
