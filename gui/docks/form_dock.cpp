#include "gui/docks/form_dock.h"

#include <QFormLayout>

#include "gui/widgets/named.h"

namespace reachlab::gui::docks {

FormDock::FormDock(const QString& title, const QString& name, QWidget* parent)
    : Dock(title, name, parent), form_(new QFormLayout(new QWidget(this))) {}

widgets::UnitSpinBox* FormDock::addNumber(const NumberRow& row, double& entry) {
  auto* box = new widgets::UnitSpinBox(row.low, row.high, row.unit);
  form_->addRow(row.label, box);
  bind(box, row.name, row.tip, entry);
  return box;
}

void FormDock::bind(widgets::UnitSpinBox* box, const QString& name, const QString& tip, double& entry) {
  box->setName(name);
  box->setToolTip(tip);
  faults()->watch(box);
  numbers_.emplace_back(box, &entry);
  connect(box, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this, &entry](double value) {
    entry = value;
    tell();
  });
}

widgets::NumberListEdit* FormDock::addList(const QString& label, const char* name, const QString& tip, std::vector<double>& entry,
                                           std::function<void()> follow) {
  auto* list = widgets::tipped(widgets::named<widgets::NumberListEdit>(name), tip);
  form_->addRow(label, list);
  faults()->watch(list);
  lists_.emplace_back(list, &entry);
  connect(list, &widgets::NumberListEdit::numbersEdited, this, [this, list, &entry, follow = std::move(follow)] {
    entry = *list->numbers();
    follow();
    tell();
  });
  return list;
}

void FormDock::endForm() {
  form_->addRow(faults());
  setBody(form_->parentWidget());
}

void FormDock::display(const experiment::CompiledExperiment& experiment, bool editable) {
  body()->setEnabled(editable);
  fill(experiment);
  for (const auto& [list, entry] : lists_) list->setNumbers(*entry);
  for (const auto& [box, entry] : numbers_) box->show(*entry);
}

}  // namespace reachlab::gui::docks
