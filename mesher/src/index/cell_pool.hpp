// Voronoi cells on loan for computations: a returned cell keeps the memory of its columns for the
// next use.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "cells/cell_of.hpp"

namespace mesher::detail {

template <int D>
class CellPool;

/// A cell that is its holder's own, until the loan ends.
template <int D>
class CellLoan {
 public:
  CellLoan(CellPool<D>& pool, std::unique_ptr<CellOf<D>> cell) noexcept
      : pool_(pool), cell_(std::move(cell)) {}
  CellLoan(CellLoan&&) noexcept = default;
  CellLoan& operator=(CellLoan&&) = delete;
  ~CellLoan();

  [[nodiscard]] CellOf<D>& operator*() const noexcept { return *cell_; }
  [[nodiscard]] CellOf<D>* operator->() const noexcept { return cell_.get(); }

 private:
  CellPool<D>& pool_;
  std::unique_ptr<CellOf<D>> cell_;
};

template <int D>
class CellPool {
 public:
  /// A cell in no particular state. Throws: std::bad_alloc.
  [[nodiscard]] CellLoan<D> borrow() {
    if (free_.empty()) {
      free_.reserve(++made_);
      return {*this, std::make_unique<CellOf<D>>()};
    }
    std::unique_ptr<CellOf<D>> cell = std::move(free_.back());
    free_.pop_back();
    return {*this, std::move(cell)};
  }

 private:
  friend class CellLoan<D>;
  std::size_t made_ = 0;
  std::vector<std::unique_ptr<CellOf<D>>> free_;  // with room for all that were made
};

template <int D>
CellLoan<D>::~CellLoan() {
  if (cell_ != nullptr) pool_.free_.push_back(std::move(cell_));
}

}  // namespace mesher::detail
