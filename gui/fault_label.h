#pragma once
#include <QLabel>
#include <QStringList>
#include <QVariant>

namespace reachlab {

/// What is wrong with the entries of a dock, a line each; hidden while nothing is.
class FaultLabel : public QLabel {
 public:
  FaultLabel() {
    setProperty("role", "fault");
    setWordWrap(true);
    hide();
  }
  void setFaults(const QStringList& faults) {
    setText(faults.join(QLatin1Char('\n')));
    setVisible(!faults.isEmpty());
  }
};

}  // namespace reachlab
