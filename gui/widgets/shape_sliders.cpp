#include "gui/widgets/shape_sliders.h"

#include <QFormLayout>
#include <QSlider>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <utility>

#include "gui/widgets/named.h"

namespace reachlab::gui::widgets {
namespace {

constexpr int kSteps = 500;
constexpr double kMostTyped = 1e6;

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

ShapeSliders::ShapeSliders(QWidget* parent) : QWidget(parent) { filling<QVBoxLayout>(this); }

void ShapeSliders::setParameters(const std::vector<constraints::ShapeParameter>& parameters, const std::map<std::string, double>& values) {
  const auto valueOf = [&](const constraints::ShapeParameter& p) {
    const auto given = values.find(p.name);
    return given == values.end() ? p.defaultValue : given->second;
  };
  if (isShown(parameters)) {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      rows_[i].parameter = parameters[i];
      rows_[i].box->show(valueOf(parameters[i]));
      fit(rows_[i]);
    }
    return;
  }
  rows_.clear();
  delete body_;
  body_ = new QWidget;
  layout()->addWidget(body_);
  form_ = filling<QFormLayout>(body_);
  for (const constraints::ShapeParameter& p : parameters) addRow(p, valueOf(p));
}

bool ShapeSliders::isShown(const std::vector<constraints::ShapeParameter>& parameters) const {
  return !rows_.empty() && std::equal(rows_.begin(), rows_.end(), parameters.begin(), parameters.end(),
                                      [](const Row& row, const constraints::ShapeParameter& p) {
                                        const constraints::ShapeParameter& shown = row.parameter;
                                        return shown.name == p.name && shown.meaning == p.meaning &&
                                               (row.low != nullptr || (shown.min == p.min && shown.max == p.max));
                                      });
}

void ShapeSliders::addRow(const constraints::ShapeParameter& p, double value) {
  const bool typed = p.meaning == "typed";
  auto* slider = new QSlider(Qt::Horizontal);
  slider->setObjectName("slider_" + QString::fromStdString(p.name));
  const double low = typed ? -kMostTyped : p.min, high = typed ? kMostTyped : p.max;
  auto* box = new UnitSpinBox(low, high, p.unit == "1" ? QString() : QString::fromStdString(p.unit));
  box->setObjectName("value_" + QString::fromStdString(p.name));
  box->setName(plainName(p));
  box->show(value);
  connect(box, &UnitSpinBox::checked, this, &ShapeSliders::checked);
  auto* line = new QHBoxLayout;
  line->addWidget(slider, 1);
  const QString meaning = QStringLiteral("%1: %2").arg(QString::fromStdString(p.name), QString::fromStdString(p.meaning));
  auto* label = tipped(new QLabel(plainName(p)), meaning);
  slider->setToolTip(meaning);
  box->setToolTip(meaning);
  const std::size_t at = rows_.size();
  rows_.push_back({p, slider, box, nullptr, nullptr, isWhole(p) && !typed ? static_cast<int>(p.max - p.min) : kSteps});
  slider->setRange(0, rows_[at].steps);
  if (typed) addEnds(at, *line);
  line->addWidget(box);
  fit(rows_[at]);
  form_->addRow(label, line);
  connect(slider, &QSlider::valueChanged, this, [this, at](int step) {
    // Three digits are as fine as a slider is.
    const Row& row = rows_[at];
    const double raw = row.parameter.min + (row.parameter.max - row.parameter.min) * step / row.steps;
    row.box->show(QString::number(raw, 'g', 3).toDouble());
    Q_EMIT moved();
  });
  connect(box, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this, at](double) {
    fit(rows_[at]);
    Q_EMIT moved();
  });
}

void ShapeSliders::addEnds(std::size_t at, QHBoxLayout& line) {
  const auto end = [&](const char* name, double constraints::ShapeParameter::*bound) {
    auto* box = new UnitSpinBox(-kMostTyped, kMostTyped, {});
    box->setObjectName(QLatin1String(name) + QString::fromStdString(rows_[at].parameter.name));
    box->setButtonSymbols(QAbstractSpinBox::NoButtons);
    box->setMinimumWidth(44);
    box->setMaximumWidth(56);
    box->setToolTip("end of the slider");
    box->setName(plainName(rows_[at].parameter) + ", end of the slider");
    connect(box, &UnitSpinBox::checked, this, &ShapeSliders::checked);
    box->show(rows_[at].parameter.*bound);
    connect(box, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this, at, bound](double v) {
      rows_[at].parameter.*bound = v;
      fit(rows_[at]);
    });
    return box;
  };
  rows_[at].low = end("low_", &constraints::ShapeParameter::min);
  rows_[at].high = end("high_", &constraints::ShapeParameter::max);
  line.insertWidget(0, rows_[at].low);
  line.addWidget(rows_[at].high);
}

void ShapeSliders::fit(Row& row) {
  constraints::ShapeParameter& p = row.parameter;
  const double value = row.box->value();
  if (row.low != nullptr) {
    if (p.max < p.min) std::swap(p.min, p.max);
    p.min = std::min(p.min, value);
    p.max = std::max(p.max, value);
    row.low->show(p.min);
    row.high->show(p.max);
  }
  const double range = p.max - p.min;
  quietly(row.slider)->setValue(range > 0 ? static_cast<int>(std::lround((value - p.min) / range * row.steps)) : 0);
}

std::map<std::string, double> ShapeSliders::values() const {
  std::map<std::string, double> values;
  for (const Row& row : rows_) values[row.parameter.name] = row.box->value();
  return values;
}

QString ShapeSliders::fault() const {
  QStringList faults;
  for (const Row& row : rows_)
    for (const UnitSpinBox* box : {row.low, row.box, row.high})
      if (box != nullptr) faults << box->fault();
  faults.removeAll({});
  return faults.join(QLatin1Char('\n'));
}

std::vector<constraints::ShapeParameter> ShapeSliders::parameters() const {
  std::vector<constraints::ShapeParameter> parameters;
  for (const Row& row : rows_) parameters.push_back(row.parameter);
  return parameters;
}

}  // namespace reachlab::gui::widgets
