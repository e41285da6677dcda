#include "gui/widgets/shape_sliders.h"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QVBoxLayout>
#include <cmath>

#include "gui/widgets/unit_spin_box.h"

namespace reachlab::gui::widgets {
namespace {

constexpr int kSteps = 500;

bool isWhole(const constraints::ShapeParameter& p) {
  return p.unit == "1" && p.max - p.min >= 2 && p.min == std::floor(p.min) && p.max == std::floor(p.max) &&
         p.defaultValue == std::floor(p.defaultValue);
}

}  // namespace

QString plainName(const constraints::ShapeParameter& p) {
  QString name = QString::fromStdString(p.name);
  const QString suffix = QLatin1Char('_') + QString::fromStdString(p.unit);
  if (p.unit == "1" || !name.endsWith(suffix)) return name;
  name.chop(suffix.size());
  return name.replace(QLatin1Char('_'), QLatin1Char(' '));
}

ShapeSliders::ShapeSliders(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
}

void ShapeSliders::setParameters(const std::vector<constraints::ShapeParameter>& parameters, const std::map<std::string, double>& values) {
  rows_.clear();
  delete body_;
  body_ = new QWidget;
  layout()->addWidget(body_);
  form_ = new QFormLayout(body_);
  form_->setContentsMargins(0, 0, 0, 0);
  for (const constraints::ShapeParameter& p : parameters) {
    const auto given = values.find(p.name);
    addRow(p, given == values.end() ? p.defaultValue : given->second);
  }
}

void ShapeSliders::addRow(const constraints::ShapeParameter& p, double value) {
  auto* slider = new QSlider(Qt::Horizontal);
  slider->setObjectName(QStringLiteral("slider_") + QString::fromStdString(p.name));
  const bool whole = isWhole(p);
  const int steps = whole ? static_cast<int>(p.max - p.min) : kSteps;
  slider->setRange(0, steps);
  auto* box = new UnitSpinBox(p.min, p.max, p.unit == "1" ? QString() : QString::fromStdString(p.unit));
  box->setObjectName(QStringLiteral("value_") + QString::fromStdString(p.name));
  const auto toStep = [p, steps](double v) { return static_cast<int>(std::lround((v - p.min) / (p.max - p.min) * steps)); };
  box->show(value);
  slider->setValue(toStep(value));
  auto* line = new QHBoxLayout;
  line->addWidget(slider, 1);
  line->addWidget(box);
  auto* label = new QLabel(plainName(p));
  const QString meaning = QStringLiteral("%1: %2").arg(QString::fromStdString(p.name), QString::fromStdString(p.meaning));
  label->setToolTip(meaning);
  slider->setToolTip(meaning);
  form_->addRow(label, line);
  rows_.push_back({p, slider, box});
  connect(slider, &QSlider::valueChanged, this, [this, p, box, steps](int step) {
    // Three digits are as fine as a slider is.
    const double raw = p.min + (p.max - p.min) * step / steps;
    box->show(QString::number(raw, 'g', 3).toDouble());
    Q_EMIT moved();
  });
  connect(box, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this, slider, toStep](double v) {
    const QSignalBlocker quiet(slider);
    slider->setValue(toStep(v));
    Q_EMIT moved();
  });
}

std::map<std::string, double> ShapeSliders::values() const {
  std::map<std::string, double> values;
  for (const Row& row : rows_) values[row.parameter.name] = row.box->value();
  return values;
}

}  // namespace reachlab::gui::widgets
