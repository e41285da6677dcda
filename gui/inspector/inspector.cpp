#include "gui/inspector/inspector.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QRegularExpression>
#include <QScrollBar>
#include <QShortcut>
#include <QSortFilterProxyModel>
#include <QSplitter>
#include <QTableView>
#include <QTimer>
#include <algorithm>
#include <cmath>

#include "base/fault.h"
#include "gui/inspector/epsilon_panel.h"
#include "gui/inspector/marks_panel.h"
#include "gui/inspector/profile_plot.h"
#include "gui/inspector/replay_view.h"
#include "gui/widgets/fault_in.h"
#include "sim/record/log/atomic_file.h"

namespace reachlab::gui::inspector {
namespace {

constexpr int kMostInspected = 1000;  // more lines are a blot, and the report is for all of them
constexpr int kMostGhosts = 8;

}  // namespace

void InspectorPage::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  QTimer::singleShot(0, this, &InspectorPage::fitHalves);  // when the halves have their new size
}

// As wide as what is in them, and as what will be computed for them.
void InspectorPage::fitColumns() {
  constexpr int kMargins = 8, kMostRows = 1000;
  const QFontMetrics heading(view_->horizontalHeader()->font()), words(view_->font());
  for (int column = 0; column < TrialTable::kMark; ++column) {
    int width = heading.horizontalAdvance(table_->headerData(column, Qt::Horizontal, Qt::DisplayRole).toString());
    for (int row = 0; row < std::min(table_->rowCount(), kMostRows); ++row)
      width = std::max(width, words.horizontalAdvance(table_->index(row, column).data().toString()));
    if (column == TrialTable::kPaper || column == TrialTable::kFitted) width = std::max(width, words.horizontalAdvance("0.0000"));
    view_->setColumnWidth(column, width + kMargins);
    if (column == TrialTable::kOutcome) outcomeWidth_ = width + kMargins;
  }
  view_->setColumnWidth(TrialTable::kMark, words.horizontalAdvance("marks") + kMargins);  // stretched where there is room
  fitHalves();
}

// The table has the room of its columns, until somebody moves the border. On a small screen the reasons of failures are shortened first.
void InspectorPage::fitHalves() {
  if (halvesMoved_ || table_->rowCount() == 0) return;
  const QFontMetrics words(view_->font());
  int others = words.horizontalAdvance("marks") + view_->verticalScrollBar()->sizeHint().width() + 2 * view_->frameWidth() + 14;
  for (int column = 0; column < TrialTable::kMark; ++column)
    if (column != TrialTable::kOutcome) others += view_->columnWidth(column);
  const int room = halves_->width() - halves_->handleWidth() - halves_->widget(1)->minimumSizeHint().width();
  const int outcome = std::clamp(room - others, std::min(outcomeWidth_, words.horizontalAdvance("✗ …")), outcomeWidth_);
  view_->setColumnWidth(TrialTable::kOutcome, outcome);
  halves_->setSizes({others + outcome, std::max(1, halves_->width() - others - outcome)});
}

