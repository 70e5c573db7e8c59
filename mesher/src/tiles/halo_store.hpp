// Where the runs for tiles are kept: in memory, or as files in a folder, which a later process can
// go on with.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tiles/halo_run.hpp"
#include "tiles/parcel.hpp"

namespace mesher::detail {

/// A point of the input, and how far apart points are there.
template <int D>
struct SpacedPoint {
  HaloPoint<D> point;
  double spacing = 0;
};

/// Functions about different tiles may be called at once, from several threads. What is returned
/// stays as it is when the tile gets something else.
template <int D>
class HaloStore {
 public:
  template <class T>
  using Kept = std::shared_ptr<const T>;
  using Points = std::vector<SpacedPoint<D>>;

  virtual ~HaloStore() = default;
  virtual void put_points(std::size_t tile, Points points) = 0;
  [[nodiscard]] virtual Kept<Points> points(std::size_t tile) const = 0;
  /// In place of an earlier one, if there is one.
  virtual void put_run(std::size_t tile, HaloRun<D> run) = 0;
  [[nodiscard]] virtual bool has_run(std::size_t tile) const = 0;
  /// Requires: there is a run.
  [[nodiscard]] virtual Kept<HaloVertices<D>> vertices(std::size_t tile) const = 0;
  [[nodiscard]] virtual Kept<HaloSimplices<D>> simplices(std::size_t tile) const = 0;
  [[nodiscard]] virtual Kept<HaloView<D>> view(std::size_t tile) const = 0;
  /// Looks at a tile by another, and who keeps them.
  struct Looks {
    std::shared_ptr<const void> kept;
    std::span<const HaloLook<D>> looks;
  };
  [[nodiscard]] virtual Looks looks(std::size_t by, std::size_t at) const = 0;
};

template <int D>
class MemoryStore final : public HaloStore<D> {
 public:
  using typename HaloStore<D>::Points;
  template <class T>
  using Kept = std::shared_ptr<const T>;

  explicit MemoryStore(std::size_t tiles) : points_(tiles), runs_(tiles) {}

  void put_points(std::size_t tile, Points points) override {
    points_[tile] = std::make_shared<const Points>(std::move(points));
  }
  [[nodiscard]] Kept<Points> points(std::size_t tile) const override { return points_[tile]; }
  void put_run(std::size_t tile, HaloRun<D> run) override {
    runs_[tile] = std::make_shared<const HaloRun<D>>(std::move(run));
  }
  [[nodiscard]] bool has_run(std::size_t tile) const override { return runs_[tile] != nullptr; }
  [[nodiscard]] Kept<HaloVertices<D>> vertices(std::size_t tile) const override {
    return {runs_[tile], &runs_[tile]->vertices};
  }
  [[nodiscard]] Kept<HaloSimplices<D>> simplices(std::size_t tile) const override {
    return {runs_[tile], &runs_[tile]->simplices};
  }
  [[nodiscard]] Kept<HaloView<D>> view(std::size_t tile) const override {
    return {runs_[tile], &runs_[tile]->view};
  }
  [[nodiscard]] typename HaloStore<D>::Looks looks(std::size_t by, std::size_t at) const override {
    return {runs_[by], those_of(at, runs_[by]->looks)};
  }

 private:
  std::vector<Kept<Points>> points_;
  std::vector<Kept<HaloRun<D>>> runs_;
};

/// Files in a folder. A file is complete or not there: it is written under another name. What a
/// file has that was cut off or changed is found out, and counts as not there.
template <int D>
class FolderStore final : public HaloStore<D> {
 public:
  using typename HaloStore<D>::Points;
  template <class T>
  using Kept = std::shared_ptr<const T>;

  /// `folder` is made, if it is not there. `job`: of what the tiles are; files of the same job are
  /// used. Throws: Error(cannot_write), also if the folder has files of another job.
  FolderStore(std::string folder, std::size_t tiles, std::uint64_t job);

  void put_points(std::size_t tile, Points points) override;
  [[nodiscard]] Kept<Points> points(std::size_t tile) const override;
  void put_run(std::size_t tile, HaloRun<D> run) override;
  [[nodiscard]] bool has_run(std::size_t tile) const override;
  [[nodiscard]] Kept<HaloVertices<D>> vertices(std::size_t tile) const override;
  [[nodiscard]] Kept<HaloSimplices<D>> simplices(std::size_t tile) const override;
  [[nodiscard]] Kept<HaloView<D>> view(std::size_t tile) const override;
  [[nodiscard]] typename HaloStore<D>::Looks looks(std::size_t by, std::size_t at) const override;
  /// The tiles' files are no longer needed; the folder goes, too, if nothing else is in it.
  void remove() noexcept;

 private:
  [[nodiscard]] std::string path(const char* what, std::size_t tile) const;
  void save(const std::string& path, const Packer& content) const;
  [[nodiscard]] std::optional<Bytes> load(const std::string& path) const;
  [[nodiscard]] Bytes must_load(const std::string& path) const;

  std::string folder_;
  std::size_t tiles_;
  std::uint64_t job_;
};

}  // namespace mesher::detail
