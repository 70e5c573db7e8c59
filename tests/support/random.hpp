// Random numbers of the tests.
#pragma once

#include "../../sac/examples/apps/app.hpp"

namespace support {

using apps::Random;

}  // namespace support
