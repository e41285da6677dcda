#include "gui/docks/stations_dock.h"

#include <QHeaderView>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "gui/scene_plan/hand_colours.h"
#include "gui/widgets/named.h"
#include "gui/widgets/text_table.h"
#include "gui/widgets/theme.h"

namespace reachlab::gui::docks {
namespace {

using Light = network::StationStatus::Light;

enum Column { kLight, kNumber, kName, kRoundTrip, kJitter, kLoss, kOvertaken, kOffset, kAge };
constexpr int kMostLines = 3;

// Words and ink. Told apart by shape and word; the colour only helps.
std::pair<QString, QColor> lookOf(Light light) {
  using namespace widgets;
  switch (light) {
    case Light::Good: return {"● good", toQColor(themed(colours::kGreen))};
    case Light::Fair: return {"▲ fair", toQColor(themed(colours::kTarget))};
    case Light::Stop: return {"■ stop", faultInk()};
    case Light::Absent: break;
  }
  return {"○ absent", toQColor(themed(colours::kFaintText))};
}

QString milliseconds(double seconds, int digits) { return QString::number(1e3 * seconds, 'f', digits); }

}  // namespace

StationsDock::StationsDock(QWidget* parent) : Dock(tr("Stations"), "stationsDock", parent) {
  table_ = widgets::makeTextTable("stations",
                                  {tr("link"), tr("no."), tr("name"), tr("round trip\n[ms]"), tr("jitter\n[ms]"), tr("lost\n[%]"),
                                   tr("overtaken\n[%]"), tr("clock\n[ms]"), tr("age\n[ms]"), tr("device"), tr("software")},
                                  25);
  const std::pair<Column, QString> tips[] = {
      {kRoundTrip, tr("round trip time; a trial is armed up to 120 ms")},
      {kJitter, tr("standard deviation of the round trip")},
      {kLoss, tr("share of its messages of the last two seconds that did not arrive; a trial is armed up to 20 %")},
      {kOvertaken, tr("share of samples of the last second that came after a newer sample and were not used")},
      {kOffset, tr("its clock minus the clock of this station")},
      {kAge, tr("time since its newest sample")}};
  for (const auto& [column, tip] : tips) table_->horizontalHeaderItem(column)->setToolTip(tip);
  table_->setFocusPolicy(Qt::NoFocus);
  table_->horizontalHeader()->setStretchLastSection(true);
  table_->setMinimumSize(240, 100);
  sentence_ = widgets::named<QLabel>("stationsSentence");
  told_ = new QLabel;
  for (QLabel* label : {sentence_, told_}) label->setWordWrap(true), label->setTextFormat(Qt::PlainText);
  auto* body = new QWidget;
  auto* layout = new QVBoxLayout(body);
  layout->setContentsMargins(8, 4, 8, 6);
  widgets::addAll(*layout, {table_, sentence_, told_}, table_);
  setBody(body, false);
}

// Another experiment is another number of stations.
void StationsDock::display(const experiment::CompiledExperiment&, bool) { table_->setRowCount(0); }

void StationsDock::showStations(const network::StationSetup& here, Stage stage, const std::vector<network::StationStatus>& others) {
  network::StationStatus own;
  own.station = here.link.station;
  own.name = here.link.name, own.software = here.link.software, own.device = here.link.device, own.conductor = here.link.conductor;
  std::vector<network::StationStatus> all = others;
  if (own.station > 0) all.push_back(own);  // else it observes
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.station < b.station; });
  table_->setRowCount(static_cast<int>(all.size()));
  QStringList obstacles;
  for (std::size_t row = 0; row < all.size(); ++row) {
    const network::StationStatus& station = all[row];
    fill(static_cast<int>(row), station, station.station == own.station);
    for (const std::string& what : station.obstacles)
      obstacles << tr("station %1: %2").arg(station.station).arg(QString::fromStdString(what));
  }
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
  const auto text = [](const std::string& from) { return QString::fromStdString(from); };
  const auto number = [&](const QString& value) { return station.heard ? value : QString(); };
  const auto answer = [&](double seconds, int digits) {  // nobody answers an observer
    return station.roundTrip >= 0 ? number(milliseconds(seconds, digits)) : QString();
  };
  QStringList roles;
  if (isHere) roles << tr("here");
  if (station.conductor) roles << tr("conductor");
  const auto [light, ink] = lookOf(station.light);
  widgets::setTexts(*table_, row,
                    {isHere ? QString() : light, QString::number(station.station),
                     roles.isEmpty() ? text(station.name) : QStringLiteral("%1 (%2)").arg(text(station.name), roles.join(", ")),
                     answer(station.roundTrip, 1), answer(station.jitter, 1), number(QString::number(100 * station.loss, 'f', 1)),
                     number(QString::number(100 * station.overtaken, 'f', 1)), answer(station.offset, 3),
                     number(milliseconds(station.age, 0)), text(station.device), text(station.software)});
  for (int column = kRoundTrip; column <= kAge; ++column) table_->item(row, column)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  table_->item(row, kLight)->setForeground(ink);
  const widgets::Colour& colour = scene::handColour(static_cast<std::size_t>(station.station - 1));
  table_->item(row, kNumber)->setForeground(widgets::toQColor(widgets::themed(colour)));
}

void StationsDock::tell(const QString& line) {
  lines_ << line;
  while (lines_.size() > kMostLines) lines_.removeFirst();
  told_->setText(lines_.join(QLatin1Char('\n')));
}

}  // namespace reachlab::gui::docks
