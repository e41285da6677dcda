#pragma once
#include <vector>

#include "gui/docks/dock.h"
#include "network/station/station_run.h"

class QLabel;
class QTableWidget;

namespace reachlab::gui::docks {

/// The stations that move one object together: who is there, how the link to each is, and why no trial is armed.
class StationsDock : public Dock {
  Q_OBJECT
 public:
  explicit StationsDock(QWidget* parent = nullptr);
  /// Of this station's run: none is open, and so no link either; a trial waits for the links to be good; one is under way.
  enum class Stage { Closed, BetweenTrials, Arming, UnderWay, Observing };
  void showStations(const network::StationSetup& here, Stage stage, const std::vector<network::StationStatus>& others);
  /// One line of what the stations tell, the newest at the end.
  void tell(const QString& line);
  /// What stands under the table.
  QString sentence() const;

 protected:
  void display(const experiment::CompiledExperiment& experiment, bool editable) override;

 private:
  void fill(int row, const network::StationStatus& station, bool isHere);

  QTableWidget* table_;
  QLabel *sentence_, *told_;
  QStringList lines_;
};

}  // namespace reachlab::gui::docks
