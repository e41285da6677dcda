#include "gui/app/menu_entries.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QSlider>
#include <QWidgetAction>

#include "gui/widgets/named.h"

namespace reachlab::gui::app {

QAction* addExperimentSwitch(MainWindow& window, QMenu& menu, const QString& text, const QString& name, const std::function<bool()>& isOn,
                             const std::function<void(bool)>& set) {
  QAction* action = addSwitch(window, menu, text, set);
  action->setObjectName(name);
  const auto show = [&window, action, isOn] {
    action->setChecked(isOn());
    action->setEnabled(!window.session().isPlan());
  };
  show();
  QObject::connect(&menu, &QMenu::aboutToShow, action, show);
  return action;
}

QSlider* addSlider(QMenu& menu, const QString& title, const char* name, int width) {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  auto* slider = widgets::named<QSlider>(name, Qt::Horizontal);
  slider->setRange(0, 100);
  slider->setMinimumWidth(width);
  widgets::addAll(*layout, {new QLabel(title), slider});
  auto* action = new QWidgetAction(&menu);
  action->setDefaultWidget(row);
  menu.addAction(action);
  return slider;
}

}  // namespace reachlab::gui::app
