#include "gui/inspector/inspector.h"

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QProgressBar>
#include <QPushButton>
#include <QShortcut>
#include <QSignalBlocker>
#include <QSplitter>
#include <QStandardPaths>
#include <QTableView>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>

#include "base/ending.h"
#include "base/fault.h"
#include "gui/inspector/epsilon_panel.h"
#include "gui/inspector/marks_panel.h"
#include "gui/inspector/profile_plot.h"
#include "gui/inspector/replay_view.h"
#include "gui/inspector/study_lines.h"
#include "sim/record/append_file.h"

namespace reachlab::gui::inspector {
namespace {

constexpr int kSoonMs = 150;          // a choice that is still being dragged is not read yet
constexpr int kMostInspected = 1000;  // more lines are a blot, and the report is for all of them
constexpr int kMostGhosts = 8;

QString indexFolder() { return QStandardPaths::writableLocation(QStandardPaths::GenericCacheLocation) + QStringLiteral("/reachlab"); }

}  // namespace

InspectorPage::InspectorPage(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("inspector"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 6, 4);
  layout->setSpacing(5);
  addTop(*layout);
  table_ = new TrialTable(this);
  filter_ = new TrialFilter(table_);
  view_ = new QTableView;
  view_->setObjectName(QStringLiteral("inspectedTrials"));
  view_->setModel(filter_);
  view_->setSortingEnabled(true);
  view_->sortByColumn(-1, Qt::AscendingOrder);
  view_->setSelectionBehavior(QAbstractItemView::SelectRows);
  view_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  view_->setShowGrid(false);
  view_->setAlternatingRowColors(true);
  view_->verticalHeader()->hide();
  view_->verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
  view_->verticalHeader()->setDefaultSectionSize(22);
  view_->horizontalHeader()->setHighlightSections(false);
  view_->horizontalHeader()->setStretchLastSection(true);
  view_->setWordWrap(false);
  auto* left = new QWidget;
  auto* column = new QVBoxLayout(left);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addWidget(view_, 1);
  marks_ = new MarksPanel;
  column->addWidget(marks_);
  auto* both = new QSplitter(Qt::Horizontal);
  both->setObjectName(QStringLiteral("inspectorHalves"));
  both->addWidget(left);
  both->addWidget(makeRight());
  both->setStretchFactor(0, 4);
  both->setStretchFactor(1, 6);
  both->setSizes({700, 860});
  both->setChildrenCollapsible(false);
  layout->addWidget(both, 1);
  soon_ = new QTimer(this);
  soon_->setSingleShot(true);
  soon_->setInterval(kSoonMs);
  opener_ = new QTimer(this);
  opener_->setInterval(20);
  wire();
  addKeys();
}

InspectorPage::~InspectorPage() {
  if (openingStop_) *openingStop_ = true;
}

void InspectorPage::addTop(QVBoxLayout& layout) {
  auto* top = new QHBoxLayout;
  auto* openButton = new QToolButton;
  openButton->setText(tr("Open"));
  openButton->setObjectName(QStringLiteral("inspectorOpen"));
  openButton->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(openButton);
  menu->addAction(tr("Dataset…"), this, [this] {
    const QString folder = QFileDialog::getExistingDirectory(this, tr("Open a dataset or a session"), path_);
    if (!folder.isEmpty()) open(folder);
  });
  menu->addAction(tr("Recording…"), this, [this] {
    const QString file = QFileDialog::getOpenFileName(this, tr("Open a recording"), path_, tr("Recordings (*.reach)"));
    if (!file.isEmpty()) open(file);
  });
  menu->addAction(tr("Look again"), this, [this] {
    if (!path_.isEmpty()) open(path_);
  });
  openButton->setMenu(menu);
  title_ = new QLabel(tr("No recording is open."));
  title_->setStyleSheet(QStringLiteral("font-weight: 600;"));
  words_ = new QLineEdit;
  words_->setObjectName(QStringLiteral("inspectorFilter"));
  words_->setPlaceholderText(tr("filter: words of a row, e.g. sub-03 fast success"));
  words_->setClearButtonEnabled(true);
  words_->setMinimumWidth(260);
  count_ = new QLabel;
  count_->setObjectName(QStringLiteral("inspectorCount"));
  count_->setProperty("role", "quiet");
  progress_ = new QProgressBar;
  progress_->setObjectName(QStringLiteral("inspectorProgress"));
  progress_->setMaximumWidth(230);
  progress_->hide();
  cancel_ = new QPushButton(tr("Cancel"));
  cancel_->setObjectName(QStringLiteral("inspectorCancel"));
  cancel_->hide();
  auto* exportButton = new QToolButton;
  exportButton->setText(tr("Export"));
  exportButton->setPopupMode(QToolButton::InstantPopup);
  auto* exports = new QMenu(exportButton);
  exports->addAction(tr("Figure or lines of the chosen trials…"), this, &InspectorPage::saveFigure);
  exports->addAction(tr("Table as it is shown…"), this, &InspectorPage::saveTable);
  exportButton->setMenu(exports);
  report_ = new QPushButton(tr("Report"));
  report_->setObjectName(QStringLiteral("inspectorReport"));
  report_->setToolTip(tr("analyses everything that is open, as `reach analyze` does, and shows the report"));
  report_->setEnabled(false);
  top->addWidget(openButton);
  top->addWidget(title_);
  top->addWidget(words_, 1);
  top->addWidget(count_);
  top->addWidget(progress_);
  top->addWidget(cancel_);
  top->addWidget(exportButton);
  top->addWidget(report_);
  layout.addLayout(top);
}

QWidget* InspectorPage::makeRight() {
  auto* right = new QWidget;
  auto* column = new QVBoxLayout(right);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(3);
  auto* row = new QHBoxLayout;
  signal_ = new QComboBox;
  signal_->setObjectName(QStringLiteral("inspectorSignal"));
  signal_->addItems({tr("velocity of the hand"), tr("velocity of the last mass")});
  axis_ = new QComboBox;
  axis_->setObjectName(QStringLiteral("inspectorAxis"));
  axis_->addItems({tr("as moved"), tr("time-scaled to the mean")});
  predicted_ = new QCheckBox(tr("predicted for T"));
  predicted_->setChecked(true);
  fitted_ = new QCheckBox(tr("fitted"));
  fitted_->setObjectName(QStringLiteral("inspectorFitted"));
  fitted_->setChecked(true);
  fitted_->setToolTip(tr("the mean of the movements that were fitted to a person's trials; from ten trials on"));
  for (QWidget* widget : std::initializer_list<QWidget*>{signal_, axis_, predicted_, fitted_}) row->addWidget(widget);
  row->addStretch(1);
  column->addLayout(row);
  plot_ = new ProfilePlot;
  plot_->setObjectName(QStringLiteral("inspectorPlot"));
  replay_ = new ReplayView;
  epsilons_ = new EpsilonPanel;
  auto* below = new QSplitter(Qt::Horizontal);
  below->addWidget(replay_);
  below->addWidget(epsilons_);
  below->setStretchFactor(0, 3);
  below->setStretchFactor(1, 2);
  below->setSizes({520, 340});
  below->setChildrenCollapsible(false);
  auto* halves = new QSplitter(Qt::Vertical);
  halves->addWidget(plot_);
  halves->addWidget(below);
  halves->setStretchFactor(0, 1);
  halves->setStretchFactor(1, 1);
  halves->setSizes({420, 400});
  halves->setChildrenCollapsible(false);
  column->addWidget(halves, 1);
  return right;
}

void InspectorPage::wire() {
  connect(opener_, &QTimer::timeout, this, &InspectorPage::pollOpening);
  connect(soon_, &QTimer::timeout, this, &InspectorPage::inspect);
  connect(words_, &QLineEdit::textChanged, this, [this](const QString& words) {
    filter_->setWords(words);
    count_->setText(tr("%1 of %2").arg(filter_->rowCount()).arg(table_->rowCount()));
  });
  connect(view_->selectionModel(), &QItemSelectionModel::selectionChanged, this, &InspectorPage::chosenChanged);
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
    if (axis_->currentIndex() == 0) replay_->goTo(time);
  });
  connect(plot_, &ProfilePlot::marksMoved, this, &InspectorPage::marksDragged);
  connect(replay_, &ReplayView::timeChanged, this, [this](double time) {
    plot_->setCursor(axis_->currentIndex() == 0 ? std::optional(time) : std::nullopt);
  });
  connect(marks_, &MarksPanel::edited, this, &InspectorPage::setMark);
  for (QComboBox* box : {signal_, axis_}) connect(box, qOverload<int>(&QComboBox::currentIndexChanged), this, &InspectorPage::draw);
  for (QCheckBox* box : {predicted_, fitted_}) connect(box, &QCheckBox::toggled, this, &InspectorPage::draw);
  connect(epsilons_, &EpsilonPanel::chosenChanged, this, [this] {
    table_->showCriterion(epsilons_->first());
    draw();
  });
  connect(cancel_, &QPushButton::clicked, this, [this] {
    if (openingStop_) *openingStop_ = true;
    inspector_.cancel();
  });
  connect(report_, &QPushButton::clicked, this, &InspectorPage::openReport);
  connect(&inspector_, &Inspector::read, this, [this](const std::shared_ptr<const Inspection>& found) {
    inspection_ = found;
    showRead();
  });
  connect(&inspector_, &Inspector::judged, this, [this](const std::shared_ptr<const Inspection>& found) {
    inspection_ = found;
    showJudged();
  });
  connect(&inspector_, &Inspector::progressed, this, [this](const QString& what, int done, int of) {
    progress_->setRange(0, of);
    progress_->setValue(done);
    progress_->setFormat(what + QStringLiteral(" %v / %m"));
    progress_->show();
    cancel_->show();
  });
  connect(&inspector_, &Inspector::idle, this, [this] {
    progress_->hide();
    cancel_->hide();
    report_->setEnabled(table_->rowCount() > 0);
  });
  connect(&inspector_, &Inspector::failed, this, &InspectorPage::said);
  connect(&inspector_, &Inspector::reported, this, [this](const QString& file) {
    Q_EMIT said(tr("The report is %1").arg(file));
    Q_EMIT reported(file);
  });
}

