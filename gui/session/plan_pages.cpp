#include "gui/session/plan_pages.h"

#include <utility>

#include "gui/widgets/fault_in.h"

namespace reachlab::gui::app {

PlanPages::PlanPages(SessionController& session, docks::SessionDock& dock, scene::SceneView& view)
    : QObject(&view), session_(session), dock_(dock), view_(view), page_(new plan::StartPage(view)) {
  connect(page_, &plan::StartPage::placeEdited, this, [this](const QString& subject, const QString& sessionLabel) {
    if (session_.run() != nullptr) return;  // a field that loses the focus because its page is hidden
    session::SessionRequest request = dock_.request();
    if (subject.toStdString() != request.place.subject) request.participant = {};
    request.place.subject = subject.toStdString();
    request.place.session = sessionLabel.toStdString();
    dock_.setRequest(request);
    refresh();
  });
}

bool PlanPages::resumes() const { return page_->isVisible() && page_->resumes(); }

void PlanPages::refresh() {
  const bool shown = session_.isPlan() && session_.run() == nullptr;
  view_.overlay().setVisible(!shown);  // two pages of words over one another are none
  if (!shown) {
    shown_.reset();
    return page_->hide();
  }
  const session::SessionRequest request = dock_.request();
  const session::Plan& plan = session_.programme().plan;
  if (const Shown now{request.place, request.day, plan.text}; std::exchange(shown_, now) == now) return;
  plan::StartPage::Shown what;
  what.plan = QString::fromStdString(plan.name);
  what.subject = QString::fromStdString(request.place.subject);
  what.session = QString::fromStdString(request.place.session);
  what.fault = widgets::faultIn([&] {
    what.progress = session::progressOf(request, session_.programme());
    for (const session::PlanBlock& block : plan.blocks)
      if (block.day != 0) what.day = session::sessionDay(request, plan);
  });
  page_->show(what);
}

void PlanPages::compose(QWidget* window, const QString& file) {
  if (!composer_) {
    composer_ = new plan::PlanComposer(window);
    connect(composer_, &plan::PlanComposer::used, this, &PlanPages::composed);
  }
  if (!mayBeLeft()) return composer_->raise();
  if (session_.isPlan()) {
    composer_->setPlan(session_.programme().plan, file);
  } else {
    session::Plan plan;
    plan.name = "session";
    plan.blocks.push_back(session_.programme().plan.blocks.front());
    if (!file.isEmpty()) plan.blocks.front().experiment = file.toStdString();
    plan.blocks.front().trials = 20;
    composer_->setPlan(plan, {});
  }
  composer_->show();
  composer_->raise();
}

}  // namespace reachlab::gui::app
