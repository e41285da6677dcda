#include "gui/widgets/number_list_edit.h"

#include <QLocale>
#include <QRegularExpression>
#include <algorithm>
#include <utility>
#include <cmath>

namespace reachlab::gui::widgets {
namespace {

// Nothing behind it but the number: "5 x 0.6" gives five parts "0.6".
QStringList partsOf(const QString& text) {
  static const QRegularExpression repeated(QStringLiteral("^\\s*(\\d{1,3})\\s*[x×*]\\s*(\\S+)\\s*$"));
  static const QRegularExpression blanks(QStringLiteral("[\\s;]+"));
  if (const auto match = repeated.match(text); match.hasMatch()) {
    QStringList parts;
    for (int i = match.captured(1).toInt(); i > 0; --i) parts << match.captured(2);
    return parts;
  }
  return text.split(blanks, Qt::SkipEmptyParts);
}

std::optional<double> numberOf(const QString& part) {
  bool fine = false;
  const double value = QLocale::c().toDouble(part, &fine);
  return fine && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

QString shortest(double value) { return QString::number(value, 'g', QLocale::FloatingPointShortest); }

QString withUnit(const QString& number, const QString& unit) { return unit.isEmpty() ? number : number + QLatin1Char(' ') + unit; }

}  // namespace

QString textOf(const std::vector<double>& numbers) {
  if (numbers.size() > 2 && std::all_of(numbers.begin(), numbers.end(), [&](double v) { return v == numbers[0]; }))
    return QStringLiteral("%1 x %2").arg(numbers.size()).arg(shortest(numbers[0]));
  QStringList parts;
  for (const double v : numbers) parts << shortest(v);
  return parts.join(QLatin1Char(' '));
}

std::optional<std::vector<double>> numbersOf(const QString& text) {
  std::vector<double> numbers;
  for (const QString& part : partsOf(text)) {
    const auto value = numberOf(part);
    if (!value) return std::nullopt;
    numbers.push_back(*value);
  }
  return numbers;
}

QString faultOf(const QString& text, const NumberListRule& rule) {
  const QStringList parts = partsOf(text);
  for (const QString& part : parts)
    if (!numberOf(part))
      return QStringLiteral("%1: \"%2\" is no number; allowed: numbers such as 0.6 with blanks between, or 5 x 0.6").arg(rule.list, part);
  for (int i = 0; i < parts.size(); ++i) {
    const double value = *numberOf(parts[i]);
    if (rule.lowAllowed ? value >= rule.low : value > rule.low) continue;
    const QString name = i < rule.names.size() ? rule.names[i] : QString::number(i + 1);
    return QStringLiteral("%1 %2: %3; allowed: %4")
        .arg(rule.item, name, withUnit(shortest(value), rule.unit),
             rule.lowAllowed ? shortest(rule.low) + QStringLiteral(" or more") : QStringLiteral("more than ") + shortest(rule.low));
  }
  const auto count = static_cast<std::size_t>(parts.size());
  if (count >= rule.fewest && count <= rule.most && count % rule.multipleOf == 0) return {};
  QString allowed = rule.fewest == rule.most ? QString::number(rule.most) : QStringLiteral("%1 to %2").arg(rule.fewest).arg(rule.most);
  if (rule.multipleOf > 1) allowed += QStringLiteral(", in groups of %1").arg(rule.multipleOf);
  if (!rule.names.isEmpty()) allowed += QStringLiteral(" (%1)").arg(rule.names.join(QStringLiteral(", ")));
  return QStringLiteral("%1: %2; allowed: %3")
      .arg(rule.list,
           count == 0 ? QStringLiteral("none") : QStringLiteral("%1 number%2").arg(count).arg(count == 1 ? QString() : QStringLiteral("s")),
           allowed);
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
  const bool beingTyped = numbers == shown_ && !numbersOf(text());
  shown_ = told_ = numbers;
  if (!beingTyped) setText(textOf(numbers));
  if (!hasFocus()) setCursorPosition(0);  // a list that is too long for the field is read from its beginning
  mark();
}

void NumberListEdit::mark() {
  const QString style = fault().isEmpty() ? QString() : QStringLiteral("color: #ff9d8c; border: 1px solid #c0564a;");
  if (styleSheet() != style) setStyleSheet(style);
}

std::optional<std::vector<double>> NumberListEdit::numbers() const { return numbersOf(text()); }
QString NumberListEdit::fault() const { return isEnabled() ? faultOf(text(), rule_) : QString(); }

}  // namespace reachlab::gui::widgets
