#pragma once
#include <QLineEdit>
#include <QStringList>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace reachlab::gui::widgets {

/// The allowed content of a list of numbers, and its name in messages.
struct NumberListRule {
  QString list = "numbers";  // "masses"
  QString item = {};         // "mass": the second is "mass 2"
  QStringList names = {};    // of the single numbers where they have any: "u", "v"
  QString unit = {};
  double low = -std::numeric_limits<double>::infinity();
  bool lowAllowed = true;
  std::size_t fewest = 0, most = 512, multipleOf = 1;
  bool formulas = false;  // "pi/2" and "3*pi/4" are numbers, too, and are shown so
  /// The number that "0.2 m" stands for. NaN: no value. Empty: no lengths are allowed.
  std::function<double(double metres)> atLength = {};
};

/// Several numbers in one line, parted by blanks: "0.6 0.6 0.6" or "5 x 0.6". Red while the rule does not hold.
class NumberListEdit : public QLineEdit {
  Q_OBJECT
 public:
  explicit NumberListEdit(QWidget* parent = nullptr);
  void setRule(const NumberListRule& rule);
  /// Displays numbers. A faulty text that the user is typing stays if the numbers behind it are unchanged.
  void setNumbers(const std::vector<double>& numbers);
  std::optional<std::vector<double>> numbers() const;
  /// The fault of the text, in a sentence. Empty if there is no fault.
  QString fault() const;

 Q_SIGNALS:
  /// Enter or leaving the field, with a new list of numbers that keeps the rule.
  void numbersEdited();
  /// Emitted at every keystroke, because `fault` may have changed.
  void checked();

 private:
  void mark();

  NumberListRule rule_;
  std::vector<double> shown_, told_;
  bool telling_ = false;
};

/// "5 x 0.6" where all are equal. Shortest text that reads back the same.
QString textOf(const std::vector<double>& numbers, const NumberListRule& rule = {});
std::optional<std::vector<double>> numbersOf(const QString& text, const NumberListRule& rule = {});
/// "mass 2: -0.6 kg; allowed: more than 0". Empty if the text keeps the rule.
QString faultOf(const QString& text, const NumberListRule& rule);

}  // namespace reachlab::gui::widgets
