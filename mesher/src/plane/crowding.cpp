// Crowding in the plane.
#include "plane/crowding_impl.hpp"

namespace mesher::detail {

template class Crowding<sac::PlainScope>;
template class Crowding<sac::Scope>;

}  // namespace mesher::detail
