#include "gui/number_list_edit.h"

#include <QLocale>
#include <QRegularExpression>
#include <algorithm>
#include <cmath>

namespace reachlab {

QString textOf(const std::vector<double>& numbers) {
  const auto text = [](double v) { return QString::number(v, 'g', QLocale::FloatingPointShortest); };
  if (numbers.size() > 2 && std::all_of(numbers.begin(), numbers.end(), [&](double v) { return v == numbers[0]; }))
    return QStringLiteral("%1 x %2").arg(numbers.size()).arg(text(numbers[0]));
  QStringList parts;
  for (const double v : numbers) parts << text(v);
  return parts.join(QLatin1Char(' '));
}

std::optional<std::vector<double>> numbersOf(const QString& text) {
  static const QRegularExpression repeated(QStringLiteral("^\\s*(\\d{1,3})\\s*[x×*]\\s*(\\S+)\\s*$"));
  bool fine = false;
  if (const auto match = repeated.match(text); match.hasMatch()) {
    const double value = QLocale::c().toDouble(match.captured(2), &fine);
    if (!fine || !std::isfinite(value)) return std::nullopt;
    return std::vector<double>(match.captured(1).toUInt(), value);
  }
  std::vector<double> numbers;
  for (const QString& part : text.split(QRegularExpression(QStringLiteral("[\\s;]+")), Qt::SkipEmptyParts)) {
    const double value = QLocale::c().toDouble(part, &fine);
    if (!fine || !std::isfinite(value)) return std::nullopt;
    numbers.push_back(value);
  }
  return numbers;
}

NumberListEdit::NumberListEdit(QWidget* parent) : QLineEdit(parent) {
  connect(this, &QLineEdit::textEdited, this, [this] { setStyleSheet(numbers() ? QString() : QStringLiteral("color: #ff9d8c;")); });
  connect(this, &QLineEdit::editingFinished, this, [this] {
    const auto now = numbers();
    if (!now || *now == shown_) return;
    shown_ = *now;
    Q_EMIT numbersEdited();
  });
}

void NumberListEdit::setNumbers(const std::vector<double>& numbers) {
  shown_ = numbers;
  setText(textOf(numbers));
  setStyleSheet({});
}

std::optional<std::vector<double>> NumberListEdit::numbers() const { return numbersOf(text()); }

}  // namespace reachlab