void InspectorPage::addKeys() {
  const auto key = [this](const QKeySequence& keys, auto slot) {
    auto* shortcut = new QShortcut(keys, this);
    shortcut->setContext(Qt::WidgetWithChildrenShortcut);
    connect(shortcut, &QShortcut::activated, this, slot);
  };
  key(Qt::Key_P, [this] { replay_->togglePlaying(); });
  key(Qt::Key_Comma, [this] { replay_->step(-1); });
  key(Qt::Key_Period, [this] { replay_->step(1); });
  key(QKeySequence(QStringLiteral("Ctrl+F")), [this] { words_->setFocus(), words_->selectAll(); });
}

void InspectorPage::open(const QString& path) {
  inspector_.cancel();
  if (openingStop_) *openingStop_ = true;
  path_ = path;
  Q_EMIT said({});
  openingDone_ = std::make_shared<std::atomic<int>>(0);
  openingOf_ = std::make_shared<std::atomic<int>>(0);
  openingStop_ = std::make_shared<std::atomic<bool>>(false);
  opening_ = std::async(std::launch::async, [path = path.toStdString(), folder = indexFolder().toStdString(), done = openingDone_,
                                             of = openingOf_, stop = openingStop_] {
    return record::openTrialIndex(path, record::indexFileFor(path, folder), [&](std::size_t now, std::size_t all) {
      *done = static_cast<int>(now);
      *of = static_cast<int>(all);
      return !*stop;
    });
  });
  opener_->start();
  pollOpening();
}

