#pragma once
#include <QLabel>
#include <QPainter>
#include <QStyle>

namespace reachlab::gui::widgets {

/// One line of text that ends in "…" if the line is too short. The tool tip has the whole text.
class ElidedLabel : public QLabel {
 public:
  void tell(const QString& line) {
    setText(line);
    setToolTip(line);
  }
  QSize minimumSizeHint() const override { return {120, QLabel::minimumSizeHint().height()}; }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    style()->drawItemText(&painter, contentsRect(), Qt::AlignLeft | Qt::AlignVCenter, palette(), isEnabled(),
                          fontMetrics().elidedText(text(), Qt::ElideRight, contentsRect().width()), foregroundRole());
  }
};

}  // namespace reachlab::gui::widgets