void InspectorPage::wire() {
  connect(soon_, &QTimer::timeout, this, &InspectorPage::inspect);
  connect(words_, &QLineEdit::textChanged, this, [this](const QString& words) {
    QString pattern;  // a row has every one of the words
    for (const QString& word : words.toLower().split(QLatin1Char(' '), Qt::SkipEmptyParts))
      pattern += QStringLiteral("^(?=[\\s\\S]*%1)").arg(QRegularExpression::escape(word));
    filter_->setFilterRegularExpression(pattern);
    count_->setText(tr("%1 of %2").arg(filter_->rowCount()).arg(table_->rowCount()));
  });
  connect(view_->selectionModel(), &QItemSelectionModel::selectionChanged, soon_, qOverload<>(&QTimer::start));
  connect(view_->selectionModel(), &QItemSelectionModel::currentRowChanged, this, [this](const QModelIndex& now) {
    if (now.isValid()) pick(filter_->mapToSource(now).row());
  });
  connect(plot_, &ProfilePlot::picked, this, [this](int line) {
    if (line < 0 || line >= static_cast<int>(inspectedRows_.size())) return;
    const int row = inspectedRows_[static_cast<std::size_t>(line)];
    const QModelIndex at = filter_->mapFromSource(table_->index(row, 0));
    if (at.isValid()) {
      view_->selectionModel()->setCurrentIndex(at, QItemSelectionModel::NoUpdate);  // the choice stays
      view_->scrollTo(at);
    }
    pick(row);
  });
  connect(plot_, &ProfilePlot::cursorMoved, this, [this](double time) {
    if (timeAxis() == TimeAxis::AsMoved) replay_->goTo(time);
  });
  connect(plot_, &ProfilePlot::marksMoved, this, &InspectorPage::marksDragged);
  connect(replay_, &ReplayView::said, this, &InspectorPage::said);
  connect(replay_, &ReplayView::timeChanged, this,
          [this](double time) { plot_->setCursor(timeAxis() == TimeAxis::AsMoved ? std::optional(time) : std::nullopt); });
  connect(marks_, &MarksPanel::edited, this, &InspectorPage::setMark);
  for (QComboBox* box : {signal_, axis_}) connect(box, qOverload<int>(&QComboBox::currentIndexChanged), this, &InspectorPage::draw);
  for (QCheckBox* box : {predicted_, fitted_}) connect(box, &QCheckBox::toggled, this, &InspectorPage::draw);
  connect(epsilons_, &EpsilonPanel::chosenChanged, this, [this] {
    table_->showCriterion(epsilons_->first());
    draw();
  });
  connect(report_, &QPushButton::clicked, this, [this] { report(path_); });
  const auto wireProgress = [this](auto& work) {
    using Work = std::decay_t<decltype(work)>;
    connect(cancel_, &QPushButton::clicked, &work, &Work::cancel);
    connect(&work, &Work::progressed, this, [this](const QString& what, int done, int of) {
      progress_->setRange(0, of);
      progress_->setValue(done);
      progress_->setFormat(what + " %v / %m");
      progress_->show();
      cancel_->show();
    });
    connect(&work, &Work::idle, this, [this] {
      progress_->setVisible(analysis_.busy());
      cancel_->setVisible(analysis_.busy());
      report_->setEnabled(table_->rowCount() > 0 && !analysis_.busy());
    });
  };
  connect(cancel_, &QPushButton::clicked, this, [this] {
    if (inspector_.busy()) epsilons_->clear(tr("Not judged, because it was cancelled. Choose the trials again."));
  });
  wireProgress(opener_);
  wireProgress(inspector_);
  wireProgress(analysis_);
  for (Inspector* work : {&opener_, &inspector_}) connect(work, &Inspector::failed, this, &InspectorPage::said);
  connect(&analysis_, &DatasetAnalysis::said, this, &InspectorPage::said);
  connect(&analysis_, &DatasetAnalysis::told, this, &InspectorPage::told);
  connect(&analysis_, &DatasetAnalysis::reported, this, &InspectorPage::reported);
  connect(&opener_, &Inspector::indexed, this, &InspectorPage::opened);
  connect(&inspector_, &Inspector::inspected, this, [this](const std::shared_ptr<const Inspection>& found) {
    inspection_ = found;
    if (found->analysis) showJudged();
    else showRead();
  });
}

void InspectorPage::report(const QString& dataset) {
  analysis_.begin(dataset);
  report_->setEnabled(!analysis_.busy());
}

const std::vector<InspectorPage::Key>& InspectorPage::keys() {
  static const std::vector<Key> all{
      {"P", tr("plays and stops the replay"), [](InspectorPage& page) { page.replay_->togglePlaying(); }},
      {",", tr("shows one sample earlier"), [](InspectorPage& page) { page.replay_->step(-1); }},
      {".", tr("shows one sample later"), [](InspectorPage& page) { page.replay_->step(1); }},
      {"Ctrl+F", tr("goes to the filter of the trials"), [](InspectorPage& page) { page.words_->setFocus(), page.words_->selectAll(); }}};
  return all;
}

void InspectorPage::addKeys() {
  for (const Key& key : keys()) {
    auto* shortcut = new QShortcut(QKeySequence(key.keys), this);
    shortcut->setContext(Qt::WidgetWithChildrenShortcut);
    connect(shortcut, &QShortcut::activated, this, [this, act = key.act] { act(*this); });
  }
}

