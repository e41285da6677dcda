#pragma once
#include <QLabel>
#include <QStringList>
#include <QVariant>
#include <functional>
#include <vector>

namespace reachlab::gui::widgets {

/// What is wrong with the entries of a dock, a line each; hidden while nothing is. A watched field has `QString fault() const` and the signal
/// `checked()`, which it emits whenever it is typed in.
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
  /// Why the entries as a whole were refused; stands below the fields' own until the next is typed.
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
