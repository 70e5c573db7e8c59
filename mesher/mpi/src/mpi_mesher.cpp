// The facade over JointMesher.
#include <optional>

#include "facade/joint_mesher.hpp"
#include "facade/joint_read.hpp"
#include "mesher/mpi.hpp"
#include "mesher/write.hpp"
#include "mpi_peers.hpp"
#include "write_msh_pieces.hpp"
#include "write_vtu_pieces.hpp"

namespace mesher {

namespace {

// Throws: Error(bad_option), in one process.
template <int D>
void require_level(const Options<D>& options) {
  int level = MPI_THREAD_SINGLE;
  MPI_Query_thread(&level);
  if (options.threads < 2 || level >= MPI_THREAD_FUNNELED) return;
  throw Error(ErrorCode::bad_option, "several threads of a rank need MPI_THREAD_FUNNELED");
}

}  // namespace

// In two steps, so that one process that has no memory for it can say so to the others.
template <int D>
struct MpiMesher<D>::Impl : std::optional<detail::JointMesher<D>> {};

template <int D>
MpiMesher<D>::MpiMesher(MPI_Comm communicator, const Options<D>& options) {
  detail::MpiPeers first(communicator);
  std::unique_ptr<detail::MpiPeers> peers;
  detail::together(first, [&] {
    require_level(options);
    impl_ = std::make_unique<Impl>();
    peers = std::make_unique<detail::MpiPeers>();
  });
  peers->swap(first);
  impl_->emplace(std::move(peers), options);
}
template <int D>
MpiMesher<D>::MpiMesher(MpiMesher&&) noexcept = default;
template <int D>
MpiMesher<D>& MpiMesher<D>::operator=(MpiMesher&&) noexcept = default;
template <int D>
MpiMesher<D>::~MpiMesher() = default;

template <int D>
void MpiMesher<D>::insert(PointId id, const Point<D>& point) {
  (*impl_)->insert(id, point);
}
template <int D>
void MpiMesher<D>::remove(PointId id) {
  (*impl_)->remove(id);
}
template <int D>
void MpiMesher<D>::move(PointId id, const Point<D>& point) {
  (*impl_)->move(id, point);
}
template <int D>
void MpiMesher<D>::insert_segment(LineId id, PointId from, PointId to) {
  (*impl_)->insert_segment(id, from, to);
}
template <int D>
void MpiMesher<D>::insert_polyline(LineId id, const std::vector<PointId>& points) {
  (*impl_)->insert_polyline(id, points);
}
template <int D>
void MpiMesher<D>::remove_line(LineId id) {
  (*impl_)->remove_line(id);
}
template <int D>
void MpiMesher<D>::insert_polygon(const Polygon& polygon) {
  (*impl_)->insert_polygon(polygon);
}
template <int D>
void MpiMesher<D>::remove_polygon(PolygonId id) {
  (*impl_)->remove_polygon(id);
}
template <int D>
void MpiMesher<D>::limit(const SizeLimits<D>& limits) {
  (*impl_)->limit(limits);
}
template <int D>
void MpiMesher<D>::limit(const Box<D>& box, const SizeLimits<D>& limits) {
  (*impl_)->limit(box, limits);
}
template <int D>
void MpiMesher<D>::discard_edits() noexcept {
  (*impl_)->discard_edits();
}

template <int D>
Change<D> MpiMesher<D>::update(const RunControl& control, Told told) {
  return (*impl_)->update(control, static_cast<detail::Told>(told));
}

template <int D>
Mesh<D> MpiMesher<D>::own_mesh() const {
  return (*impl_)->own_mesh();
}
template <int D>
Mesh<D> MpiMesher<D>::gather(int to) const {
  return (*impl_)->gather(static_cast<std::size_t>(to));
}
template <int D>
MeshStats MpiMesher<D>::stats() const {
  return (*impl_)->stats();
}

template <int D>
MpiCounts MpiMesher<D>::counts() const {
  const detail::JointCounts all = (*impl_)->counts();
  return {.rounds = all.exchanges.rounds,
          .horizons = all.exchanges.horizons,
          .messages = all.exchanges.messages_out,
          .bytes = all.exchanges.bytes_out,
          .most_bytes = all.exchanges.most_bytes_out,
          .seen = all.seen,
          .vertices = all.vertices,
          .least_vertices = all.least_vertices,
          .most_vertices = all.most_vertices};
}

template <int D>
std::size_t MpiMesher<D>::size() const noexcept {
  return (*impl_)->size();
}
template <int D>
std::vector<GraphPoint<D>> MpiMesher<D>::gather_points(int to) const {
  return (*impl_)->gather_points(static_cast<std::size_t>(to));
}
template <int D>
std::vector<Polyline> MpiMesher<D>::lines() const {
  return (*impl_)->lines();
}
template <int D>
std::vector<Polygon> MpiMesher<D>::polygons() const {
  return (*impl_)->polygons();
}
template <int D>
const Options<D>& MpiMesher<D>::options() const noexcept {
  return (*impl_)->options();
}
template <int D>
int MpiMesher<D>::rank() const noexcept {
  return static_cast<int>((*impl_)->peers().self());
}
template <int D>
int MpiMesher<D>::ranks() const noexcept {
  return static_cast<int>((*impl_)->peers().size());
}
template <int D>
std::string MpiMesher<D>::certificate() const {
  return (*impl_)->certificate();
}
template <int D>
void MpiMesher<D>::check_invariants() const {
  (*impl_)->check_invariants();
}

template <int D>
void write_mesh(const MpiMesher<D>& mesher, const std::string& path) {
  detail::Peers& peers = (*mesher.impl_)->peers();
  if (format_of(path) == ".pvtu") {
    detail::write_vtu_pieces<D>(
        peers, [&] { return mesher.own_mesh(); }, path);
    return;
  }
  const Mesh<D> whole = mesher.gather();
  detail::together(peers, [&] {
    if (peers.self() == 0) write_mesh(whole, path);
  });
}

template <int D>
void write_pieces(const MpiMesher<D>& mesher, const std::string& path) {
  detail::JointMesher<D>& joint = **mesher.impl_;
  const std::string format = format_of(path);
  if (format == ".pvtu") return write_mesh(mesher, path);
  if (format != ".msh") {
    throw Error(ErrorCode::unknown_format, "pieces are .pvtu or .msh", {path});
  }
  Mesh<D> own;
  detail::together(joint.peers(), [&] { own = mesher.own_mesh(); });
  detail::write_msh_pieces(joint.peers(), own, joint.numbers(own), path);
}

template <int D>
void write_partitions(const MpiMesher<D>& mesher, const std::string& path) {
  detail::JointMesher<D>& joint = **mesher.impl_;
  if (format_of(path) != ".msh") {
    throw Error(ErrorCode::unknown_format, "partitions are written to .msh", {path});
  }
  Mesh<D> own;
  detail::together(joint.peers(), [&] { own = mesher.own_mesh(); });
  detail::write_msh_partitions(joint.peers(), own, joint.numbers(own), path);
}

int dimension_of(MPI_Comm communicator, const std::string& path) {
  detail::MpiPeers peers(communicator);
  return detail::joint_dimension(path, peers);
}

template <int D>
GraphFile<D> read(MPI_Comm communicator, const std::string& path, const ReadOptions& options) {
  detail::MpiPeers peers(communicator);
  return detail::joint_read<D>(path, options, peers);
}

template <int D>
Error located(MPI_Comm communicator, const Error& error, const GraphFile<D>& share) {
  detail::MpiPeers peers(communicator);
  return detail::joint_located(error, share, peers);
}

template class MpiMesher<2>;
template class MpiMesher<3>;
template void write_mesh(const MpiMesher<2>&, const std::string&);
template void write_mesh(const MpiMesher<3>&, const std::string&);
template void write_pieces(const MpiMesher<2>&, const std::string&);
template void write_pieces(const MpiMesher<3>&, const std::string&);
template void write_partitions(const MpiMesher<2>&, const std::string&);
template void write_partitions(const MpiMesher<3>&, const std::string&);
template GraphFile<2> read(MPI_Comm, const std::string&, const ReadOptions&);
template GraphFile<3> read(MPI_Comm, const std::string&, const ReadOptions&);
template Error located(MPI_Comm, const Error&, const GraphFile<2>&);
template Error located(MPI_Comm, const Error&, const GraphFile<3>&);

}  // namespace mesher
