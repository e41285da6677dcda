#include "gui/plan/plan_composer.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QSpinBox>
#include <QTableWidget>
#include <QVBoxLayout>
#include <set>

#include "base/fault.h"
#include "gui/model/name_in_file.h"
#include "gui/plan/mix_editor.h"
#include "gui/widgets/ask.h"
#include "gui/widgets/fault_in.h"
#include "gui/widgets/fault_label.h"
#include "gui/widgets/fault_words.h"
#include "gui/widgets/named.h"
#include "gui/widgets/text_table.h"
#include "gui/widgets/unit_spin_box.h"
#include "sim/experiment/resources.h"
#include "sim/record/log/atomic_file.h"
#include "sim/session/programme.h"

namespace reachlab::gui::plan {
namespace {

std::string written(const QString& text) { return text.trimmed().toStdString(); }

QString kindOf(const session::PlanBlock& block) {
  QStringList kinds;
  if (block.practice) kinds << PlanComposer::tr("practice");
  if (block.restSeconds > 0) kinds << PlanComposer::tr("rest %1 s before").arg(block.restSeconds);
  if (!block.instructions.empty()) kinds << PlanComposer::tr("instructions");
  if (!block.mix.kinds.empty()) kinds << PlanComposer::tr("%1 kinds").arg(session::kindsInUse(block.mix).size());
  if (block.mix.targetCount() > 1) kinds << PlanComposer::tr("%1 targets").arg(block.mix.targetCount());
  return kinds.join(QStringLiteral(", "));
}

// "block 2: …". A position in the plan's file is left out, because the file is not written yet.
QString wordsOf(Fault fault) {
  const std::string list = "blocks[";
  const std::size_t close = fault.key.find("].");
  if (!fault.key.starts_with(list) || close == std::string::npos)
    return fault.place ? QString::fromStdString(toText(fault)) : widgets::inWords(fault);
  const int block = std::stoi(fault.key.substr(list.size())) + 1;
  fault.key.erase(0, close + 2);
  return PlanComposer::tr("block %1: %2").arg(block).arg(widgets::inWords(fault));
}

}  // namespace

QString orderPreview(const session::Plan& plan, int subjects) {
  std::set<int> days;
  for (const session::PlanBlock& block : plan.blocks) days.insert(block.day);
  if (days.size() > 1) days.erase(0);  // every day
  QStringList lines;
  for (const int day : days)
    for (int s = 1; s <= (plan.counterbalance == session::Counterbalance::None ? 1 : subjects); ++s) {
      const QString label = QStringLiteral("%1").arg(s, 2, 10, QLatin1Char('0'));
      QStringList names;
      for (const int k : session::blockOrder(plan, label.toStdString(), day))
        names << QString::fromStdString(conditionOf(plan.blocks[static_cast<std::size_t>(k)])).toHtmlEscaped();
      QString who = plan.counterbalance == session::Counterbalance::None ? PlanComposer::tr("every subject")
                                                                         : PlanComposer::tr("subject %1").arg(label);
      if (day != 0) who += PlanComposer::tr(", day %1").arg(day);
      lines << QStringLiteral("<b>%1</b>: %2").arg(who, names.join(QStringLiteral(" → ")));
    }
  return lines.join(QStringLiteral("<br>"));
}

PlanComposer::PlanComposer(QWidget* parent) : QDialog(parent) {
  setWindowTitle(tr("Session plan"));
  setObjectName(QStringLiteral("planComposer"));
  auto* layout = new QVBoxLayout(this);
  auto* scroll = new QScrollArea;  // for small screens
  auto* content = new QWidget;
  auto* column = widgets::filling<QVBoxLayout>(content);
  column->addWidget(makeWhole());
  auto* middle = new QHBoxLayout;
  middle->addWidget(makeList(), 3);
  middle->addWidget(makeBlock(), 2);
  column->addLayout(middle, 1);
  mix_ = new MixEditor;
  column->addWidget(mix_);
  preview_ = widgets::named<QLabel>("planPreview");
  preview_->setTextFormat(Qt::RichText);
  preview_->setWordWrap(true);
  column->addWidget(preview_);
  scroll->setWidget(content);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setFocusPolicy(Qt::NoFocus);
  layout->addWidget(scroll, 1);
  faultLabel_ = widgets::named<widgets::FaultLabel>("planFaults");
  layout->addWidget(faultLabel_);
  auto* buttons = new QDialogButtonBox;
  auto* saveButton = buttons->addButton(tr("Save as…"), QDialogButtonBox::ActionRole);
  use_ = buttons->addButton(tr("Save and use"), QDialogButtonBox::ActionRole);  // the role Accept would give it the Enter key
  use_->setObjectName(QStringLiteral("planUse"));
  use_->setProperty("role", "go");
  buttons->addButton(QDialogButtonBox::Close);
  layout->addWidget(buttons);
  connect(saveButton, &QPushButton::clicked, this, [this] { save(true); });
  connect(use_, &QPushButton::clicked, this, [this] {
    if (!save(false)) return;
    accept();
    Q_EMIT used(file_);
  });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  wire();
  for (QPushButton* button : findChildren<QPushButton*>()) button->setAutoDefault(false);  // Enter ends an entry
  widgets::resizeOnScreen(*this, {1120, 900});
  setPlan({}, {});
}

QWidget* PlanComposer::makeWhole() {
  auto* whole = new QWidget;
  auto* row = widgets::filling<QHBoxLayout>(whole);
  name_ = widgets::named<QLineEdit>("planName");
  permute_ = widgets::named<QCheckBox>("planPermute", tr("another balanced order for every subject"));
  orderSeed_ = widgets::tipped(new QDoubleSpinBox, tr("draws which subject gets which order"));
  orderSeed_->setDecimals(0);
  orderSeed_->setRange(0, session::kMaxOrderSeed);
  widgets::addAll(*row, {new QLabel(tr("plan")), name_, permute_, new QLabel(tr("drawn by")), orderSeed_}, name_);
  return whole;
}

QWidget* PlanComposer::makeList() {
  auto* box = new QGroupBox(tr("Blocks"));
  auto* column = new QVBoxLayout(box);
  list_ = widgets::makeTextTable("planBlocks", {tr("#"), tr("experiment"), tr("condition"), tr("trials"), tr("day"), tr("also")}, 24);
  list_->setSelectionBehavior(QAbstractItemView::SelectRows);
  list_->setSelectionMode(QAbstractItemView::SingleSelection);
  list_->horizontalHeader()->setStretchLastSection(true);
  column->addWidget(list_, 1);
  auto* add = widgets::named<QPushButton>("planAdd", tr("Add"));
  copy_ = widgets::named<QPushButton>("planCopy", tr("Copy"));
  remove_ = widgets::named<QPushButton>("planRemove", tr("Remove"));
  up_ = widgets::named<QPushButton>("planUp", tr("Earlier"));
  down_ = widgets::named<QPushButton>("planDown", tr("Later"));
  column->addLayout(widgets::rowOf({add, copy_, remove_, nullptr, up_, down_}));
  const auto insert = [this](const session::PlanBlock& block) {
    const int at = row() < 0 ? static_cast<int>(plan_.blocks.size()) : row() + 1;
    plan_.blocks.insert(plan_.blocks.begin() + at, block);
    showList(at);
  };
  connect(add, &QPushButton::clicked, this, [insert] {
    session::PlanBlock block;
    block.experiment = "chain-moderate";
    block.trials = 20;
    insert(block);
  });
  connect(copy_, &QPushButton::clicked, this, [this, insert] { insert(plan_.blocks[static_cast<std::size_t>(row())]); });
  connect(remove_, &QPushButton::clicked, this, [this] {
    const int at = row();
    plan_.blocks.erase(plan_.blocks.begin() + at);
    showList(std::min(at, static_cast<int>(plan_.blocks.size()) - 1));
  });
  const auto move = [this](int by) {
    const int at = row();
    std::swap(plan_.blocks[static_cast<std::size_t>(at)], plan_.blocks[static_cast<std::size_t>(at + by)]);
    showList(at + by);
  };
  connect(up_, &QPushButton::clicked, this, [move] { move(-1); });
  connect(down_, &QPushButton::clicked, this, [move] { move(1); });
  return box;
}

template <typename Widget, typename Signal, typename Value, typename Get, typename Set>
void PlanComposer::bind(Widget* field, Signal signal, Value session::PlanBlock::*part, Get get, Set set) {
  fields_.push_back({[=](const session::PlanBlock& block) { std::invoke(set, field, block.*part); },
                     [=](session::PlanBlock& block) { block.*part = std::invoke(get, field); }});
  connect(field, signal, this, &PlanComposer::take);
}

QWidget* PlanComposer::makeBlock() {
  block_ = new QGroupBox(tr("This block"));
  auto* form = new QFormLayout(block_);
  using Block = session::PlanBlock;
  const auto whole = [&](const char* name, int low, int high, int Block::*part) {
    auto* made = widgets::named<QSpinBox>(name);
    made->setRange(low, high);
    bind(made, qOverload<int>(&QSpinBox::valueChanged), part, &QSpinBox::value, &QSpinBox::setValue);
    return made;
  };
  const auto number = [&](const char* name, const QString& words, double high, double Block::*part, const QString& unit = "s") {
    auto* made = widgets::named<widgets::UnitSpinBox>(name, 0, high, unit);
    made->setName(words);
    numbers_.push_back(made);
    connect(made, &widgets::UnitSpinBox::checked, this, &PlanComposer::changed);
    bind(made, qOverload<double>(&QDoubleSpinBox::valueChanged), part, &QDoubleSpinBox::value,
         [](widgets::UnitSpinBox* box, double value) { box->show(value); });
    return made;
  };
  const auto addBox = [&](QCheckBox* made, bool Block::*part) {
    bind(made, &QCheckBox::toggled, part, &QCheckBox::isChecked, &QCheckBox::setChecked);
    form->addRow(made);
  };
  auto* experiment = widgets::tipped(widgets::named<QComboBox>("planExperiment"),
                                     tr("a shipped experiment or a file. Files beside the plan are named without their folder"));
  experiment->setEditable(true);
  for (const std::string& name : experiment::shippedExperiments()) experiment->addItem(QString::fromStdString(name));
  bind(
      experiment, &QComboBox::editTextChanged, &Block::experiment, [](const QComboBox* box) { return written(box->currentText()); },
      [](QComboBox* box, const std::string& text) { box->setEditText(QString::fromStdString(text)); });
  form->addRow(tr("experiment"), experiment);
  auto* condition = widgets::named<QLineEdit>("planCondition");
  condition->setPlaceholderText(tr("the experiment's name"));
  bind(
      condition, &QLineEdit::textEdited, &Block::condition, [](const QLineEdit* edit) { return written(edit->text()); },
      [](QLineEdit* edit, const std::string& text) { edit->setText(QString::fromStdString(text)); });
  form->addRow(tr("condition"), condition);
  form->addRow(tr("trials"), whole("planTrials", 1, session::kMaxTrials, &Block::trials));
  QSpinBox* day = whole("planDay", 0, session::kMaxDay, &Block::day);
  day->setSpecialValueText(tr("every day"));
  form->addRow(tr("day"), day);
  form->addRow(tr("rest before it"), number("planRest", tr("rest before it"), session::kMaxPause, &Block::restSeconds));
  form->addRow(tr("pause between trials"), number("planPause", tr("pause between trials"), session::kMaxPause, &Block::pauseSeconds));
  form->addRow(tr("go signal after"),
               widgets::rowOf({number("planForeperiodMin", tr("earliest go signal"), session::kMaxForeperiod, &Block::foreperiodMin),
                               new QLabel(tr("to")),
                               number("planForeperiodMax", tr("latest go signal"), session::kMaxForeperiod, &Block::foreperiodMax)}));
  form->addRow(tr("share without go signal"),
               number("planCatch", tr("share without go signal"), session::kMaxCatchShare, &Block::catchShare, {}));
  addBox(widgets::named<QCheckBox>("planPractice", tr("practice: recorded, but not used in statistics")), &Block::practice);
  addBox(new QCheckBox(tr("repeat aborted trials at the end")), &Block::repeatAborted);
  auto* instructions = widgets::named<QPlainTextEdit>("planInstructions");
  instructions->setPlaceholderText(tr("what the subject reads before the block begins"));
  instructions->setTabChangesFocus(true);
  instructions->setMinimumHeight(70);
  bind(
      instructions, &QPlainTextEdit::textChanged, &Block::instructions,
      [](const QPlainTextEdit* edit) { return edit->toPlainText().toStdString(); },
      [](QPlainTextEdit* edit, const std::string& text) { edit->setPlainText(QString::fromStdString(text)); });
  form->addRow(tr("instructions"), instructions);
  return block_;
}

void PlanComposer::wire() {
  connect(list_, &QTableWidget::itemSelectionChanged, this, [this] {
    if (showing_) return;
    showBlock();
    changed();
  });
  connect(mix_, &MixEditor::changed, this, &PlanComposer::take);
  connect(name_, &QLineEdit::textEdited, this, &PlanComposer::takeWhole);
  connect(permute_, &QCheckBox::toggled, this, &PlanComposer::takeWhole);
  connect(orderSeed_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, &PlanComposer::takeWhole);
}

void PlanComposer::setPlan(const session::Plan& plan, const QString& file) {
  plan_ = plan;
  file_ = file;
  saved_ = session::toJson(plan);
  showing_ = true;
  name_->setText(QString::fromStdString(plan.name));
  permute_->setChecked(plan.counterbalance == session::Counterbalance::Permute);
  orderSeed_->setValue(static_cast<double>(plan.orderSeed));
  showing_ = false;
  showList(plan_.blocks.empty() ? -1 : 0);
}

int PlanComposer::row() const {
  const int at = list_->currentRow();
  return at >= 0 && at < static_cast<int>(plan_.blocks.size()) ? at : -1;
}

void PlanComposer::showList(int select) {
  showing_ = true;
  list_->setRowCount(static_cast<int>(plan_.blocks.size()));
  for (int i = 0; i < list_->rowCount(); ++i) showRow(i);
  list_->setCurrentCell(select, 0);
  showing_ = false;
  showBlock();
  changed();
}

void PlanComposer::showRow(int row) {
  const session::PlanBlock& block = plan_.blocks[static_cast<std::size_t>(row)];
  widgets::setTexts(*list_, row,
                    {QString::number(row + 1), QFileInfo(QString::fromStdString(block.experiment)).completeBaseName(),
                     QString::fromStdString(conditionOf(block)), QString::number(block.trials),
                     block.day == 0 ? tr("every") : QString::number(block.day), kindOf(block)});
}

void PlanComposer::showBlock() {
  const int at = row();
  block_->setEnabled(at >= 0);
  mix_->setEnabled(at >= 0);
  for (QPushButton* button : {copy_, remove_}) button->setEnabled(at >= 0);
  up_->setEnabled(at > 0);
  down_->setEnabled(at >= 0 && at + 1 < static_cast<int>(plan_.blocks.size()));
  if (at < 0) return;
  showing_ = true;
  const session::PlanBlock& block = plan_.blocks[static_cast<std::size_t>(at)];
  for (const Field& field : fields_) field.show(block);
  mix_->show(block.mix);
  showing_ = false;
}

void PlanComposer::take() {
  const int at = row();
  if (showing_ || at < 0) return;
  session::PlanBlock& block = plan_.blocks[static_cast<std::size_t>(at)];
  for (const Field& field : fields_) field.take(block);
  block.mix = mix_->mix();
  showRow(at);
  changed();
}

void PlanComposer::takeWhole() {
  if (showing_) return;
  plan_.name = written(name_->text());
  plan_.counterbalance = permute_->isChecked() ? session::Counterbalance::Permute : session::Counterbalance::None;
  plan_.orderSeed = static_cast<std::uint64_t>(orderSeed_->value());
  changed();
}

QStringList PlanComposer::faults() const {
  QStringList lines;
  if (plan_.name.empty()) lines << tr("The plan has no name. Enter a name.");
  QStringList ofBlock = mix_->faults();
  for (const widgets::UnitSpinBox* number : numbers_) ofBlock << number->fault();
  ofBlock.removeAll({});
  for (const QString& fault : ofBlock) lines << tr("block %1: %2").arg(row() + 1).arg(fault);
  if (plan_.blocks.empty()) return lines << tr("The plan has no block. Press Add.");
  for (const Fault& fault : session::problems(plan_)) lines << wordsOf(fault);
  return lines;
}

void PlanComposer::changed() {
  const QStringList wrong = faults();
  faultLabel_->setFaults(wrong);
  use_->setEnabled(wrong.isEmpty());
  preview_->setText(wrong.isEmpty() ? orderPreview(plan_, 3) : QString());
}

void PlanComposer::saveTo(const QString& file) {
  session::Plan written = plan_;
  for (session::PlanBlock& block : written.blocks) block.experiment = model::nameInFile(block.experiment, file);
  const std::string text = session::toJson(written);
  (void)session::parseProgramme(text, file.toStdString());  // a plan that would be refused replaces no good one
  record::writeFileAtomically(file.toStdString(), text);
  file_ = file;
  saved_ = session::toJson(plan_);
}

void PlanComposer::reject() {
  if (session::toJson(plan_) == saved_ ||
      widgets::askToSave(*this, tr("The plan was changed and is not saved."), [this] { return save(false); }))
    QDialog::reject();
}

bool PlanComposer::save(bool askAlways) {
  QString file = file_;
  if (askAlways || file.isEmpty()) {
    const QString proposed = file.isEmpty() ? QString::fromStdString(plan_.name) + QStringLiteral(".json") : file;
    file = QFileDialog::getSaveFileName(this, tr("Save plan"), proposed, tr("Plans (*.json)"));
    if (file.isEmpty()) return false;
    if (QFileInfo(file).suffix().isEmpty()) file += QStringLiteral(".json");
  }
  QStringList refusals;
  const QString fault = widgets::faultIn([&] {
    try {
      saveTo(file);
    } catch (const FaultError& refused) {
      for (const Fault& one : refused.faults) refusals << wordsOf(one);
    }
  });
  if (!fault.isEmpty()) refusals << fault;
  faultLabel_->setFaults(refusals);
  return refusals.isEmpty();
}

}  // namespace reachlab::gui::plan
