#pragma once
#include "gui/model/model.h"
#include "gui/model/transform.h"

namespace reachlab::gui::model {

/// Solids of VRML's own measures, as triangles, added to a part in a frame. [m]
void addBox(ModelPart& part, const Transform& frame, const Vec3& size);
void addSphere(ModelPart& part, const Transform& frame, double radius);
/// Along y, its middle in the origin. `top` = 0 is a cone.
void addFrustum(ModelPart& part, const Transform& frame, double bottom, double top, double height, bool bottomClosed, bool topClosed,
                bool side);

}  // namespace reachlab::gui::model
