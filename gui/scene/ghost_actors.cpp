#include "gui/scene/ghost_actors.h"

#include <vtkActor.h>

namespace reachlab::gui::scene {

GhostActors::GhostActors(vtkRenderer& renderer, const ScenePlan& plan)
    : actors_(renderer), radius_(plan.massRadius), shift_(plan.massShift), colours_(plan.look.colours) {
  radius_.push_back(plan.handRadius);
}

void GhostActors::addGhost() {
  constexpr double kFaint = 0.22;
  std::vector<Actor>& balls = ghosts_.emplace_back();
  for (std::size_t i = 0; i < radius_.size(); ++i) {
    const bool hand = i + 1 == radius_.size();
    const widgets::Colour colour = hand ? colours_.hand : i + 2 == radius_.size() ? colours_.last : colours_.middle;
    balls.push_back(actors_.add(makeBall({colour, kFaint, 0.1})));
    balls.back()->SetScale(radius_[i]);
  }
}

void GhostActors::show(const std::vector<SceneFrame>& ghosts) {
  while (ghosts_.size() < ghosts.size()) addGhost();
  for (std::size_t g = 0; g < ghosts_.size(); ++g)
    for (std::size_t i = 0; i < radius_.size(); ++i) {
      const bool hand = i + 1 == radius_.size();
      const bool shown = g < ghosts.size() && (hand || i < ghosts[g].masses.size());
      ghosts_[g][i]->SetVisibility(shown);
      if (shown) place(*ghosts_[g][i], hand ? ownHand(ghosts[g]) : ghosts[g].masses[i] + shift_[i]);
    }
}

}  // namespace reachlab::gui::scene
