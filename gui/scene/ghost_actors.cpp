#include "gui/scene/ghost_actors.h"

#include <vtkActor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "gui/scene/scene_actors.h"

namespace reachlab::gui::scene {
namespace {

using Actor = vtkSmartPointer<vtkActor>;
constexpr double kFaint = 0.22;

}  // namespace

struct GhostActors::Impl {
  vtkRenderer& renderer;
  std::vector<double> radius;  // of each mass, then of the hand
  std::vector<Vec3> shift;
  PartColours colours;
  std::vector<std::vector<Actor>> ghosts;  // balls of each: its masses, its hand

  void addGhost() {
    std::vector<Actor> balls;
    for (std::size_t i = 0; i < radius.size(); ++i) {
      const bool hand = i + 1 == radius.size();
      const widgets::Colour colour = hand ? colours.hand : i + 2 == radius.size() ? colours.last : colours.middle;
      Actor ball = makeBall({colour, kFaint, 0.1});
      ball->SetScale(radius[i]);
      ball->PickableOff();
      renderer.AddActor(ball);
      balls.push_back(ball);
    }
    ghosts.push_back(std::move(balls));
  }
};

GhostActors::GhostActors(vtkRenderer& renderer, const ScenePlan& plan)
    : impl_(new Impl{renderer, plan.massRadius, plan.massShift, plan.look.colours, {}}) {
  impl_->radius.push_back(plan.handRadius);
  impl_->shift.resize(plan.massRadius.size() + 1);
}

GhostActors::~GhostActors() {
  for (const auto& balls : impl_->ghosts)
    for (const Actor& ball : balls) impl_->renderer.RemoveActor(ball);
}

void GhostActors::show(const std::vector<SceneFrame>& ghosts) {
  while (impl_->ghosts.size() < ghosts.size()) impl_->addGhost();
  for (std::size_t g = 0; g < impl_->ghosts.size(); ++g) {
    const std::vector<Actor>& balls = impl_->ghosts[g];
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const bool hand = i + 1 == balls.size();
      const bool shown = g < ghosts.size() && (hand || i < ghosts[g].masses.size());
      balls[i]->SetVisibility(shown);
      if (!shown) continue;
      const Vec3 at = hand ? ownHand(ghosts[g]) : ghosts[g].masses[i] + impl_->shift[i];
      if (isFinite(at)) balls[i]->SetPosition(at.x, at.y, at.z);
    }
  }
}

}  // namespace reachlab::gui::scene