std::vector<int> InspectorPage::chosenRows() const {
  std::vector<int> rows;
  for (const QModelIndex& at : view_->selectionModel()->selectedRows()) rows.push_back(filter_->mapToSource(at).row());
  std::sort(rows.begin(), rows.end());
  return rows;
}

void InspectorPage::inspect() {
  std::vector<int> rows = chosenRows();
  if (rows.empty()) return;
  if (static_cast<int>(rows.size()) > kMostInspected) {
    Q_EMIT said(tr("%1 trials are chosen. The first %2 are shown. The report uses all of them.").arg(rows.size()).arg(kMostInspected));
    rows.resize(kMostInspected);
  }
  // Rows of one log together, as they are read; those of experiments without a task are left out by the reading.
  std::vector<analysis::ChosenTrials> chosen;
  for (const int row : rows) {
    if (chosen.empty() || chosen.back().log != table_->run(row).path) chosen.push_back({table_->run(row).path, {}});
    chosen.back().trials.push_back(table_->trial(row).trial);
  }
  epsilons_->clear(tr("Being judged …"));
  inspector_.begin(std::move(chosen));
}

std::size_t InspectorPage::condition() const {
  if (!inspection_ || !inspection_->analysis) return 0;
  // The picked trial's; the study has its conditions in an order of its own.
  if (const auto line = lineOf(picked_)) {
    const std::string& name = inspection_->input.trials[*line].key.condition;
    for (std::size_t c = 0; c < inspection_->analysis->conditions.size(); ++c)
      if (inspection_->analysis->conditions[c].name == name) return c;
  }
  return 0;
}

std::optional<std::size_t> InspectorPage::lineOf(int row) const {
  for (std::size_t i = 0; i < inspectedRows_.size(); ++i)
    if (inspectedRows_[i] == row) return i;
  return std::nullopt;
}

int InspectorPage::rowOf(const analysis::TrialKey& key) const {
  for (const record::IndexedRun& run : table_->recordings().runs)
    if (run.run == key.run && run.subject == key.subject && run.session == key.session) return table_->rowOf(run.path, key.trial);
  return -1;
}

void InspectorPage::showRead() {
  inspectedRows_.clear();
  for (const analysis::TrialData& trial : inspection_->input.trials) inspectedRows_.push_back(rowOf(trial.key));
  const std::vector<int> chosen = chosenRows();
  if (std::find(chosen.begin(), chosen.end(), picked_) == chosen.end()) picked_ = chosen.empty() ? -1 : chosen.front();
  if (inspection_->input.trials.empty())
    Q_EMIT said(tr("The chosen trials cannot be shown, because their experiment has no task. Choose trials of another experiment."));
  draw();
}

void InspectorPage::showJudged() {
  const analysis::Analysis& analysis = *inspection_->analysis;
  std::map<std::pair<std::size_t, std::string>, std::size_t> place;  // of a person's next fitted trial
  for (const analysis::AnalyzedTrial& trial : analysis.trials) {
    TrialErrors errors;
    const analysis::ConditionResult& r = analysis.results[trial.condition];
    for (std::size_t k = 0; k < r.signals.size() && k < trial.paperError.size(); ++k)
      if (std::isfinite(trial.paperError[k])) errors.paper[static_cast<std::size_t>(r.signals[k].criterion)] = trial.paperError[k];
    if (trial.used() && trial.window.size > 0 && !r.onlyFailures) {
      const std::size_t i = place[{trial.condition, trial.key.subject}]++;
      for (const analysis::PersonResult& person : analysis.people) {
        if (person.condition != trial.condition || person.subject != trial.key.subject || !person.fitted) continue;
        for (std::size_t k = 0; k < person.fit.candidates.size(); ++k)
          for (const predict::Criterion c : r.candidates.candidates[k].criteria)
            errors.fitted[static_cast<std::size_t>(c)] = person.fit.candidates[k].epsilon[i];
      }
    }
    if (const int row = rowOf(trial.key); row >= 0) table_->setErrors(row, errors);
  }
  draw();
}

ShownPredictions InspectorPage::shownPredictions() const { return {epsilons_->chosen(), predicted_->isChecked(), fitted_->isChecked()}; }

