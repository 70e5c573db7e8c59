// Every example as an App (app.hpp).
#pragma once

#include <tuple>

#include "graphs.hpp"
#include "lists.hpp"
#include "maps.hpp"
#include "text.hpp"

namespace apps {

using All =
    std::tuple<ArrayApp, MapApp, FilterApp, ReverseApp, SumApp, MinimumApp, QuicksortApp,
               MergesortApp, QuicksortElementsApp, MergesortElementsApp, QuickhullApp<spread_point>,
               DiameterApp<spread_point>, DistanceApp<1000>, ExpressionApp, ForestApp, SearchApp,
               ComponentsApp, CoreApp, SpanApp, BuildApp, SpellApp, StringApp,
               EditDistanceApp<10, 8>, SheetApp, ViewApp, RangesApp, DifferencesApp, LeadersApp>;

}  // namespace apps
