#pragma once
#include <map>
#include <string>
#include <vector>

#include "base/math/vec3.h"

namespace reachlab {
class FaultList;
struct JsonNode;
}  // namespace reachlab

namespace reachlab::experiment {

struct Experiment;

/// A place to look from.
struct Camera {
  Vec3 position{0, 0, 1}, focus, up{0, 1, 0};  // [m]
  double angle = 30;                           // [degrees] of view, vertical
  bool parallel = false;                       // what is farther is not smaller: as large as at the focus
  bool operator==(const Camera&) const = default;
};
struct NamedCamera : Camera {
  std::string name;
  bool operator==(const NamedCamera&) const = default;
};

/// How the scene is drawn. Stored in the experiment's file and no part of its value: it changes no number of a trial.
struct SceneLook {
  double surfaceOpacity = 0.42;                // [0, 1]
  std::string depthCue = "shadow";             // none | grid | shadow
  bool trace = false;                          // where the hand has been in the trial
  bool forceArrow = false;                     // of the coupling, at the hand
  std::string sceneFile;                       // VRML 2.0 or glTF; what is named `hand` or `mass1` in it moves with these
  std::map<std::string, std::string> colours;  // of a part, "#rrggbb"; others keep the theme's
  std::vector<NamedCamera> cameras;
  bool operator==(const SceneLook&) const = default;
};

/// Parts of the scene whose colour can be chosen.
const std::vector<std::string>& colouredParts();

/// Reads the content of the key `look`. Faults are added to the list.
SceneLook readLook(FaultList& faults, const JsonNode& node);
/// The look in the experiment's text. The default look if the text has no such key.
SceneLook lookOf(const Experiment& experiment);
/// The same experiment with this look in its text.
Experiment withLook(const Experiment& experiment, const SceneLook& look);

}  // namespace reachlab::experiment