TimeAxis InspectorPage::timeAxis() const { return axis_->currentIndex() == 0 ? TimeAxis::AsMoved : TimeAxis::Scaled; }

void InspectorPage::draw() {
  const Signal signal = signal_->currentIndex() == 0 ? Signal::Hand : Signal::Object;
  std::vector<plot::PredictedLine> predictions;
  ProfilePlot::Mean mean;
  if (inspection_ && inspection_->analysis && !inspection_->analysis->conditions.empty()) {
    const analysis::Analysis& analysis = *inspection_->analysis;
    const std::size_t c = condition();
    if (inspection_->input.trials.size() > 1) mean = meanOf(analysis, c, signal);
    predictions = predictionsOf(analysis, c, signal, shownPredictions());
    epsilons_->show(analysis, c);
  }
  plot_->setLines(inspection_ ? linesOf(*inspection_, signal, timeAxis()) : std::vector<ProfilePlot::Line>());
  plot_->setMean(mean);
  plot_->setPredictions(predictions);
  if (!inspection_) plot_->setCursor({});
  showPicked();
}

void InspectorPage::open(const QString& path) {
  path_ = path;
  Q_EMIT said({});
  inspector_.cancel();
  opener_.open(path);
}

void InspectorPage::opened(const record::TrialIndex& index) {
  recordings_.clear();
  scenes_ = {};
  inspection_.reset();
  inspectedRows_.clear();
  picked_ = -1;
  QStringList sentences, losses;
  for (const std::string& sentence : index.unreadable) sentences << QString::fromStdString(sentence);
  for (const record::IndexedRun& run : index.runs)
    if (!run.loss.empty()) losses << QString::fromStdString(run.loss);
  sentences << losses;
  const bool exported = !index.runs.empty() && analysis::isMotionFile(index.runs.front().path);
  if (exported) Q_EMIT told(tr("This dataset has no logs. Its Motion-BIDS files are shown, without marks and notes."));
  table_->setIndex(index);
  if (!sentences.isEmpty()) Q_EMIT said(sentences.join(QLatin1Char('\n')));
  title_->setText(QFileInfo(path_).fileName().isEmpty() ? path_ : QFileInfo(path_).fileName());
  title_->setToolTip(path_);
  QString count = tr("%1 trials, %2 runs").arg(table_->rowCount()).arg(table_->recordings().runs.size());
  if (!losses.isEmpty()) count += tr(", %1 with losses").arg(losses.size());
  count_->setText(count);
  count_->setToolTip(losses.join(QLatin1Char('\n')));
  fitColumns();
  report_->setEnabled(table_->rowCount() > 0 && !analysis_.busy());
  replay_->clear();
  draw();
  if (filter_->rowCount() > 0) view_->selectRow(0);
}

void InspectorPage::pick(int row) {
  if (row == picked_) return;
  const std::size_t before = condition();
  picked_ = row;
  if (condition() != before) draw();  // with the mean and the predictions of this one
  else showPicked();
}

const analysis::Recording& InspectorPage::recordingOf(const std::string& path) {
  const auto known = recordings_.find(path);
  if (known != recordings_.end()) return known->second;
  if (recordings_.size() > 8) recordings_.clear();
  return recordings_.emplace(path, analysis::openRecording(path, scenes_)).first->second;
}

