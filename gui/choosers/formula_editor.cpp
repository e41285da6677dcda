#include "gui/choosers/formula_editor.h"

#include <QComboBox>
#include <QFontDatabase>
#include <QGridLayout>
#include <QLineEdit>
#include <QRegularExpression>
#include <algorithm>
#include <set>
#include <string_view>

#include "constraints/formula/formula.h"
#include "gui/widgets/named.h"

namespace reachlab::gui::docks {

namespace {

// One letter changed, left out, too many, or two neighbours swapped.
bool oneLetterApart(std::string_view a, std::string_view b) {
  while (!a.empty() && !b.empty() && a.front() == b.front()) a.remove_prefix(1), b.remove_prefix(1);
  while (!a.empty() && !b.empty() && a.back() == b.back()) a.remove_suffix(1), b.remove_suffix(1);
  if (a.size() == 2 && b.size() == 2) return a[0] == b[1] && a[1] == b[0];
  return std::max(a.size(), b.size()) == 1;
}

}  // namespace

std::vector<std::string> parameterNames(constraints::ConstraintKind kind, const std::array<std::string, 3>& coordinates) {
  static const std::set<std::string> known{"pi",   "e",    "sin",  "cos", "tan", "asin", "acos", "atan", "atan2",
                                           "sinh", "cosh", "tanh", "exp", "log", "sqrt", "abs",  "sign"};
  static const QRegularExpression name("(?<![0-9A-Za-z_.])[A-Za-z_][A-Za-z0-9_]*+(?!\\s*\\()");
  const std::vector<std::string> variables = constraints::variablesOf(kind);
  std::vector<std::string> names;
  for (const std::string& line : coordinates) {
    auto matches = name.globalMatch(QString::fromStdString(line));
    while (matches.hasNext()) {
      const std::string found = matches.next().captured(0).toStdString();
      const auto in = [&](const auto& list) { return std::find(list.begin(), list.end(), found) != list.end(); };
      if (!in(known) && !in(variables) && !in(names) && names.size() < constraints::kMaxShapeParameters) names.push_back(found);
    }
  }
  return names;
}

std::string variableMeant(constraints::ConstraintKind kind, const std::string& name) {
  for (const std::string& variable : constraints::variablesOf(kind)) {
    if (QString::fromStdString(name).toLower() == QString::fromStdString(variable)) return variable;
    const bool single = variable.size() == 1;  // any letter is one letter away from u: only a doubled one is a slip
    if (single ? name == variable + variable : oneLetterApart(name, variable)) return variable;
  }
  return {};
}

FormulaEditor::FormulaEditor(QWidget* parent) : QWidget(parent) {
  auto* grid = widgets::filling<QGridLayout>(this);
  grid->setVerticalSpacing(2);
  kind_ = widgets::named<QComboBox>("formulaKind");
  kind_->addItems({"curve in phi", "surface in u, v"});
  grid->addWidget(kind_, 0, 0, 1, 2);
  for (std::size_t i = 0; i < 3; ++i) {
    const int row = 1 + 2 * static_cast<int>(i);
    const QLatin1Char axis("xyz"[i]);
    lines_[i] = new QLineEdit;
    lines_[i]->setObjectName(QStringLiteral("formula_%1").arg(axis));
    lines_[i]->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
    lines_[i]->setMaxLength(10000);
    faults_[i] = new widgets::FaultLabel;
    faults_[i]->setObjectName(QStringLiteral("fault_%1").arg(axis));
    grid->addWidget(new QLabel(QStringLiteral("%1 =").arg(axis)), row, 0);
    grid->addWidget(lines_[i], row, 1);
    grid->addWidget(faults_[i], row + 1, 1);
    connect(lines_[i], &QLineEdit::textChanged, this, [this] { check(), Q_EMIT changed(); });
  }
  fault_ = widgets::named<widgets::FaultLabel>("fault");
  grid->addWidget(fault_, 7, 0, 1, 2);
  grid->addWidget(widgets::roleLabel("quiet",
                                     "metres; + − * / ^ ( ) pi e, sin cos tan asin acos atan atan2 sinh cosh tanh exp log sqrt abs sign; "
                                     "any other name becomes a slider"),
                  8, 0, 1, 2);
  connect(kind_, qOverload<int>(&QComboBox::activated), this, [this] { check(), Q_EMIT changed(); });
}

void FormulaEditor::setFormula(constraints::ConstraintKind kind, const std::array<std::string, 3>& coordinates) {
  widgets::quietly(kind_)->setCurrentIndex(kind == constraints::ConstraintKind::Surface ? 1 : 0);
  for (std::size_t i = 0; i < 3; ++i) {
    widgets::quietly(lines_[i])->setText(QString::fromStdString(coordinates[i]));
    lines_[i]->setCursorPosition(0);
  }
  check();
}

constraints::ConstraintKind FormulaEditor::kind() const {
  return kind_->currentIndex() == 1 ? constraints::ConstraintKind::Surface : constraints::ConstraintKind::Curve;
}

std::array<std::string, 3> FormulaEditor::coordinates() const {
  return {lines_[0]->text().toStdString(), lines_[1]->text().toStdString(), lines_[2]->text().toStdString()};
}

void FormulaEditor::setFault(const QString& fault) { fault_->setFaults({fault}); }

void FormulaEditor::check() {
  const auto text = coordinates();
  const std::vector<constraints::FormulaFault> found = constraints::formulaFaults({kind(), text, parameterNames(kind(), text)});
  fine_ = found.empty();
  std::array<QString, 3> messages;
  for (const constraints::FormulaFault& fault : found) {
    QString& message = messages[static_cast<std::size_t>(std::clamp(fault.coordinate, 0, 2))];
    if (!message.isEmpty()) continue;  // the first says most
    message = QStringLiteral("character %1: %2").arg(fault.character).arg(QString::fromStdString(fault.what));
    if (!fault.allowed.empty()) message += "; allowed: " + QString::fromStdString(fault.allowed);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    lines_[i]->setStyleSheet(messages[i].isEmpty() ? QString() : "border: 1px solid #c0564a;");
    if (messages[i].isEmpty())  // fine as it stands; still a slip of the finger is asked about
      for (const std::string& name : parameterNames(kind(), {text[i], {}, {}}))
        if (const std::string meant = variableMeant(kind(), name); !meant.empty() && messages[i].isEmpty())
          messages[i] =
              QStringLiteral("%1 becomes a slider; did you mean %2?").arg(QString::fromStdString(name), QString::fromStdString(meant));
    faults_[i]->setFaults({messages[i]});
  }
  if (!fine_) setFault({});
}

}  // namespace reachlab::gui::docks
