#pragma once
#include <QString>

namespace reachlab::gui::scene {

/// Draws every definition of the catalogue as the window would, one PNG each in `folder`, and sheets of twelve (`sheet-1.png` …) to look
/// through. Draws every shipped experiment in the folder's `experiments`. Returns how many scenes were drawn. Throws ResourceError when the
/// folder cannot be written.
int drawPictures(const QString& folder);

}  // namespace reachlab::gui::scene
