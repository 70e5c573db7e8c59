// Voronoi cells to work on, lent: a cell keeps its columns' memory for the next one.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "geometry/voronoi_cell.hpp"

namespace mesher::detail {

class CellPool;

/// A cell that is its holder's own, until the loan ends.
class CellLoan {
 public:
  CellLoan(CellPool& pool, std::unique_ptr<VoronoiCell> cell) noexcept
      : pool_(pool), cell_(std::move(cell)) {}
  CellLoan(CellLoan&&) noexcept = default;
  CellLoan& operator=(CellLoan&&) = delete;
  ~CellLoan();

  [[nodiscard]] VoronoiCell& operator*() const noexcept { return *cell_; }
  [[nodiscard]] VoronoiCell* operator->() const noexcept { return cell_.get(); }

 private:
  CellPool& pool_;
  std::unique_ptr<VoronoiCell> cell_;
};

class CellPool {
 public:
  /// A cell in no particular state. Throws: std::bad_alloc.
  [[nodiscard]] CellLoan borrow() {
    if (free_.empty()) {
      free_.reserve(++made_);
      return {*this, std::make_unique<VoronoiCell>()};
    }
    std::unique_ptr<VoronoiCell> cell = std::move(free_.back());
    free_.pop_back();
    return {*this, std::move(cell)};
  }

 private:
  friend class CellLoan;
  std::size_t made_ = 0;
  std::vector<std::unique_ptr<VoronoiCell>> free_;  // with room for all that were made
};

inline CellLoan::~CellLoan() {
  if (cell_ != nullptr) pool_.free_.push_back(std::move(cell_));
}

}  // namespace mesher::detail
