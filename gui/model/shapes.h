#pragma once
#include "gui/model/model.h"

namespace reachlab::gui::model {

/// Solids of VRML's own measures about the origin, as triangles, added to a part. [m]
void addBox(ModelPart& part, const Vec3& size);
void addSphere(ModelPart& part, double radius);
/// Along y. `top` = 0 is a cone.
void addFrustum(ModelPart& part, double bottom, double top, double height, bool bottomClosed, bool topClosed, bool side);

}  // namespace reachlab::gui::model
