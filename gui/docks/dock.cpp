#include "gui/docks/dock.h"

#include <QEvent>
#include <QScrollArea>
#include <QScrollBar>

namespace reachlab::gui::docks {
namespace {

// As wide as what it holds needs, and not higher than that; scrolls up and down only.
class Scroll : public QScrollArea {
 public:
  explicit Scroll(QWidget* body) {
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
    setFocusPolicy(Qt::NoFocus);  // the Tab key goes to what can be entered
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setWidget(body);
    body->installEventFilter(this);
    fit();
  }
  QSize sizeHint() const override { return widget()->sizeHint() + QSize(verticalScrollBar()->sizeHint().width(), 2); }
  QSize minimumSizeHint() const override { return {minimumWidth(), 70}; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::LayoutRequest) fit();
    return QScrollArea::eventFilter(watched, event);
  }

 private:
  void fit() { setMinimumWidth(widget()->minimumSizeHint().width() + verticalScrollBar()->sizeHint().width()); }
};

}  // namespace

Dock::Dock(const QString& title, const QString& name, QWidget* parent) : QDockWidget(title, parent), faults_(new widgets::FaultLabel) {
  setObjectName(name);
  faults_->setObjectName(QString(name).replace(QLatin1String("Dock"), QLatin1String("Faults")));
  faults_->setParent(this);  // until the dock gives it a place
  faults_->hide();
}

void Dock::setBody(QWidget* body, bool scrolls) {
  body_ = body;
  setWidget(scrolls ? new Scroll(body) : body);
}

void Dock::showExperiment(const experiment::CompiledExperiment& experiment, bool editable) {
  shown_ = experiment.experiment();
  display(experiment, editable);
  showEntryFaults();  // a refusal was that of an experiment that is no longer shown
}

void Dock::showEntryFaults() { faults_->setFaults({}); }

void Dock::showFaults(const QStringList& faults) { faults_->setFaults(faults); }

}  // namespace reachlab::gui::docks
