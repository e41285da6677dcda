#pragma once
#include <vector>

#include "gui/docks/dock.h"
#include "gui/widgets/qt_names.h"
#include "network/station/station_run.h"

namespace reachlab::gui::docks {

/// The stations that move one object together: their names, the quality of each link, and the reason why no trial is armed.
class StationsDock : public Dock {
  Q_OBJECT
 public:
  explicit StationsDock(QWidget* parent = nullptr);
  /// State of this station's run. Closed: no run and no link. Arming: a trial waits for good links. UnderWay: a trial moves.
  enum class Stage { Closed, BetweenTrials, Arming, UnderWay, Observing };
  void showStations(const network::StationSetup& here, Stage stage, const std::vector<network::StationStatus>& others);
  /// Adds a message of the stations, the newest at the end.
  void tell(const QString& line);

 protected:
  void display(const experiment::CompiledExperiment& experiment, bool editable) override;

 private:
  void fill(int row, const network::StationStatus& station, bool isHere);

  QTableWidget* table_;
  QLabel *sentence_, *told_;
  QStringList lines_;
};

}  // namespace reachlab::gui::docks
