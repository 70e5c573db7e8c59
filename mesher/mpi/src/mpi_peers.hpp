// The ranks of a communicator, as processes that have tiles of one mesh.
#pragma once

#include <mpi.h>

#include <vector>

#include "tiles/peers.hpp"

namespace mesher::detail {

class MpiPeers final : public Peers {
 public:
  /// Of all ranks of `communicator`, which is duplicated: messages of others are not met. An error
  /// of MPI ends all ranks. Requires: MPI is initialized.
  explicit MpiPeers(MPI_Comm communicator);
  /// Of no ranks.
  MpiPeers() = default;
  MpiPeers(const MpiPeers&) = delete;
  MpiPeers& operator=(const MpiPeers&) = delete;
  /// Of all ranks, before MPI_Finalize.
  ~MpiPeers() override;
  void swap(MpiPeers& other) noexcept;

  [[nodiscard]] std::size_t size() const noexcept override { return sizes_out_.size(); }
  [[nodiscard]] std::size_t self() const noexcept override { return self_; }
  void least(Values values) noexcept override { reduce(values, MPI_MIN); }
  void sum(Values values) noexcept override { reduce(values, MPI_SUM); }
  [[nodiscard]] std::vector<Bytes> exchange(const Views& out) override;

 private:
  void reduce(Values values, MPI_Op operation) noexcept;
  [[nodiscard]] std::vector<Bytes> room();

  MPI_Comm communicator_ = MPI_COMM_NULL;
  std::size_t self_ = 0;
  std::vector<std::uint64_t> sizes_out_, sizes_in_;  // by rank, in an exchange
  std::vector<MPI_Request> requests_;
};

}  // namespace mesher::detail
