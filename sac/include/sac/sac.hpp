// The whole engine, except event_log.hpp, which explains why a call ran.
#pragma once

#include "sac/agenda.hpp"
#include "sac/engine.hpp"
#include "sac/iterate.hpp"
#include "sac/list/list.hpp"
#include "sac/list/operations.hpp"
#include "sac/list/reduce.hpp"
#include "sac/list/sequence.hpp"
#include "sac/list/sort.hpp"
#include "sac/map.hpp"
#include "sac/mod.hpp"
#include "sac/output.hpp"
#include "sac/plain.hpp"
#include "sac/presence.hpp"
#include "sac/query.hpp"
#include "sac/scope.hpp"
