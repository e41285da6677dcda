#pragma once
#include "sim/predict/least_effort.h"
#include "sim/predict/panel_series.h"

namespace reachlab::predict {

/// The movement from rest under a control that is known by its derivatives [block][term] in the panels' middles, counted from the
/// end of the movement backwards, as PanelSeries::makeControl() gives them: `terms` coefficients of every position, and by how much
/// the end misses the target.
LeastEffort followControl(const LineSystem<double>& system, const PanelGrid& grid, const PanelStep<double>& step, int terms,
                          const std::vector<Pack>& control);

}  // namespace reachlab::predict
