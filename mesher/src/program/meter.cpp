// The error of a run that was asked to stop.
#include "program/meter.hpp"

namespace mesher::detail {

void fail_cancelled() { throw Error(ErrorCode::cancelled, "stopped before its end"); }

}  // namespace mesher::detail
