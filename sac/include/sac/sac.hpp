// The whole engine: include this.
#pragma once

#include "sac/agenda.hpp"
#include "sac/engine.hpp"
#include "sac/list.hpp"
#include "sac/list_operations.hpp"
#include "sac/list_reduce.hpp"
#include "sac/list_sort.hpp"
#include "sac/mod.hpp"
#include "sac/plain.hpp"
#include "sac/scope.hpp"
#include "sac/sequence.hpp"
