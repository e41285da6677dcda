#include "gui/choosers/constraint_chooser.h"

#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <filesystem>
#include <numbers>

#include "base/fault.h"
#include "constraints/constraint.h"
#include "constraints/geometry/task_path.h"
#include "constraints/regularity/undefined.h"
#include "gui/scene/thumbnail.h"
#include "gui/scene_plan/definition_reach.h"
#include "gui/widgets/ask.h"
#include "gui/widgets/fault_in.h"
#include "gui/widgets/fault_words.h"
#include "gui/widgets/named.h"
#include "sim/record/log/atomic_file.h"

namespace reachlab::gui::docks {
namespace {

QString text(const std::string& s) { return QString::fromStdString(s); }

QImage thumbnailOf(const constraints::Definition& definition, const QSize& size, double ratio) {
  return scene::drawThumbnail(scene::planScene(scene::reachOn(definition), constraints::makeConstraint(definition)), size, ratio);
}

// A formula that no file speaks of begins in the middle of what is drawn of it and goes a quarter of the way.
void givePlaces(constraints::Definition& definition) {
  if (definition.kind == constraints::ConstraintKind::Surface) {
    definition.start = {-0.5, -0.5};
    definition.target = {0.5, 0.5};
  } else {
    definition.start = {0};
    definition.target = {0.5 * std::numbers::pi};
  }
}

// Start and target are the same place, or one of them is none.
bool coincide(const constraints::Constraint& constraint, const ConstraintChoice& choice) {
  return !(norm(placeOn(constraint, choice.target) - placeOn(constraint, choice.start)) > 1e-6);
}

}  // namespace

ConstraintChooser::ConstraintChooser(QWidget* parent) : QDialog(parent), probe_(scene::reachOn({})) {
  setWindowTitle("Constraint");
  setObjectName("constraintChooser");
  widgets::resizeOnScreen(*this, {1240, 780});
  auto* columns = new QHBoxLayout(this);
  columns->addLayout(makeList());
  columns->addLayout(makePicture(), 1);
  columns->addWidget(makeSide());
  wire();
  fillList();
  if (!definitions_.empty()) list_->setCurrentRow(0);
}

QVBoxLayout* ConstraintChooser::makeList() {
  auto* left = new QVBoxLayout;
  search_ = widgets::named<QLineEdit>("search");
  search_->setPlaceholderText("search: name, kind or words");
  search_->setClearButtonEnabled(true);
  list_ = widgets::named<QListWidget>("definitions");
  list_->setIconSize({104, 72});
  list_->setUniformItemSizes(true);
  list_->setMinimumWidth(220);
  widgets::addAll(*left, {search_, list_}, list_);
  return left;
}

QVBoxLayout* ConstraintChooser::makePicture() {
  auto* middle = new QVBoxLayout;
  title_ = new QLabel;
  QFont font = title_->font();
  font.setPointSizeF(15);
  font.setWeight(QFont::DemiBold);
  title_->setFont(font);
  sentence_ = widgets::roleLabel("quiet");
  preview_ = new scene::SceneView;
  scene::OverlayState overlay;
  overlay.semaphoreShown = false;
  preview_->overlay().setState(overlay);
  widgets::addAll(*middle, {title_, sentence_, preview_}, preview_);
  return middle;
}

QWidget* ConstraintChooser::makeSide() {
  using widgets::named;
  formula_ = new FormulaEditor;
  sliders_ = new widgets::ShapeSliders;
  name_ = named<QLineEdit>("definitionName");
  name_->setPlaceholderText("name-of-mine");
  save_ = named<QPushButton>("save", "Save as definition");
  saved_ = widgets::roleLabel("quiet");
  saved_->setObjectName("saved");
  use_ = named<QPushButton>("use", "Reach on this");
  use_->setProperty("role", "go");
  refusal_ = named<widgets::FaultLabel>("refusal");
  refusal_->watch(sliders_);
  usePoint_ = named<QPushButton>("usePoint", "Reach on this with one mass");
  usePoint_->hide();
  for (QPushButton* button : {save_, use_, usePoint_}) button->setAutoDefault(false);
  auto* side = new QWidget;
  side->setFixedWidth(350);
  auto* column = widgets::filling<QVBoxLayout>(side);
  widgets::addAll(*column, {new QLabel("<b>Formula</b>"), formula_});
  column->addSpacing(8);
  widgets::addAll(*column, {new QLabel("<b>Shape</b>"), sliders_, nullptr});
  column->addLayout(widgets::rowOf({name_, save_}, name_));
  widgets::addAll(*column, {saved_, use_, refusal_, usePoint_});
  return side;
}

void ConstraintChooser::wire() {
  connect(search_, &QLineEdit::textChanged, this, &ConstraintChooser::filter);
  connect(list_, &QListWidget::currentRowChanged, this, [this](int row) {
    if (row >= 0 && static_cast<std::size_t>(row) < definitions_.size()) show(definitions_[static_cast<std::size_t>(row)], {});
  });
  connect(formula_, &FormulaEditor::changed, this, &ConstraintChooser::formulaChanged);
  connect(sliders_, &widgets::ShapeSliders::moved, this, [this] { rebuild(false); });
  connect(save_, &QPushButton::clicked, this, &ConstraintChooser::save);
  for (QPushButton* button : {use_, usePoint_})
    connect(button, &QPushButton::clicked, this, [this, withPoint = button == usePoint_] {
      if (!choice_) return;
      ConstraintChoice choice = *choice_;
      choice.withPoint = withPoint;
      Q_EMIT used(choice);
    });
}

void ConstraintChooser::fillList() {
  const QSignalBlocker quiet(list_);
  list_->clear();
  definitions_ = constraints::catalogue();
  std::vector<Fault> faults;
  for (constraints::Definition& own : constraints::readDefinitionFolder(constraints::userDefinitionFolder(), faults))
    definitions_.push_back(std::move(own));
  if (!faults.empty()) saved_->setText(widgets::inWords(faults).join(QLatin1Char('\n')));
  for (const constraints::Definition& d : definitions_) {
    auto* item = new QListWidgetItem(
        QStringLiteral("%1\n%2").arg(text(d.name), d.kind == constraints::ConstraintKind::Surface ? "surface" : "curve"));
    item->setData(Qt::UserRole, (text(d.name) + QLatin1Char(' ') + item->text() + QLatin1Char(' ') + text(d.sentence)).toLower());
    const QString fault =
        widgets::faultIn([&] { item->setIcon(QIcon(QPixmap::fromImage(thumbnailOf(d, list_->iconSize(), devicePixelRatioF())))); });
    item->setToolTip(fault.isEmpty() ? text(d.sentence) : fault);
    list_->addItem(item);
  }
  filter(search_->text());
}

void ConstraintChooser::filter(const QString& words) {
  const QStringList wanted = words.toLower().split(QLatin1Char(' '), Qt::SkipEmptyParts);
  for (int i = 0; i < list_->count(); ++i) {
    const QString hay = list_->item(i)->data(Qt::UserRole).toString();
    list_->item(i)->setHidden(!std::all_of(wanted.begin(), wanted.end(), [&](const QString& w) { return hay.contains(w); }));
  }
}

void ConstraintChooser::answer(const QStringList& faults) {
  refusal_->setFaults(faults);
  usePoint_->setVisible(!faults.isEmpty() && severalMasses_);
  if (faults.isEmpty()) close();
}

void ConstraintChooser::setCurrent(const experiment::Experiment& experiment) {
  severalMasses_ = experiment.object.masses.size() > 1;
  refusal_->hide();
  usePoint_->hide();
  const constraints::ConstraintSpec& spec = experiment.constraint;
  for (std::size_t i = 0; i < definitions_.size(); ++i)
    if (spec.curve.empty() && spec.surface.empty() && definitions_[i].name == spec.name) {
      widgets::quietly(list_)->setCurrentRow(static_cast<int>(i));
      show(definitions_[i], spec.shape);
      return;
    }
}

void ConstraintChooser::show(const constraints::Definition& definition, const std::map<std::string, double>& shape) {
  current_ = definition;
  title_->setText(text(definition.name));
  sentence_->setText(text(definition.sentence) +
                     (definition.source.empty() ? QString() : QStringLiteral("  [%1]").arg(text(definition.source))));
  formula_->setFormula(definition.kind, definition.coordinates);
  sliders_->setParameters(definition.shape, shape);
  rebuild(true);
}

bool ConstraintChooser::isTyped() const {
  return current_.name.empty() || formula_->kind() != current_.kind || formula_->coordinates() != current_.coordinates;
}

constraints::Definition ConstraintChooser::typedDefinition() const {
  constraints::Definition d = current_;
  d.kind = formula_->kind();
  d.coordinates = formula_->coordinates();
  if (d.kind != current_.kind) {
    d.domain = {};
    givePlaces(d);
  }
  d.shape.clear();
  for (const std::string& name : parameterNames(d.kind, d.coordinates)) {
    constraints::ShapeParameter p{name, 0.1, -1, 1, "1", "typed"};
    for (const constraints::ShapeParameter& known : current_.shape)
      if (known.name == name) p = known;
    d.shape.push_back(p);
  }
  return d;
}

void ConstraintChooser::formulaChanged() {
  use_->setEnabled(formula_->fine());
  save_->setEnabled(formula_->fine());
  constraints::Definition typed = typedDefinition();
  const auto values = sliders_->values();
  if (!formula_->fine()) {
    choice_.reset();
    // Of "sin" typed letter by letter, "s" and "si" were names of sliders for a moment.
    std::erase_if(typed.shape, [&](const constraints::ShapeParameter& p) { return !values.contains(p.name); });
    if (typed.shape.size() < values.size()) sliders_->setParameters(typed.shape, values);
    return;
  }
  const std::string before = current_.name;
  if (!before.empty() && isTyped()) {
    typed.name.clear();
    typed.domain = {};  // another formula's ends are not this one's
    typed.sentence = "typed; after " + before;
    typed.source.clear();
    title_->setText("typed formula");
    sentence_->setText("as typed at the right; the picture follows");
    widgets::quietly(list_)->setCurrentRow(-1);
  }
  const bool sameNames =
      typed.shape.size() == values.size() &&
      std::all_of(typed.shape.begin(), typed.shape.end(), [&](const constraints::ShapeParameter& p) { return values.contains(p.name); });
  current_ = typed;
  if (!sameNames) sliders_->setParameters(typed.shape, values);
  rebuild(true);
}

void ConstraintChooser::rebuild(bool resetCamera) {
  choice_.reset();
  refusal_->hide();  // it was another choice's
  usePoint_->hide();
  ConstraintChoice choice;
  choice.start = current_.start;
  choice.target = current_.target;
  if (current_.name.empty()) {
    const std::vector<std::string> lines(current_.coordinates.begin(), current_.coordinates.end());
    (current_.kind == constraints::ConstraintKind::Surface ? choice.spec.surface : choice.spec.curve) = lines;
    choice.spec.name = current_.kind == constraints::ConstraintKind::Surface ? "surface" : "curve";
  } else {
    choice.spec.name = current_.name;
  }
  choice.spec.shape = sliders_->values();
  formula_->setFault(widgets::faultIn([&] {
    const constraints::Constraint constraint = current_.name.empty() ? constraints::makeConstraint(choice.spec, "formula")
                                                                     : constraints::makeConstraint(current_, choice.spec.shape);
    if (current_.name.empty() && coincide(constraint, choice)) {  // after another formula's places: nowhere to go
      givePlaces(current_);
      choice.start = current_.start;
      choice.target = current_.target;
    }
    if (std::optional<Fault> fault = constraints::undefinedFault(constraint, scene::drawnDomain(constraint, choice.start, choice.target)))
      throw FaultError(std::move(*fault));
    probe_.constraint = choice.spec;
    probe_.task->start = choice.start;
    probe_.task->target = choice.target;
    preview_->setPlan(scene::planScene(probe_, constraint), resetCamera);
    choice_ = choice;
  }));
  use_->setEnabled(choice_.has_value());
  save_->setEnabled(choice_.has_value());
}

void ConstraintChooser::save() {
  const std::string name = name_->text().trimmed().toLower().replace(QLatin1Char(' '), QLatin1Char('-')).toStdString();
  constraints::Definition d = current_;
  d.name = name;
  d.shape = sliders_->parameters();
  const auto values = sliders_->values();
  for (constraints::ShapeParameter& p : d.shape) p.defaultValue = values.at(p.name);
  const QString fault = widgets::faultIn([&] {
    if (name.empty()) throw FaultError(Fault{.what = "The definition has no valid name. Use lower-case words joined by '-'."});
    if (constraints::findInCatalogue(name) != nullptr)
      throw FaultError(Fault{.what = "Another definition has this name. Choose another name than " + name});
    const std::string content = constraints::toJson(d);
    namespace fs = std::filesystem;
    const fs::path folder = constraints::userDefinitionFolder(), file = folder / (name + ".json");
    (void)constraints::parseDefinition(content, file.string());  // nothing is saved that could not be read again
    if (fs::exists(file) &&
        !widgets::ask(*this, "askAboutDefinition", "A definition of this name",
                      QStringLiteral("You have saved a definition %1 before.").arg(text(name)), "Replace it", "Keep it"))
      return;
    record::writeFileAtomically(file.string(), content);
    saved_->setText(QStringLiteral("saved as %1").arg(text(file.string())));
    fillList();
    for (std::size_t i = 0; i < definitions_.size(); ++i)
      if (definitions_[i].name == name) list_->setCurrentRow(static_cast<int>(i));
  });
  if (!fault.isEmpty()) saved_->setText(fault);
}

}  // namespace reachlab::gui::docks
