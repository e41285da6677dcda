#pragma once
#include <QString>

namespace reachlab::gui::scene {

/// Who draws what OpenGL is told, as it says itself: "llvmpipe (LLVM 15.0.6, 256 bits)". Asked once; the GUI's thread.
const QString& rendererName();
/// The processor does.
bool drawsInSoftware();

}  // namespace reachlab::gui::scene
