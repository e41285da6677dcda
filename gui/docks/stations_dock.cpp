#include "gui/docks/stations_dock.h"

#include <QHeaderView>
#include <QTableWidget>
#include <QVBoxLayout>

#include "gui/scene_plan/hand_colours.h"
#include "gui/widgets/inks.h"
#include "gui/widgets/named.h"
#include "gui/widgets/theme.h"
#include "gui/widgets/themes.h"

namespace reachlab::gui::docks {
namespace {

using Light = network::StationStatus::Light;

enum Column { kLight, kNumber, kName, kRoundTrip, kJitter, kLoss, kOvertaken, kOffset, kAge, kDevice, kSoftware, kColumns };
constexpr int kMostLines = 3;

// Told apart by shape and word; the colour only helps.
QString lightText(Light light) {
  switch (light) {
    case Light::Good: return "● good";
    case Light::Fair: return "▲ fair";
    case Light::Stop: return "■ stop";
    case Light::Absent: break;
  }
  return "○ absent";
}

QColor lightInk(Light light) {
  using namespace widgets;
  switch (light) {
    case Light::Good: return toQColor(themed(colours::kGreen));
    case Light::Fair: return toQColor(themed(colours::kTarget));
    case Light::Stop: return widgets::faultInk();
    case Light::Absent: break;
  }
  return toQColor(themed(colours::kFaintText));
}

QString milliseconds(double seconds, int digits) { return QString::number(1e3 * seconds, 'f', digits); }

}  // namespace

StationsDock::StationsDock(QWidget* parent) : Dock(tr("Stations"), "stationsDock", parent) {
  table_ = widgets::named<QTableWidget>("stations", 0, kColumns);
  table_->setHorizontalHeaderLabels({tr("link"), tr("no."), tr("name"), tr("round trip\n[ms]"), tr("jitter\n[ms]"), tr("lost\n[%]"),
                                     tr("overtaken\n[%]"), tr("clock\n[ms]"), tr("age\n[ms]"), tr("device"), tr("software")});
  const std::pair<Column, QString> tips[] = {
      {kRoundTrip, tr("round trip time; a trial is armed up to 120 ms")},
      {kJitter, tr("standard deviation of the round trip")},
      {kLoss, tr("share of its messages of the last two seconds that did not arrive; a trial is armed up to 20 %")},
      {kOvertaken, tr("share of samples of the last second that came after a newer sample and were not used")},
      {kOffset, tr("its clock minus the clock of this station")},
      {kAge, tr("time since its newest sample")}};
  for (const auto& [column, tip] : tips) table_->horizontalHeaderItem(column)->setToolTip(tip);
  table_->verticalHeader()->hide();
  table_->verticalHeader()->setDefaultSectionSize(25);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionMode(QAbstractItemView::NoSelection);
  table_->setFocusPolicy(Qt::NoFocus);
  table_->setShowGrid(false);
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setStretchLastSection(true);
  table_->setMinimumSize(240, 100);
  sentence_ = widgets::named<QLabel>("stationsSentence");
  told_ = new QLabel;
  for (QLabel* label : {sentence_, told_}) label->setWordWrap(true), label->setTextFormat(Qt::PlainText);
  auto* body = new QWidget;
  auto* layout = new QVBoxLayout(body);
  layout->setContentsMargins(8, 4, 8, 6);
  widgets::addAll(*layout, {table_, sentence_, told_});
  layout->setStretch(0, 1);
  setBody(body, false);
}

// Another experiment is another number of stations.
void StationsDock::display(const experiment::CompiledExperiment&, bool) { table_->setRowCount(0); }

void StationsDock::showStations(const network::StationSetup& here, Stage stage, const std::vector<network::StationStatus>& others) {
  network::StationStatus own;
  own.station = here.link.station;
  own.name = here.link.name, own.software = here.link.software, own.device = here.link.device, own.conductor = here.link.conductor;
  QStringList obstacles;
  const int rows = static_cast<int>(others.size()) + (own.station > 0 ? 1 : 0);
  if (table_->rowCount() != rows) {
    table_->setRowCount(rows);
    for (int row = 0; row < table_->rowCount(); ++row)
      for (int column = 0; column < kColumns; ++column) {
        auto* item = new QTableWidgetItem;
        item->setTextAlignment((column >= kRoundTrip && column <= kAge ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
        table_->setItem(row, column, item);
      }
  }
  int row = 0;
  bool placed = own.station == 0;  // it observes
  for (const network::StationStatus& other : others) {
    if (!placed && other.station > own.station) fill(row++, own, true), placed = true;
    fill(row++, other, false);
    for (const std::string& what : other.obstacles) obstacles << tr("station %1: %2").arg(other.station).arg(QString::fromStdString(what));
  }
  if (!placed) fill(row, own, true);
  const QString why = obstacles.join("; ");
  const QString next =
      stage == Stage::Observing ? tr("This window only observes. It records nothing, and the stations do not wait for it.") +
                                      (why.isEmpty() ? QString() : QLatin1Char(' ') + why + QLatin1Char('.'))
      : stage == Stage::Closed   ? tr("No run is open here. Press Space to open a run and to join the other stations.")
      : stage == Stage::UnderWay ? tr("A trial is under way.") + (why.isEmpty() ? QString() : QLatin1Char(' ') + why + QLatin1Char('.'))
      : !why.isEmpty()           ? tr("Not armed: %1.").arg(why)
      : stage == Stage::Arming   ? tr("Every link is good: the trial is being armed.")
      : own.conductor            ? tr("Every link is good. Space arms the next trial.")
                                 : tr("Every link is good. The conductor arms the next trial.");
  sentence_->setText(here.insecure ? next + QLatin1Char(' ') + tr("Nothing is encrypted.") : next);
}

void StationsDock::fill(int row, const network::StationStatus& station, bool isHere) {
  const auto set = [&](Column column, const QString& text) { table_->item(row, column)->setText(text); };
  const auto text = [](const std::string& from) { return QString::fromStdString(from); };
  const auto number = [&](const QString& value) { return station.heard ? value : QString(); };
  set(kLight, isHere ? QString() : lightText(station.light));
  table_->item(row, kLight)->setForeground(lightInk(station.light));
  set(kNumber, QString::number(station.station));
  const widgets::Colour& colour = scene::handColour(static_cast<std::size_t>(station.station - 1));
  table_->item(row, kNumber)->setForeground(widgets::toQColor(widgets::themed(colour)));
  QStringList roles;
  if (isHere) roles << tr("here");
  if (station.conductor) roles << tr("conductor");
  set(kName, roles.isEmpty() ? text(station.name) : QStringLiteral("%1 (%2)").arg(text(station.name), roles.join(", ")));
  const bool answers = station.roundTrip >= 0;  // nobody answers an observer
  set(kRoundTrip, answers ? number(milliseconds(station.roundTrip, 1)) : QString());
  set(kJitter, answers ? number(milliseconds(station.jitter, 1)) : QString());
  set(kLoss, number(QString::number(100 * station.loss, 'f', 1)));
  set(kOvertaken, number(QString::number(100 * station.overtaken, 'f', 1)));
  set(kOffset, answers ? number(milliseconds(station.offset, 3)) : QString());
  set(kAge, number(milliseconds(station.age, 0)));
  set(kDevice, text(station.device));
  set(kSoftware, text(station.software));
}

void StationsDock::tell(const QString& line) {
  lines_ << line;
  while (lines_.size() > kMostLines) lines_.removeFirst();
  told_->setText(lines_.join(QLatin1Char('\n')));
}

}  // namespace reachlab::gui::docks
