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
      {"masses_kg", "masses"},
      {"stiffness_n_per_m", "stiffness"},
      {"damping_n_s_per_m", "damping"},
      {"viscosity_n_s_per_m", "viscosity"},
      {"gravity_m_per_s2", "gravity"},
      {"inertia_kg_m2", "inertia"},
      {"fp_offset_m", "fixed point"},
      {"duration_s", "time T"},
      {"position_m", "tolerance in position"},
      {"velocity_m_per_s", "tolerance in velocity"},
      {"time_s", "tolerance in time"},
  };
  return names;
}

}  // namespace

QString inWords(const Fault& fault) {
  static const QRegularExpression index("\\[(\\d+)\\]$"), force("^environment\\[(\\d+)\\]\\.(\\w+)");
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
  if (!key.isEmpty()) key += number + ": ";
  QString words = key + QString::fromStdString(fault.what);
  if (fault.place && fault.place->file.empty())  // within the text that was typed
    words = key + QStringLiteral("character %1: ").arg(fault.place->column) + QString::fromStdString(fault.what);
  if (!fault.allowed.empty()) words += "; allowed: " + QString::fromStdString(fault.allowed);
  return words;
}

QStringList inWords(const std::vector<Fault>& faults) {
  QStringList lines;
  for (const Fault& fault : faults) lines << inWords(fault);
  return lines;
}

}  // namespace reachlab::gui::widgets
