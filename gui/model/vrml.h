#pragma once
#include <string_view>

#include "gui/model/model.h"
#include "gui/model/watch.h"

namespace reachlab::gui::model {

/// Reads a scene in VRML 2.0 (ISO/IEC 14772): groups, transforms, DEF and USE, boxes, balls, cylinders, cones and faces with a material.
/// Lights, views and scripts of the file are passed over; prototypes and files inside the file are refused. What a name of isMoving()
/// defines is a part of that name, in the frame of its own node without its shift: its origin goes where the mass is.
/// Throws FaultError: where in the file, what is there, what may be.
Model readVrml(std::string_view text, const std::string& file, const Watch& watch = {});

}  // namespace reachlab::gui::model