void InspectorPage::pollOpening() {
  if (!opening_.valid()) return opener_->stop();
  if (opening_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    progress_->setRange(0, *openingOf_);
    progress_->setValue(*openingDone_);
    progress_->setFormat(tr("indexing %v / %m"));
    progress_->setVisible(*openingOf_ > 0);
    cancel_->setVisible(*openingOf_ > 0);
    return;
  }
  opener_->stop();
  progress_->hide();
  cancel_->hide();
  try {
    opened(opening_.get());
  } catch (const std::exception& e) {
    Q_EMIT said(QString::fromStdString(endingOf(e).sentence));
  }
}

void InspectorPage::opened(record::TrialIndex index) {
  logs_.clear();
  experiments_.clear();
  inspection_.reset();
  inspectedRows_.clear();
  picked_ = -1;
  QStringList unread;
  for (const std::string& sentence : index.unreadable) unread << QString::fromStdString(sentence);
  table_->setIndex(std::move(index));
  if (!unread.isEmpty()) Q_EMIT said(unread.join(QLatin1Char('\n')));
  title_->setText(QFileInfo(path_).fileName().isEmpty() ? path_ : QFileInfo(path_).fileName());
  title_->setToolTip(path_);
  count_->setText(tr("%1 trials, %2 runs").arg(table_->rowCount()).arg(table_->recordings().runs.size()));
  const int widths[] = {58, 58, 124, 36, 42, 126, 54, 78, 66, 66, 80};
  for (int column = 0; column < TrialTable::kColumns; ++column) view_->setColumnWidth(column, widths[column]);
  report_->setEnabled(table_->rowCount() > 0);
  marks_->clear();
  replay_->clear();
  draw();
  if (filter_->rowCount() > 0) view_->selectRow(0);
}

