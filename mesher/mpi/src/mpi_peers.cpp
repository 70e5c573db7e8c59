// An exchange: sizes to all, room for what comes, then bytes between those who have any.
#include "mpi_peers.hpp"

#include <algorithm>
#include <new>
#include <utility>

namespace mesher::detail {

namespace {

constexpr std::uint64_t kPiece = std::uint64_t{1} << 30;  // sizes are of type int
constexpr int kTag = 1;

std::size_t pieces(std::uint64_t size) {
  return static_cast<std::size_t>((size + kPiece - 1) / kPiece);
}

// Calls act(offset, count) for each piece.
template <class Act>
void for_each_piece(std::uint64_t size, Act&& act) {
  for (std::uint64_t at = 0; at < size; at += kPiece) {
    act(static_cast<std::size_t>(at), static_cast<int>(std::min(kPiece, size - at)));
  }
}

}  // namespace

MpiPeers::MpiPeers(MPI_Comm communicator) {
  int size = 0, self = 0;
  MPI_Comm_size(communicator, &size);
  MPI_Comm_rank(communicator, &self);
  self_ = static_cast<std::size_t>(self);
  bool has_room = true;
  try {
    sizes_out_.resize(static_cast<std::size_t>(size));
    sizes_in_.resize(sizes_out_.size());
    make_room(sizes_out_.size());
  } catch (const std::bad_alloc&) {
    has_room = false;
  }
  MPI_Comm_dup(communicator, &communicator_);
  MPI_Comm_set_errhandler(communicator_, MPI_ERRORS_ARE_FATAL);
  std::uint64_t all_have = has_room ? 1 : 0;
  least({&all_have, 1});
  if (all_have != 0) return;
  MPI_Comm_free(&communicator_);
  throw std::bad_alloc();
}

MpiPeers::~MpiPeers() {
  int is_over = 0;
  MPI_Finalized(&is_over);
  if (is_over == 0 && communicator_ != MPI_COMM_NULL) MPI_Comm_free(&communicator_);
}

void MpiPeers::swap(MpiPeers& other) noexcept {
  Peers::swap(other);
  std::swap(communicator_, other.communicator_);
  std::swap(self_, other.self_);
  sizes_out_.swap(other.sizes_out_);
  sizes_in_.swap(other.sizes_in_);
  requests_.swap(other.requests_);
}

void MpiPeers::reduce(Values values, MPI_Op operation) noexcept {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_UINT64_T,
                operation, communicator_);
}

// For what comes; nobody sends before all have it. Throws: std::bad_alloc, in all or in none.
std::vector<Bytes> MpiPeers::room() {
  std::vector<Bytes> in;
  std::uint64_t is_there = 1;
  try {
    in.resize(size());
    std::size_t most = 0;
    for (std::size_t k = 0; k < size(); ++k) {
      in[k].resize(static_cast<std::size_t>(sizes_in_[k]));
      most += pieces(sizes_in_[k]) + pieces(sizes_out_[k]);
    }
    requests_.clear();
    requests_.reserve(most);
  } catch (const std::bad_alloc&) {
    is_there = 0;
  }
  least({&is_there, 1});
  if (is_there == 0) throw std::bad_alloc();
  return in;
}

std::vector<Bytes> MpiPeers::exchange(const Views& out) {
  for (std::size_t k = 0; k < size(); ++k) sizes_out_[k] = out[k].size();
  MPI_Alltoall(sizes_out_.data(), 1, MPI_UINT64_T, sizes_in_.data(), 1, MPI_UINT64_T,
               communicator_);
  std::vector<Bytes> in = room();
  for (std::size_t k = 0; k < size(); ++k) {
    if (k == self_) continue;
    for_each_piece(sizes_in_[k], [&](std::size_t at, int count) {
      MPI_Irecv(in[k].data() + at, count, MPI_BYTE, static_cast<int>(k), kTag, communicator_,
                &requests_.emplace_back());
    });
  }
  for (std::size_t k = 0; k < size(); ++k) {
    if (k == self_) continue;
    for_each_piece(sizes_out_[k], [&](std::size_t at, int count) {
      MPI_Isend(out[k].data() + at, count, MPI_BYTE, static_cast<int>(k), kTag, communicator_,
                &requests_.emplace_back());
    });
  }
  std::copy(out[self_].begin(), out[self_].end(), in[self_].begin());
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  return in;
}

}  // namespace mesher::detail
