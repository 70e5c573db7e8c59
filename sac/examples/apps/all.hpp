// Every example as an App (app.hpp).
#pragma once

#include <tuple>

#include "graphs.hpp"
#include "lists.hpp"
#include "text.hpp"

namespace apps {

using All =
    std::tuple<ArrayApp, MapApp, FilterApp, ReverseApp, SumApp, MinimumApp, QuicksortApp,
               MergesortApp, QuicksortElementsApp, MergesortElementsApp, QuickhullApp<spread_point>,
               DiameterApp<spread_point>, DistanceApp<1000>, ExpressionApp, ForestApp, SearchApp,
               ComponentsApp, SpellApp, StringApp, SheetApp>;

}  // namespace apps