std::vector<int> InspectorPage::chosenRows() const {
  std::vector<int> rows;
  for (const QModelIndex& at : view_->selectionModel()->selectedRows()) rows.push_back(filter_->mapToSource(at).row());
  std::sort(rows.begin(), rows.end());
  return rows;
}

void InspectorPage::chosenChanged() { soon_->start(); }

void InspectorPage::inspect() {
  std::vector<int> rows = chosenRows();
  if (rows.empty()) return;
  if (static_cast<int>(rows.size()) > kMostInspected) {
    Q_EMIT said(tr("%1 trials are chosen: the first %2 are shown; the report takes all.").arg(rows.size()).arg(kMostInspected));
    rows.resize(kMostInspected);
  }
  // Rows of one log together, as they are read; those of experiments without a task are left out by the reading.
  std::vector<analyze::ChosenTrials> chosen;
  for (const int row : rows) {
    if (chosen.empty() || chosen.back().log != table_->run(row).path) chosen.push_back({table_->run(row).path, {}});
    chosen.back().trials.push_back(table_->trial(row).trial);
  }
  epsilons_->clear(tr("Being judged …"));
  inspector_.begin(std::move(chosen));
}

std::size_t InspectorPage::condition() const {
  if (!inspection_ || !inspection_->study) return 0;
  // The picked trial's; the study has its conditions in an order of its own.
  if (const auto line = lineOf(picked_)) {
    const std::string& name = inspection_->input.trials[*line].key.condition;
    for (std::size_t c = 0; c < inspection_->study->conditions.size(); ++c)
      if (inspection_->study->conditions[c].name == name) return c;
  }
  return 0;
}

std::optional<std::size_t> InspectorPage::lineOf(int row) const {
  for (std::size_t i = 0; i < inspectedRows_.size(); ++i)
    if (inspectedRows_[i] == row) return i;
  return std::nullopt;
}

void InspectorPage::showRead() {
  inspectedRows_.clear();
  for (const analyze::TrialData& trial : inspection_->input.trials) {
    int row = -1;
    for (std::size_t r = 0; r < table_->recordings().runs.size() && row < 0; ++r) {
      const record::IndexedRun& run = table_->recordings().runs[r];
      if (run.run == trial.key.run && run.subject == trial.key.subject && run.session == trial.key.session) row = table_->rowOf(run.path, trial.key.trial);
    }
    inspectedRows_.push_back(row);
  }
  const std::vector<int> chosen = chosenRows();
  if (std::find(chosen.begin(), chosen.end(), picked_) == chosen.end()) picked_ = chosen.empty() ? -1 : chosen.front();
  if (inspection_->input.trials.empty()) Q_EMIT said(tr("The chosen trials have nothing to show: their experiment has no task."));
  draw();
  showPicked();
}

