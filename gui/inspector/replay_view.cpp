#include "gui/inspector/replay_view.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QIcon>
#include <QPainter>
#include <QSlider>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "gui/scene/scene_view.h"
#include "gui/widgets/named.h"
#include "gui/widgets/theme.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/scene_look.h"

namespace reachlab::gui::inspector {
namespace {

constexpr int kFrameMs = 33;
constexpr double kSpeeds[] = {0.1, 0.25, 0.5, 1, 2, 4};

enum class Sign { Back, Play, Pause, On };

// The style's own signs are black, as is what they stand on.
QIcon iconOf(Sign sign) {
  QPixmap picture(48, 48);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(widgets::toQColor(widgets::colours::kText));
  const auto triangle = [&](double tip, double base) {
    painter.drawPolygon(QPolygonF(QVector<QPointF>{{tip, 24}, {base, 8}, {base, 40}}));
  };
  switch (sign) {
    case Sign::Back: triangle(10, 34), painter.drawRect(QRectF(36, 8, 5, 32)); break;
    case Sign::Play: triangle(40, 12); break;
    case Sign::Pause: painter.drawRect(QRectF(12, 9, 9, 30)), painter.drawRect(QRectF(27, 9, 9, 30)); break;
    case Sign::On: triangle(38, 14), painter.drawRect(QRectF(7, 8, 5, 32)); break;
  }
  return QIcon(picture);
}

QToolButton* makeButton(const char* name, Sign sign, const QString& tip) {
  auto* button = widgets::tipped(widgets::named<QToolButton>(name), tip);
  button->setIcon(iconOf(sign));
  button->setAutoRaise(true);
  return button;
}

}  // namespace

ReplayView::ReplayView(QWidget* parent) : QWidget(parent) {
  auto* layout = widgets::filling<QVBoxLayout>(this, 2);
  view_ = new scene::SceneView;
  view_->overlay().setVisible(false);
  view_->setMinimumSize(220, 150);
  layout->addWidget(view_, 1);
  slider_ = widgets::named<QSlider>("replayTime", Qt::Horizontal);
  layout->addWidget(slider_);
  back_ = makeButton("replayBack", Sign::Back, tr("one row back (,)"));
  play_ = makeButton("replayPlay", Sign::Play, tr("play, pause (P)"));
  on_ = makeButton("replayOn", Sign::On, tr("one row on (.)"));
  play_->setCheckable(true);
  speed_ = widgets::named<QComboBox>("replaySpeed");
  for (const double speed : kSpeeds) speed_->addItem(QStringLiteral("%1 ×").arg(speed), speed);
  speed_->setCurrentIndex(3);
  loop_ = widgets::named<QCheckBox>("replayLoop", tr("loop"));
  ghostsShown_ = widgets::named<QCheckBox>("replayGhosts", tr("ghosts"));
  ghostsShown_->setToolTip(tr("shows the other chosen trials faintly, at the same time since their onset"));
  ghostsShown_->setChecked(true);
  told_ = new QLabel;
  told_->setProperty("role", "quiet");
  QHBoxLayout* row = widgets::rowOf({back_, play_, on_, speed_, loop_, ghostsShown_, nullptr, told_});
  row->setSpacing(3);
  layout->addLayout(row);
  timer_ = new QTimer(this);
  timer_->setInterval(kFrameMs);
  connect(timer_, &QTimer::timeout, this, &ReplayView::tick);
  connect(slider_, &QSlider::valueChanged, this, [this](int ms) { goTo(ms / 1000.0); });
  connect(play_, &QToolButton::toggled, this, &ReplayView::setPlaying);
  connect(back_, &QToolButton::clicked, this, [this] { step(-1); });
  connect(on_, &QToolButton::clicked, this, [this] { step(1); });
  connect(ghostsShown_, &QCheckBox::toggled, this, &ReplayView::draw);
  connect(&model_, &model::ModelReader::ready, this, &ReplayView::drawModel);
  connect(&model_, &model::ModelReader::failed, this, &ReplayView::said);
  setEnabled(false);
}

void ReplayView::show(const experiment::CompiledExperiment& experiment, const QString& folder, Track trial, std::vector<Track> ghosts) {
  const std::string& text = experiment.experiment().text;
  if (text != shownExperiment_ || !isEnabled()) {
    model_.begin(model::findSceneFile(experiment::lookOf(experiment.experiment()).sceneFile, folder));
    scene::ScenePlan plan = scene::planScene(experiment.experiment(), experiment.constraint());
    plan.model = model_.model();
    view_->setPlan(plan);
    shownExperiment_ = text;
  }
  trial_ = std::move(trial);
  ghosts_ = std::move(ghosts);
  setEnabled(!trial_.replay.empty());
  ghostsShown_->setEnabled(!ghosts_.empty());
  widgets::quietly(slider_)->setRange(static_cast<int>(std::floor(1000 * begin())), static_cast<int>(std::ceil(1000 * end())));
  goTo(std::clamp(time_, begin(), end()));
}

// It has been read: hand and masses take its shapes.
void ReplayView::drawModel() {
  if (!model_.model()) return;
  scene::ScenePlan plan = view_->plan();
  plan.model = model_.model();
  view_->setPlan(plan, false);
  draw();
}

void ReplayView::clear() {
  setPlaying(false);
  trial_ = {};
  ghosts_.clear();
  setEnabled(false);
  told_->clear();
}

void ReplayView::goTo(double time) {
  if (trial_.replay.empty()) return;
  time_ = std::clamp(time, begin(), end());
  widgets::quietly(slider_)->setValue(static_cast<int>(std::lround(1000 * time_)));
  draw();
  Q_EMIT timeChanged(time_);
}

void ReplayView::draw() {
  if (trial_.replay.empty()) return;
  std::vector<scene::SceneFrame> ghosts;
  if (ghostsShown_->isChecked())
    for (const Track& ghost : ghosts_) ghosts.push_back(ghost.replay.frameAt(time_ + ghost.zero));
  view_->setGhosts(ghosts);
  view_->showFrame(trial_.replay.frameAt(time_ + trial_.zero));
  told_->setText(tr("%1 s   %2 N").arg(time_, 0, 'f', 3).arg(trial_.replay.forceAt(time_ + trial_.zero), 0, 'f', 2));
}

bool ReplayView::playing() const { return timer_->isActive(); }

double ReplayView::speed() const { return speed_->currentData().toDouble(); }

void ReplayView::setPlaying(bool playing) {
  const bool can = playing && !trial_.replay.empty();
  if (can && time_ >= end() - 1e-6) time_ = begin();
  if (can) clock_.start(), timer_->start();
  else timer_->stop();
  widgets::quietly(play_)->setChecked(can);
  play_->setIcon(iconOf(can ? Sign::Pause : Sign::Play));
}

void ReplayView::tick() {
  const double next = time_ + speed() * static_cast<double>(clock_.restart()) / 1000;
  if (next < end()) return goTo(next);
  if (loop_->isChecked()) return goTo(begin());
  goTo(end());
  setPlaying(false);
}

void ReplayView::step(int rows) {
  setPlaying(false);
  goTo(trial_.replay.neighbour(time_ + trial_.zero, rows) - trial_.zero);
}

}  // namespace reachlab::gui::inspector
