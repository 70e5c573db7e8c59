// Crowding in the plane.
#include "segments/crowding_impl.hpp"

namespace mesher::detail {

template class Crowding<sac::PlainScope>;
template class Crowding<sac::Scope>;

}  // namespace mesher::detail