void InspectorPage::showJudged() {
  const analyze::StudyResult& study = *inspection_->study;
  std::map<std::pair<std::size_t, std::string>, std::size_t> place;  // of a person's next fitted trial
  for (const analyze::StudyTrial& trial : study.trials) {
    TrialErrors errors;
    const analyze::ConditionResult& r = study.results[trial.condition];
    for (std::size_t k = 0; k < r.signals.size() && k < trial.paperError.size(); ++k)
      if (std::isfinite(trial.paperError[k])) errors.paper[static_cast<std::size_t>(r.signals[k].criterion)] = trial.paperError[k];
    if (trial.used() && trial.window.size > 0 && !r.onlyFailures) {
      const std::size_t i = place[{trial.condition, trial.key.subject}]++;
      for (const analyze::PersonResult& person : study.people) {
        if (person.condition != trial.condition || person.subject != trial.key.subject || !person.fitted) continue;
        for (std::size_t k = 0; k < person.fit.candidates.size(); ++k)
          for (const predict::Criterion c : r.candidates.candidates[k].criteria)
            errors.fitted[static_cast<std::size_t>(c)] = person.fit.candidates[k].epsilon[i];
      }
    }
    for (std::size_t i = 0; i < inspection_->input.trials.size(); ++i) {
      const analyze::TrialKey& key = inspection_->input.trials[i].key;
      if (key.trial == trial.key.trial && key.run == trial.key.run && key.subject == trial.key.subject && key.session == trial.key.session &&
          inspectedRows_[i] >= 0)
        table_->setErrors(inspectedRows_[i], errors);
    }
  }
  draw();
}

void InspectorPage::draw() {
  const bool hand = signal_->currentIndex() == 0;
  const Signal signal = hand ? Signal::Hand : Signal::Object;
  const TimeAxis axis = axis_->currentIndex() == 0 ? TimeAxis::AsMoved : TimeAxis::Scaled;
  plot_->setTitles(tr("time since onset [s]"), tr("velocity [m/s]"));
  if (!inspection_) {
    plot_->setLines({});
    plot_->setMean({}, {}, {});
    plot_->setPredictions({});
    plot_->setMarks({}, {});
    plot_->setCursor({});
    return;
  }
  plot_->setLines(linesOf(*inspection_, signal, axis));
  std::vector<ProfilePlot::Prediction> predictions;
  MeanLine mean;
  if (inspection_->study && !inspection_->study->conditions.empty()) {
    const analyze::StudyResult& study = *inspection_->study;
    const std::size_t c = condition();
    if (inspection_->input.trials.size() > 1) mean = meanOf(study, c, signal);
    const std::vector<predict::Criterion> chosen = epsilons_->chosen();
    for (const bool fitted : {false, true}) {
      if (!(fitted ? fitted_ : predicted_)->isChecked()) continue;
      const auto some = predictionsOf(study, c, signal, chosen, fitted);
      predictions.insert(predictions.end(), some.begin(), some.end());
    }
    epsilons_->show(study, c);
  }
  plot_->setMean(mean.x, mean.mean, mean.sd);
  plot_->setPredictions(predictions);
  showPicked();
}

void InspectorPage::pick(int row) {
  if (row == picked_) return;
  picked_ = row;
  showPicked();
}

const record::RunLog& InspectorPage::logOf(const std::string& path) {
  const auto known = logs_.find(path);
  if (known != logs_.end()) return known->second;
  if (logs_.size() > 8) logs_.clear();
  return logs_.emplace(path, record::RunLog::open(path, record::LogCheck::Trials)).first->second;
}

const experiment::CompiledExperiment& InspectorPage::experimentOf(const record::RunLog& log) {
  const record::RunConfiguration& c = log.configuration();
  const std::string key = c.experimentText + '\0' + c.definitionText;
  const auto known = experiments_.find(key);
  if (known != experiments_.end()) return known->second;
  return experiments_.emplace(key, experiment::openExperimentText(c.experimentText, log.path(), c.definitionText)).first->second;
}

void InspectorPage::showPicked() {
  const auto line = lineOf(picked_);
  plot_->setPicked(line ? static_cast<int>(*line) : -1);
  if (!line) {
    plot_->setMarks({}, {});
    marks_->clear();
    return;
  }
  try {
    const auto trackOf = [&](std::size_t i) {
      const int row = inspectedRows_[i];
      return ReplayView::Track{Replay(logOf(table_->run(row).path), table_->trial(row)), zeroOf(*inspection_, i)};
    };
    const record::RunLog& log = logOf(table_->run(picked_).path);
    std::vector<ReplayView::Track> ghosts;
    for (std::size_t i = 0; i < inspectedRows_.size() && static_cast<int>(ghosts.size()) < kMostGhosts; ++i)
      if (i != *line && inspectedRows_[i] >= 0 && table_->run(inspectedRows_[i]).condition == table_->run(picked_).condition) ghosts.push_back(trackOf(i));
    replay_->show(experimentOf(log), trackOf(*line), std::move(ghosts));
    const record::IndexedRun& run = table_->run(picked_);
    const analyze::Movement& move = inspection_->signals[*line].movement;
    const double first = inspection_->input.trials[*line].first;
    const bool asMoved = axis_->currentIndex() == 0;
    plot_->setMarks(move.found && asMoved ? std::optional(0.0) : std::nullopt,
                    move.found && asMoved ? std::optional(move.duration()) : std::nullopt);
    marks_->show(tr("subject %1, session %2, run %3, trial %4")
                     .arg(QString::fromStdString(run.subject), QString::fromStdString(run.session))
                     .arg(run.run)
                     .arg(table_->trial(picked_).trial),
                 table_->mark(picked_), move.found ? first + move.onset : std::nan(""), move.found ? first + move.offset : std::nan(""));
  } catch (const std::exception& e) {
    replay_->clear();
    Q_EMIT said(QString::fromStdString(endingOf(e).sentence));
  }
}

