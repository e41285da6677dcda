#pragma once
#include <string>

#include "gui/scene_plan/scene_plan.h"

namespace reachlab::gui::scene {

/// The colour of the part that an experiment's `look` calls by this name. Null for an unknown name.
widgets::Colour* partNamed(PartColours& colours, const std::string& name);

}  // namespace reachlab::gui::scene
