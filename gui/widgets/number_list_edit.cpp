#include "gui/widgets/number_list_edit.h"

#include <QLocale>
#include <QRegularExpression>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "constraints/formula/expression.h"
#include "constraints/formula/parser.h"
#include "gui/widgets/theme.h"

namespace reachlab::gui::widgets {
namespace {

// Nothing behind it but the number: "5 x 0.6" gives five parts "0.6". "3*pi/4" is one number.
QStringList partsOf(QString text, const NumberListRule& rule) {
  static const QRegularExpression repeated("^\\s*(\\d{1,3})\\s*([x×*])\\s*(\\S+)\\s*$"), blanks("[\\s;]+"), around("\\s*([*/])\\s*"),
      unit("(?<=[\\d.)i])\\s+m(?=[\\s;]|$)"), before("(?<=\\d)pi");
  if (rule.formulas) {
    text.replace("π", "pi");
    text.replace(before, "*pi");
  }
  const bool ofPi = rule.formulas && text.contains(QLatin1String("pi"));
  if (ofPi) text.replace(around, "\\1");
  if (rule.atLength) text.replace(unit, "m");
  if (const auto match = repeated.match(text); match.hasMatch() && !(ofPi && match.captured(2) == QLatin1String("*"))) {
    QStringList parts;
    for (int i = match.captured(1).toInt(); i > 0; --i) parts << match.captured(3);
    return parts;
  }
  return text.split(blanks, Qt::SkipEmptyParts);
}

std::optional<double> plainNumber(const QString& part, bool formulas) {
  bool fine = false;
  double value = QLocale::c().toDouble(part, &fine);
  if (!fine && formulas) {
    constraints::ExpressionGraph graph;
    const constraints::ParsedFormula parsed = constraints::parseFormula(part.toStdString(), {}, graph);
    fine = !parsed.fault && graph.isConstant(parsed.root);
    if (fine) value = graph.node(parsed.root).value;
  }
  return fine && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

// [m] of "0.2m".
std::optional<double> lengthOf(const QString& part, const NumberListRule& rule) {
  return rule.atLength && part.endsWith(QLatin1Char('m')) ? plainNumber(part.chopped(1), rule.formulas) : std::nullopt;
}

std::optional<double> numberOf(const QString& part, const NumberListRule& rule) {
  if (const auto length = lengthOf(part, rule)) {
    const double value = rule.atLength(*length);
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  }
  return plainNumber(part, rule.formulas);
}

QString shortest(double value) { return QString::number(value, 'g', QLocale::FloatingPointShortest); }

// "3*pi/4" for that very number, else empty.
QString fractionOfPi(double value) {
  for (const int parts : {1, 2, 3, 4, 5, 6, 8, 12}) {
    const double many = std::round(value * parts / std::numbers::pi);
    if (many == 0 || std::abs(many) > 24 || many * std::numbers::pi / parts != value) continue;
    const QString times = std::abs(many) == 1 ? "pi" : QStringLiteral("%1*pi").arg(std::abs(many));
    return (many < 0 ? "-" : QString()) + times + (parts == 1 ? QString() : QStringLiteral("/%1").arg(parts));
  }
  return {};
}

QString withUnit(const QString& number, const QString& unit) { return unit.isEmpty() ? number : number + QLatin1Char(' ') + unit; }

}  // namespace

QString textOf(const std::vector<double>& numbers, const NumberListRule& rule) {
  if (numbers.size() > 2 && std::all_of(numbers.begin(), numbers.end(), [&](double v) { return v == numbers[0]; }))
    return QStringLiteral("%1 x %2").arg(numbers.size()).arg(shortest(numbers[0]));
  QStringList parts;
  for (const double v : numbers) {
    const QString fraction = rule.formulas ? fractionOfPi(v) : QString();
    parts << (fraction.isEmpty() ? shortest(v) : fraction);
  }
  return parts.join(QLatin1Char(' '));
}

std::optional<std::vector<double>> numbersOf(const QString& text, const NumberListRule& rule) {
  std::vector<double> numbers;
  for (const QString& part : partsOf(text, rule)) {
    const auto value = numberOf(part, rule);
    if (!value) return std::nullopt;
    numbers.push_back(*value);
  }
  return numbers;
}

QString faultOf(const QString& text, const NumberListRule& rule) {
  const QStringList parts = partsOf(text, rule);
  for (const QString& part : parts) {
    if (numberOf(part, rule)) continue;
    if (lengthOf(part, rule)) return QStringLiteral("%1: the curve ends before %2; allowed: a shorter length").arg(rule.list, part);
    QString allowed = rule.formulas ? "numbers such as 0.6, pi/2 or 3*pi/4" : "numbers such as 0.6";
    if (rule.atLength) allowed += ", or a length such as 0.2 m";
    if (rule.most > 1) allowed += ", with blanks between";
    if (rule.most > 2) allowed += ", or 5 x 0.6";
    return QStringLiteral("%1: \"%2\" is no number; allowed: %3").arg(rule.list, part, allowed);
  }
  for (int i = 0; i < parts.size(); ++i) {
    const double value = *numberOf(parts[i], rule);
    if (rule.lowAllowed ? value >= rule.low : value > rule.low) continue;
    const QString name = i < rule.names.size() ? rule.names[i] : QString::number(i + 1);
    return QStringLiteral("%1 %2: %3; allowed: %4")
        .arg(rule.item, name, withUnit(shortest(value), rule.unit),
             rule.lowAllowed ? shortest(rule.low) + " or more" : "more than " + shortest(rule.low));
  }
  const auto count = static_cast<std::size_t>(parts.size());
  if (count >= rule.fewest && count <= rule.most && count % rule.multipleOf == 0) return {};
  QString allowed = rule.fewest == rule.most ? QString::number(rule.most) : QStringLiteral("%1 to %2").arg(rule.fewest).arg(rule.most);
  if (rule.multipleOf > 1) allowed += QStringLiteral(", in groups of %1").arg(rule.multipleOf);
  if (!rule.names.isEmpty()) allowed += QStringLiteral(" (%1)").arg(rule.names.join(", "));
  return QStringLiteral("%1: %2; allowed: %3")
      .arg(rule.list, count == 0 ? "none" : QStringLiteral("%1 number%2").arg(count).arg(count == 1 ? QString() : "s"), allowed);
}

NumberListEdit::NumberListEdit(QWidget* parent) : QLineEdit(parent) {
  connect(this, &QLineEdit::textEdited, this, [this] { mark(), Q_EMIT checked(); });
  connect(this, &QLineEdit::editingFinished, this, [this] {
    const auto now = numbers();
    if (!fault().isEmpty() || (*now == shown_ && *now == told_)) return;
    if (std::exchange(telling_, true)) return;  // a question that this one raised takes the focus: the same entry again
    told_ = *now;
    Q_EMIT numbersEdited();
    telling_ = false;
  });
}

void NumberListEdit::setRule(const NumberListRule& rule) {
  rule_ = rule;
  setAccessibleName(rule.list);
  mark();
}

void NumberListEdit::setNumbers(const std::vector<double>& numbers) {
  const bool beingTyped = numbers == shown_ && !numbersOf(text(), rule_);
  shown_ = told_ = numbers;
  if (!beingTyped) setText(textOf(numbers, rule_));
  if (!hasFocus()) setCursorPosition(0);  // a list that is too long for the field is read from its beginning
  mark();
}

void NumberListEdit::mark() {
  const QString style = fault().isEmpty() ? QString() : faultyField();
  if (styleSheet() != style) setStyleSheet(style);
}

std::optional<std::vector<double>> NumberListEdit::numbers() const { return numbersOf(text(), rule_); }
QString NumberListEdit::fault() const { return isEnabled() ? faultOf(text(), rule_) : QString(); }

}  // namespace reachlab::gui::widgets
