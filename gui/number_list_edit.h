#pragma once
#include <QLineEdit>
#include <optional>
#include <vector>

namespace reachlab {

/// Several numbers in one line, parted by blanks: "0.6 0.6 0.6" or "5 x 0.6". Red while it is no list of numbers.
class NumberListEdit : public QLineEdit {
  Q_OBJECT
 public:
  explicit NumberListEdit(QWidget* parent = nullptr);
  void setNumbers(const std::vector<double>& numbers);
  std::optional<std::vector<double>> numbers() const;

 Q_SIGNALS:
  /// Enter or leaving the field, with a new list of numbers.
  void numbersEdited();

 private:
  std::vector<double> shown_;
};

/// "5 x 0.6" where all are equal. Shortest decimal that reads back the same.
QString textOf(const std::vector<double>& numbers);
std::optional<std::vector<double>> numbersOf(const QString& text);

}  // namespace reachlab
