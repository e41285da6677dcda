#pragma once
#include <string_view>

#include "gui/model/model.h"

namespace reachlab::gui::model {

/// Reads a scene in VRML 2.0 (ISO/IEC 14772): groups, transforms, DEF and USE, boxes, balls, cylinders, cones and faces with a material.
/// Lights, views and scripts of the file are ignored. Prototypes and inlined files are refused. A node with a name of isMoving() is a part
/// of that name. It keeps the frame of its node without its shift, so that its origin follows the mass. Throws FaultError with position,
/// found text and allowed text.
Model readVrml(std::string_view text, const std::string& file, const Watch& watch = {});

}  // namespace reachlab::gui::model
