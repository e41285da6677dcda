#include "gui/inspector/inspector.h"

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollBar>
#include <QShortcut>
#include <QSignalBlocker>
#include <QSplitter>
#include <QTableView>
#include <QTimer>
#include <QVBoxLayout>
#include <cmath>

#include "gui/inspector/epsilon_panel.h"
#include "gui/inspector/marks_panel.h"
#include "gui/inspector/profile_plot.h"
#include "gui/inspector/replay_view.h"
#include "gui/inspector/analysis_lines.h"

namespace reachlab::gui::inspector {
namespace {

constexpr int kSoonMs = 150;          // a choice that is still being dragged is not read yet
constexpr int kMostInspected = 1000;  // more lines are a blot, and the report is for all of them

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
  view_->horizontalHeader()->setMinimumSectionSize(24);  // Qt's own is the width of the widest letter, whatever is in the column
  view_->horizontalHeader()->setStretchLastSection(true);
  view_->setWordWrap(false);
  auto* left = new QWidget;
  auto* column = new QVBoxLayout(left);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addWidget(view_, 1);
  marks_ = new MarksPanel;
  column->addWidget(marks_);
  halves_ = new QSplitter(Qt::Horizontal);
  halves_->setObjectName(QStringLiteral("inspectorHalves"));
  halves_->addWidget(left);
  halves_->addWidget(makeRight());
  halves_->setStretchFactor(0, 4);
  halves_->setStretchFactor(1, 6);
  halves_->setSizes({700, 860});
  halves_->setChildrenCollapsible(false);
  connect(halves_, &QSplitter::splitterMoved, this, [this] { halvesMoved_ = true; });
  layout->addWidget(halves_, 1);
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
    if (column == TrialTable::kPaper || column == TrialTable::kFitted)
      width = std::max(width, words.horizontalAdvance(QStringLiteral("0.0000")));
    view_->setColumnWidth(column, width + kMargins);
    if (column == TrialTable::kOutcome) outcomeWidth_ = width + kMargins;
  }
  view_->setColumnWidth(TrialTable::kMark, words.horizontalAdvance(QStringLiteral("marks")) + kMargins);  // stretched where there is room
  fitHalves();
}

// The table has the room of its columns, until somebody moves the border. On a small screen the reasons of failures are shortened first.
void InspectorPage::fitHalves() {
  if (halvesMoved_ || table_->rowCount() == 0) return;
  const QFontMetrics words(view_->font());
  int others =
      words.horizontalAdvance(QStringLiteral("marks")) + view_->verticalScrollBar()->sizeHint().width() + 2 * view_->frameWidth() + 14;
  for (int column = 0; column < TrialTable::kMark; ++column)
    if (column != TrialTable::kOutcome) others += view_->columnWidth(column);
  const int room = halves_->width() - halves_->handleWidth() - halves_->widget(1)->minimumSizeHint().width();
  const int outcome = std::clamp(room - others, std::min(outcomeWidth_, words.horizontalAdvance(QStringLiteral("✗ …"))), outcomeWidth_);
  view_->setColumnWidth(TrialTable::kOutcome, outcome);
  halves_->setSizes({others + outcome, std::max(1, halves_->width() - others - outcome)});
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
  connect(replay_, &ReplayView::said, this, &InspectorPage::said);
  connect(replay_, &ReplayView::timeChanged, this,
          [this](double time) { plot_->setCursor(axis_->currentIndex() == 0 ? std::optional(time) : std::nullopt); });
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
    Q_EMIT told(tr("The report is in %1.").arg(file));
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

void InspectorPage::showRead() {
  inspectedRows_.clear();
  for (const analysis::TrialData& trial : inspection_->input.trials) {
    int row = -1;
    for (std::size_t r = 0; r < table_->recordings().runs.size() && row < 0; ++r) {
      const record::IndexedRun& run = table_->recordings().runs[r];
      if (run.run == trial.key.run && run.subject == trial.key.subject && run.session == trial.key.session)
        row = table_->rowOf(run.path, trial.key.trial);
    }
    inspectedRows_.push_back(row);
  }
  const std::vector<int> chosen = chosenRows();
  if (std::find(chosen.begin(), chosen.end(), picked_) == chosen.end()) picked_ = chosen.empty() ? -1 : chosen.front();
  if (inspection_->input.trials.empty())
    Q_EMIT said(tr("The chosen trials cannot be shown, because their experiment has no task. Choose trials of another experiment."));
  draw();
  showPicked();
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
    for (std::size_t i = 0; i < inspection_->input.trials.size(); ++i) {
      const analysis::TrialKey& key = inspection_->input.trials[i].key;
      if (key.trial == trial.key.trial && key.run == trial.key.run && key.subject == trial.key.subject &&
          key.session == trial.key.session && inspectedRows_[i] >= 0)
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
  if (inspection_->analysis && !inspection_->analysis->conditions.empty()) {
    const analysis::Analysis& analysis = *inspection_->analysis;
    const std::size_t c = condition();
    if (inspection_->input.trials.size() > 1) mean = meanOf(analysis, c, signal);
    const std::vector<predict::Criterion> chosen = epsilons_->chosen();
    for (const bool fitted : {false, true}) {
      if (!(fitted ? fitted_ : predicted_)->isChecked()) continue;
      const auto some = predictionsOf(analysis, c, signal, chosen, fitted);
      predictions.insert(predictions.end(), some.begin(), some.end());
    }
    epsilons_->show(analysis, c);
  }
  plot_->setMean(mean.x, mean.mean, mean.sd);
  plot_->setPredictions(predictions);
  showPicked();
}

}  // namespace reachlab::gui::inspector