void InspectorPage::marksDragged(double onset, double end, bool done) {
  const auto line = lineOf(picked_);
  if (!line || !done) return;
  const double zero = zeroOf(*inspection_, *line);
  const analyze::Movement& move = inspection_->signals[*line].movement;
  if (!(onset < end)) return showPicked();  // an onset behind the end is none
  try {
    record::TrialMark mark = table_->mark(picked_);
    if (std::abs(onset) > 1e-4) mark.onset = std::max(0.0, zero + onset);
    if (std::abs(end - move.duration()) > 1e-4) mark.offset = zero + end;
    setMark(mark);
  } catch (const std::exception& e) {
    Q_EMIT said(QString::fromStdString(endingOf(e).sentence));
  }
}

void InspectorPage::setMark(const record::TrialMark& mark) {
  if (picked_ < 0) return;
  try {
    const record::TrialMark before = table_->mark(picked_);
    table_->setMark(picked_, mark);
    if (mark.excluded != before.excluded || mark.onset != before.onset || mark.offset != before.offset) inspect();  // other numbers
    else showPicked();
  } catch (const std::exception& e) {
    Q_EMIT said(QString::fromStdString(endingOf(e).sentence));
  }
}

void InspectorPage::exportTo(const QString& file) {
  if (!inspection_ || inspection_->input.trials.empty()) throw FaultError(Fault{"trials", "none is chosen", "rows of the table"});
  if (QFileInfo(file).suffix().toLower() == QLatin1String("csv")) {
    record::writeFileAtomically(file.toStdString(), linesCsv(*inspection_));
    return;
  }
  const TimeAxis axis = axis_->currentIndex() == 0 ? TimeAxis::AsMoved : TimeAxis::Scaled;
  figure::writeFigure(figureOf(*inspection_, condition(), axis, epsilons_->chosen()), file.toStdString());
}

void InspectorPage::exportTable(const QString& file) {
  std::vector<int> rows;
  for (int row = 0; row < filter_->rowCount(); ++row) rows.push_back(filter_->mapToSource(filter_->index(row, 0)).row());
  record::writeFileAtomically(file.toStdString(), toCsv(*table_, rows));
}

void InspectorPage::saveFigure() {
  const QString file = QFileDialog::getSaveFileName(this, tr("Export figure or lines"), QStringLiteral("trials.svg"),
                                                    tr("Figure as SVG (*.svg);;Figure as PDF (*.pdf);;Figure as PNG (*.png);;Lines as CSV (*.csv)"));
  if (file.isEmpty()) return;
  try {
    exportTo(file);
    Q_EMIT said(tr("Written: %1").arg(file));
  } catch (const std::exception& e) {
    Q_EMIT said(QString::fromStdString(endingOf(e).sentence));
  }
}

void InspectorPage::saveTable() {
  QString file = QFileDialog::getSaveFileName(this, tr("Export table"), QStringLiteral("trials.csv"), tr("CSV (*.csv)"));
  if (file.isEmpty()) return;
  if (QFileInfo(file).suffix().isEmpty()) file += QStringLiteral(".csv");
  try {
    exportTable(file);
    Q_EMIT said(tr("Written: %1").arg(file));
  } catch (const std::exception& e) {
    Q_EMIT said(QString::fromStdString(endingOf(e).sentence));
  }
}

void InspectorPage::openReport() {
  report_->setEnabled(false);
  inspector_.report(path_);
}

}  // namespace reachlab::gui::inspector
