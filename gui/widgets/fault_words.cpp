#include "gui/widgets/fault_words.h"

#include <QRegularExpression>
#include <map>
#include <string_view>

#include "sim/experiment/unit_ending.h"

namespace reachlab::gui::widgets {
namespace {

// What a key's last part is called at its field. Others keep their name, without the unit.
const std::map<QString, QString>& fieldNames() {
  static const std::map<QString, QString> names{
      {QStringLiteral("masses_kg"), QStringLiteral("masses")},
      {QStringLiteral("stiffness_n_per_m"), QStringLiteral("stiffness")},
      {QStringLiteral("damping_n_s_per_m"), QStringLiteral("damping")},
      {QStringLiteral("viscosity_n_s_per_m"), QStringLiteral("viscosity")},
      {QStringLiteral("gravity_m_per_s2"), QStringLiteral("gravity")},
      {QStringLiteral("inertia_kg_m2"), QStringLiteral("inertia")},
      {QStringLiteral("fp_offset_m"), QStringLiteral("fixed point")},
      {QStringLiteral("duration_s"), QStringLiteral("time T")},
      {QStringLiteral("position_m"), QStringLiteral("tolerance in position")},
      {QStringLiteral("velocity_m_per_s"), QStringLiteral("tolerance in velocity")},
      {QStringLiteral("time_s"), QStringLiteral("tolerance in time")},
  };
  return names;
}

}  // namespace

QString inWords(const Fault& fault) {
  static const QRegularExpression index(QStringLiteral("\\[(\\d+)\\]$")), force(QStringLiteral("^environment\\[(\\d+)\\]\\.(\\w+)"));
  QString key = QString::fromStdString(fault.key);
  QString number;
  if (const auto found = force.match(key); found.hasMatch()) {  // keys of a force are those of other parts too: "duration_s"
    const std::string name = found.captured(2).toStdString();
    const std::string_view bare = experiment::splitUnit(name).name;
    key = QStringLiteral("force %1, ").arg(found.captured(1).toInt() + 1) + QString::fromUtf8(bare.data(), static_cast<int>(bare.size()));
    key.replace(QLatin1Char('_'), QLatin1Char(' '));
  }
  if (const auto found = index.match(key); found.hasMatch()) {
    number = QStringLiteral(" %1").arg(found.captured(1).toInt() + 1);
    key.truncate(found.capturedStart());
  }
  key = key.section(QLatin1Char('.'), -1);
  if (const auto name = fieldNames().find(key); name != fieldNames().end()) key = name->second;
  if (!key.isEmpty()) key += number + QStringLiteral(": ");
  QString words = key + QString::fromStdString(fault.what);
  if (fault.place && fault.place->file.empty())  // within the text that was typed
    words = key + QStringLiteral("character %1: ").arg(fault.place->column) + QString::fromStdString(fault.what);
  if (!fault.allowed.empty()) words += QStringLiteral("; allowed: ") + QString::fromStdString(fault.allowed);
  return words;
}

QStringList inWords(const std::vector<Fault>& faults) {
  QStringList lines;
  for (const Fault& fault : faults) lines << inWords(fault);
  return lines;
}

}  // namespace reachlab::gui::widgets
