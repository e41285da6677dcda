#pragma once
#include <QLabel>
#include <QStringList>
#include <QVariant>
#include <functional>
#include <vector>

namespace reachlab::gui::widgets {

/// The faults in the entries of a dock, one line each. Hidden if there is no fault. A watched field has `QString fault() const` and the
/// signal `checked()`, which it emits at every keystroke.
class FaultLabel : public QLabel {
 public:
  FaultLabel() {
    setProperty("role", "fault");
    setWordWrap(true);
    setTextFormat(Qt::PlainText);
    hide();
  }
  template <typename Field>
  void watch(Field* field) {
    fields_.push_back([field] { return field->fault(); });
    connect(field, &Field::checked, this, [this] { setFaults({}); });
  }
  /// Shows why the entries as a whole were refused, below the faults of the fields. The next keystroke removes these refusals.
  void setFaults(const QStringList& refusals) {
    QStringList lines;
    for (const auto& faultOfField : fields_) lines << faultOfField();
    lines << refusals;
    lines.removeAll({});
    setText(lines.join(QLatin1Char('\n')));
    setVisible(!lines.isEmpty());
  }

 private:
  std::vector<std::function<QString()>> fields_;
};

}  // namespace reachlab::gui::widgets
