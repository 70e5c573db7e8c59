// The whole engine: include this.
#pragma once

#include "sac/agenda.hpp"
#include "sac/engine.hpp"
#include "sac/mod.hpp"
#include "sac/plain.hpp"
#include "sac/scope.hpp"
