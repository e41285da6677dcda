#pragma once
#include <QString>

namespace reachlab::gui::scene {

/// The name that the OpenGL renderer gives itself: "llvmpipe (LLVM 15.0.6, 256 bits)". Asked once, in the window's thread.
const QString& rendererName();
/// Whether the processor draws.
bool drawsInSoftware();

}  // namespace reachlab::gui::scene