void InspectorPage::showPicked() {
  const auto line = lineOf(picked_);
  plot_->setPicked(line ? static_cast<int>(*line) : -1);
  if (!line) {
    plot_->setMarks({}, {});
    marks_->clear();
    return;
  }
  const bool shown = attempt([&] {
    const auto conditionAt = [this](int at) { return table_->run(at).conditionOf(table_->trial(at)); };
    const auto trackOf = [&](std::size_t i) {
      const int row = inspectedRows_[i];
      return ReplayView::Track{TrialReplay(recordingOf(table_->run(row).path).run, table_->trial(row)), zeroOf(*inspection_, i)};
    };
    std::vector<ReplayView::Track> ghosts;
    for (std::size_t i = 0; i < inspectedRows_.size() && static_cast<int>(ghosts.size()) < kMostGhosts; ++i)
      if (i != *line && inspectedRows_[i] >= 0 && conditionAt(inspectedRows_[i]) == conditionAt(picked_)) ghosts.push_back(trackOf(i));
    const record::IndexedRun& run = table_->run(picked_);
    ReplayView::Track track = trackOf(*line);
    replay_->show(recordingOf(run.path).scenes.at(static_cast<std::size_t>(table_->trial(picked_).planned.scene)),
                  QFileInfo(QString::fromStdString(run.path)).path(), std::move(track), std::move(ghosts));
    const analysis::Movement& move = inspection_->signals[*line].movement;
    const double first = inspection_->input.trials[*line].first;
    if (move.found && timeAxis() == TimeAxis::AsMoved) plot_->setMarks(0, move.duration());
    else plot_->setMarks({}, {});
    marks_->show(tr("subject %1, session %2, run %3, trial %4")
                     .arg(QString::fromStdString(run.subject), QString::fromStdString(run.session))
                     .arg(run.run)
                     .arg(table_->trial(picked_).trial),
                 table_->mark(picked_), move.found ? first + move.onset : std::nan(""), move.found ? first + move.offset : std::nan(""));
  });
  if (!shown) replay_->clear();
}

void InspectorPage::marksDragged(double onset, double end) {
  const auto line = lineOf(picked_);
  if (!line) return;
  const double zero = zeroOf(*inspection_, *line);
  const analysis::Movement& move = inspection_->signals[*line].movement;
  if (!(onset < end)) return showPicked();  // an onset behind the end is none
  attempt([&] {
    record::TrialMark mark = table_->mark(picked_);
    if (std::abs(onset) > 1e-4) mark.onset = std::max(0.0, zero + onset);
    if (std::abs(end - move.duration()) > 1e-4) mark.offset = zero + end;
    setMark(mark);
  });
}

void InspectorPage::setMark(const record::TrialMark& mark) {
  if (picked_ < 0) return;
  if (analysis::isMotionFile(table_->run(picked_).path)) {  // a mark in the dataset would be no part of BIDS
    showPicked();
    Q_EMIT said(tr("Marks are kept beside a recording's log, and this dataset has no logs. Add the dataset's sourcedata to mark trials."));
    return;
  }
  attempt([&] {
    const record::TrialMark before = table_->mark(picked_);
    table_->setMark(picked_, mark);
    if (mark.excluded != before.excluded || mark.onset != before.onset || mark.offset != before.offset) inspect();  // other numbers
    else showPicked();
  });
}

bool InspectorPage::attempt(const std::function<void()>& work) {
  const QString fault = widgets::faultIn(work);
  if (!fault.isEmpty()) Q_EMIT said(fault);
  return fault.isEmpty();
}

void InspectorPage::exportTo(const QString& file) {
  if (!inspection_ || inspection_->input.trials.empty()) throw FaultError(Fault{"trials", "none is chosen", "rows of the table"});
  const std::string name = file.toStdString();
  const QString ending = QFileInfo(file).suffix().toLower();
  if (!QStringList{"svg", "pdf", "png", "csv"}.contains(ending))
    throw FaultError(Fault{name, "unknown kind of figure", ".svg, .pdf, .png, .csv"});
  const bool lines = ending == QLatin1String("csv");
  record::writeFileAtomically(name, lines ? linesCsv(*inspection_, timeAxis())
                                          : figure::renderFor(name, figureOf(*inspection_, condition(), timeAxis(), shownPredictions())));
}

void InspectorPage::exportTable(const QString& file) {
  std::vector<int> rows;
  for (int row = 0; row < filter_->rowCount(); ++row) rows.push_back(filter_->mapToSource(filter_->index(row, 0)).row());
  record::writeFileAtomically(file.toStdString(), toCsv(*table_, rows));
}

void InspectorPage::save(const QString& title, const QString& proposed, const QString& kinds,
                         const std::function<void(const QString&)>& write) {
  QString kind = kinds.section(";;", 0, 0);
  QString file = QFileDialog::getSaveFileName(this, title, proposed, kinds, &kind);
  if (file.isEmpty()) return;
  if (QFileInfo(file).suffix().isEmpty()) file += kind.section(QLatin1Char('*'), 1).chopped(1);  // of "CSV (*.csv)"
  attempt([&] {
    write(file);
    Q_EMIT told(tr("Written: %1").arg(file));
  });
}

}  // namespace reachlab::gui::inspector
