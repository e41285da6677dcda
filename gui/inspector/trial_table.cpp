#include "gui/inspector/trial_table.h"

#include <QBrush>
#include <algorithm>
#include <cmath>

#include "base/table_text.h"
#include "gui/scene/trial_texts.h"
#include "gui/widgets/theme.h"
#include "sim/record/log/trial_measures.h"

namespace reachlab::gui::inspector {
namespace {

// What the columns t and peak show. The analysis' own peak needs the samples of every trial, which the table does not read.
const record::TickMeasure& kMovementTime = record::tickMeasure("movement_time_s");
const record::TickMeasure& kPeakSpeed = record::tickMeasure("peak_hand_speed_m_per_s");

QString from(const std::string& text) { return QString::fromStdString(text); }

}  // namespace

TrialTable::TrialTable(QObject* parent) : QAbstractTableModel(parent) {}

void TrialTable::setIndex(record::TrialIndex index) {
  beginResetModel();
  index_ = std::move(index);
  places_.clear();
  firstRow_.clear();
  for (std::size_t r = 0; r < index_.runs.size(); ++r) {
    firstRow_.push_back(places_.size());
    for (std::size_t t = 0; t < index_.runs[r].trials.size(); ++t)
      places_.push_back({static_cast<std::uint32_t>(r), static_cast<std::uint32_t>(t)});
  }
  marks_.assign(index_.runs.size(), std::nullopt);
  errors_.clear();
  endResetModel();
}

const record::RecordedTrial& TrialTable::trial(int row) const {
  const Place& place = places_[static_cast<std::size_t>(row)];
  return index_.runs[place.run].trials[place.trial];
}

int TrialTable::rowOf(const std::string& log, int trial) const {
  for (std::size_t r = 0; r < index_.runs.size(); ++r) {
    if (index_.runs[r].path != log) continue;
    for (std::size_t t = 0; t < index_.runs[r].trials.size(); ++t)
      if (index_.runs[r].trials[t].trial == trial) return static_cast<int>(firstRow_[r] + t);
  }
  return -1;
}

const record::RunMarks& TrialTable::marksOf(std::size_t run) const {
  if (!marks_[run]) marks_[run] = record::readMarks(index_.runs[run].path);
  return *marks_[run];
}

record::TrialMark TrialTable::mark(int row) const {
  const int number = trial(row).trial;
  const record::TrialMark* found = marksOf(places_[static_cast<std::size_t>(row)].run).find(number);
  return found == nullptr ? record::TrialMark{.trial = number} : *found;
}

void TrialTable::setMark(int row, const record::TrialMark& mark) {
  const std::size_t run = places_[static_cast<std::size_t>(row)].run;
  record::RunMarks marks = record::readMarks(index_.runs[run].path);  // another window may have marked meanwhile
  marks.set(mark);
  record::writeMarks(index_.runs[run].path, marks);
  marks_[run] = std::move(marks);
  Q_EMIT dataChanged(index(row, 0), index(row, kColumns - 1));
}

void TrialTable::setErrors(int row, const TrialErrors& errors) {
  errors_[row] = errors;
  Q_EMIT dataChanged(index(row, kPaper), index(row, kFitted));
}

void TrialTable::showCriterion(predict::Criterion criterion) {
  if (criterion == criterion_) return;
  criterion_ = criterion;
  if (rowCount() > 0) Q_EMIT dataChanged(index(0, kPaper), index(rowCount() - 1, kFitted));
  Q_EMIT headerDataChanged(Qt::Horizontal, kPaper, kFitted);
}

std::optional<double> TrialTable::error(int row, bool fitted) const {
  const auto errors = errors_.find(row);
  if (errors == errors_.end()) return std::nullopt;
  return (fitted ? errors->second.fitted : errors->second.paper)[static_cast<std::size_t>(criterion_)];
}

QString TrialTable::text(int row, int column) const {
  const record::IndexedRun& r = run(row);
  const record::RecordedTrial& t = trial(row);
  const auto number = [](double value, int digits) { return std::isfinite(value) ? QString::number(value, 'f', digits) : QString(); };
  const auto optional = [&](const std::optional<double>& value) { return value ? number(*value, 4) : QString(); };
  switch (column) {
    case kSubject: return from(r.subject);
    case kSession: return from(r.session);
    case kCondition: return from(r.conditionOf(t)) + (r.practice ? tr(" (practice)") : QString());
    case kRun: return QString::number(r.run);
    case kTrial: return QString::number(t.trial);
    case kOutcome: return t.result.outcome == trial::Outcome::Success ? "✓" : QStringLiteral("✗ ") + scene::reasonText(t.result.reason);
    case kTime: return number(kMovementTime.of(t), 3);
    case kPeak: return t.result.onsetTick > 0 ? number(kPeakSpeed.of(t), 3) : QString();
    case kPaper: return optional(error(row, false));
    case kFitted: return optional(error(row, true));
    case kMark: return markWords(row);
    default: return {};
  }
}

QString TrialTable::markWords(int row) const {
  QStringList words;
  try {
    const record::TrialMark own = mark(row);
    if (own.flagged) words << "⚑";
    if (!own.excluded.empty()) words << tr("excluded: %1").arg(from(own.excluded));
    if (own.onset || own.offset) words << tr("moved");
    if (!own.note.empty()) words << from(own.note);
  } catch (const Error&) {
    return tr("marks cannot be read");
  }
  return words.join("  ");
}

QVariant TrialTable::sortKey(int row, int column) const {
  const record::RecordedTrial& t = trial(row);
  const double none = 1e300;  // what is not known stands last
  const auto known = [&](double value) { return std::isfinite(value) ? value : none; };
  switch (column) {
    case kRun: return run(row).run;
    case kTrial: return t.trial;
    case kTime: return known(kMovementTime.of(t));
    case kPeak: return t.result.onsetTick > 0 ? known(kPeakSpeed.of(t)) : none;
    case kPaper: return error(row, false).value_or(none);
    case kFitted: return error(row, true).value_or(none);
    default: return text(row, column);
  }
}

QVariant TrialTable::data(const QModelIndex& at, int role) const {
  if (!at.isValid()) return {};
  switch (role) {
    case Qt::DisplayRole: return text(at.row(), at.column());
    case Qt::UserRole: return sortKey(at.row(), at.column());
    case kWordsRole: return words(at.row());
    case Qt::TextAlignmentRole: {
      const bool words = at.column() <= kCondition || at.column() == kOutcome || at.column() == kMark;
      return static_cast<int>((words ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    }
    case Qt::ForegroundRole:
      if (at.column() != kOutcome) return {};
      return QBrush(trial(at.row()).result.outcome == trial::Outcome::Success ? widgets::toQColor(widgets::colours::kGreen)
                                                                              : widgets::faultInk());
    case Qt::ToolTipRole:
      if (at.column() == kOutcome) return scene::outcomeText(trial(at.row()).result);
      if (at.column() == kMark) return text(at.row(), kMark);
      return from(run(at.row()).path);
    default: return {};
  }
}

QVariant TrialTable::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) return {};
  const QString criterion = from(std::string(predict::nameOf(criterion_)));
  static const QString kTitles[kColumns] = {tr("subject"), tr("session"),    tr("condition"), tr("run"),      tr("trial"), tr("outcome"),
                                            tr("t [s]"),   tr("peak [m/s]"), tr("ε paper"),   tr("ε fitted"), tr("marks")};
  if (role == Qt::DisplayRole && section >= 0 && section < kColumns) return kTitles[section];
  if (role != Qt::ToolTipRole) return {};
  if (section == kTime) return from(std::string(kMovementTime.sentence) + " [s]");
  if (section == kPeak) return from(std::string(kPeakSpeed.sentence) + " [m/s]");
  if (section == kPaper) return tr("the paper's epsilon of the hand beside %1, of trials that were looked at [m/s]").arg(criterion);
  if (section == kFitted) return tr("the fitted epsilon beside %1: onset, duration and amplitude fitted to the trial [m/s]").arg(criterion);
  return {};
}

QString TrialTable::words(int row) const {
  QStringList all;
  for (const int column : {kSubject, kSession, kCondition, kOutcome, kMark}) all << text(row, column);
  const record::IndexedRun& r = run(row);
  all << QStringLiteral("sub-%1 ses-%2 run-%3 block-%4 day-%5 trial-%6")
             .arg(from(r.subject), from(r.session))
             .arg(r.run)
             .arg(r.block)
             .arg(r.day)
             .arg(trial(row).trial);
  const std::string_view outcome = trial::nameOf(trial(row).result.outcome);
  all << QString::fromUtf8(outcome.data(), static_cast<int>(outcome.size()));
  if (all.at(4).contains("⚑")) all << "flagged";
  return all.join(QLatin1Char(' ')).toLower();
}

std::string toCsv(const TrialTable& table, const std::vector<int>& rows) {
  TableText out(',', "");
  out.row({"subject", "session", "condition", "practice", "run", "block", "trial", "outcome", "reason", std::string(kMovementTime.name),
           std::string(kPeakSpeed.name), "epsilon_hand_m_per_s", "epsilon_fit_m_per_s", "flagged", "excluded", "note"});
  for (const int row : rows) {
    const record::IndexedRun& r = table.run(row);
    const record::RecordedTrial& t = table.trial(row);
    const record::TrialMark mark = table.mark(row);
    const auto key = [&](int column) {
      const double value = table.data(table.index(row, column), Qt::UserRole).toDouble();
      return value < 1e299 ? value : std::nan("");
    };
    out.cell(r.subject).cell(r.session).cell(r.conditionOf(t)).whole(r.practice).whole(r.run).whole(r.block).whole(t.trial);
    out.cell(trial::nameOf(t.result.outcome)).cell(trial::nameOf(t.result.reason));
    for (const int column : {TrialTable::kTime, TrialTable::kPeak, TrialTable::kPaper, TrialTable::kFitted}) out.number(key(column));
    out.whole(mark.flagged).cell(mark.excluded).cell(mark.note).endRow();
  }
  return out.text();
}

}  // namespace reachlab::gui::inspector
