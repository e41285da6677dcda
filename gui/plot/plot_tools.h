#pragma once
// Tools of every plot of the window, for files that are compiled with Qwt's headers (gui/CMakeLists.txt).
#include <qwt_global.h>
#include <qwt_legend.h>
#include <qwt_painter.h>
#include <qwt_plot.h>
#include <qwt_plot_canvas.h>
#include <qwt_plot_curve.h>
#include <qwt_plot_grid.h>
#include <qwt_plot_layout.h>
#include <qwt_plot_marker.h>
#include <qwt_plot_renderer.h>
#include <qwt_plot_zoomer.h>
#include <qwt_symbol.h>
#include <qwt_text.h>

#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QSaveFile>
#include <QTextStream>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "gui/plot/line_style.h"
#include "gui/widgets/theme.h"

namespace reachlab::gui::plot {

inline QwtText axisTitle(const QString& text) {
  QwtText title(text);
  QFont font;
  font.setPointSizeF(10);
  title.setFont(font);
  title.setColor(widgets::toQColor(widgets::colours::kFaintText));
  return title;
}

/// Gives the left axis this title, and fits title and numbers to the length of the axis.
inline void fitLeftAxis(QwtPlot& plot, const QString& words) {
  constexpr double kMost = 10, kLeast = 6;  // [pt]
  const double length = plot.canvas()->height();
  QwtText title = axisTitle(words);
  QFont font = title.font();
  font.setPointSizeF(kMost);
  const double needed = QFontMetricsF(font).horizontalAdvance(words) + 8;
  font.setPointSizeF(std::clamp(kMost * length / needed, kLeast, kMost));
  title.setFont(font);
  plot.setAxisTitle(QwtPlot::yLeft, title);
  const double row = 1.8 * QFontMetricsF(plot.axisFont(QwtPlot::yLeft)).height();
  const int rows = std::clamp(static_cast<int>(length / row), 1, 8);
  if (rows == plot.axisMaxMajor(QwtPlot::yLeft)) return;
  plot.setAxisMaxMajor(QwtPlot::yLeft, rows);
  plot.updateAxes();
}

/// A canvas whose left axis fits to it, whatever its size is.
class FittedCanvas : public QwtPlotCanvas {
  using QwtPlotCanvas::QwtPlotCanvas;
  void resizeEvent(QResizeEvent* event) override {
    QwtPlotCanvas::resizeEvent(event);
    fitLeftAxis(*plot(), plot()->axisTitle(QwtPlot::yLeft).text());
  }
};

/// Canvas and grid of a plot, in the theme's colours. The plot owns both.
inline QwtPlotCanvas* dress(QwtPlot& plot) {
  // Qwt would draw a line in pieces and start the dashes again in each. In a small plot a piece is shorter than a dash and looks solid.
  QwtPainter::setPolylineSplitting(false);
  auto* canvas = new FittedCanvas(&plot);
  canvas->setFrameStyle(QFrame::NoFrame);
  canvas->setAutoFillBackground(true);
  canvas->setFocusPolicy(Qt::ClickFocus);  // it shows no focus, and nothing is typed in it
  QPalette palette = canvas->palette();
  palette.setColor(QPalette::Window, widgets::toQColor(widgets::colours::kBase));
  canvas->setPalette(palette);
  plot.setCanvas(canvas);
  plot.plotLayout()->setAlignCanvasToScales(true);
  auto* grid = new QwtPlotGrid;
  grid->setPen(QPen(widgets::ink(26), 0));
  grid->attach(&plot);
  return canvas;
}

inline void setAxisFonts(QwtPlot& plot) {
  QFont font;
  font.setPointSizeF(9.5);
  for (const int axis : {int{QwtPlot::xBottom}, int{QwtPlot::yLeft}}) plot.setAxisFont(axis, font);
}

/// For present and later lines of the plot. The plot owns it.
inline void addLegend(QwtPlot& plot) {
  auto* legend = new QwtLegend;
  legend->setDefaultItemMode(QwtLegendData::ReadOnly);
  plot.insertLegend(legend, QwtPlot::RightLegend);
}

/// A line, which the legend shows if it has a title.
inline std::unique_ptr<QwtPlotCurve> makeCurve(QwtPlot& plot, const QString& title, const QPen& pen, double z,
                                               std::unique_ptr<QwtPlotCurve> curve = std::make_unique<QwtPlotCurve>()) {
  curve->setTitle(title);
  curve->setPen(pen);
  curve->setRenderHint(QwtPlotItem::RenderAntialiased);
  curve->setPaintAttribute(QwtPlotCurve::ClipPolygons);
  curve->setLegendAttribute(QwtPlotCurve::LegendShowLine);
  curve->setLegendAttribute(QwtPlotCurve::LegendShowSymbol);
  curve->setLegendIconSize({30, 9});
  curve->setItemAttribute(QwtPlotItem::Legend, !title.isEmpty());
  curve->setZ(z);
  curve->attach(&plot);
  return curve;
}

/// A vertical line with a label in its colour.
inline std::unique_ptr<QwtPlotMarker> makeMark(QwtPlot& plot, const QPen& pen, const QString& label, double z) {
  auto mark = std::make_unique<QwtPlotMarker>();
  mark->setLineStyle(QwtPlotMarker::VLine);
  mark->setLinePen(pen);
  QwtText text(label);
  text.setColor(pen.color());
  mark->setLabel(text);
  mark->setLabelAlignment(Qt::AlignRight | Qt::AlignTop);
  mark->setZ(z);
  mark->attach(&plot);
  return mark;
}

/// Marks a few of its points.
class MarkedCurve : public QwtPlotCurve {
  void drawSymbols(QPainter* painter, const QwtSymbol& symbol, const QwtScaleMap& x, const QwtScaleMap& y, const QRectF&, int from,
                   int to) const override {
    constexpr int kMarks = 6;
    for (int i = 0; i < kMarks; ++i) {
      const QPointF at = sample(from + (to - from) * (2 * i + 1) / (2 * kMarks));
      symbol.drawSymbol(painter, {x.transform(at.x()), y.transform(at.y())});
    }
  }
};

/// Fills the curve. It takes samples only as pointers.
inline void setSamples(QwtPlotCurve& curve, const std::vector<double>& x, const std::vector<double>& y) {
  curve.setSamples(x.data(), y.data(), static_cast<int>(std::min(x.size(), y.size())));
}

inline std::unique_ptr<QwtPlotCurve> makePrediction(QwtPlot& plot, const PredictedLine& line, double z) {
  constexpr QwtSymbol::Style kMarks[] = {QwtSymbol::Ellipse,   QwtSymbol::Rect,   QwtSymbol::Triangle, QwtSymbol::Diamond,
                                         QwtSymbol::DTriangle, QwtSymbol::XCross, QwtSymbol::Hexagon};
  const LineStyle& style = line.style;
  QPen pen(style.colour, line.fitted ? 2.4 : 1.6);
  pen.setDashPattern({style.dashes.begin(), style.dashes.end()});
  pen.setCapStyle(Qt::FlatCap);
  auto curve = makeCurve(plot, line.title, pen, z, std::make_unique<MarkedCurve>());
  const QBrush inside = line.fitted ? style.colour : widgets::toQColor(widgets::colours::kBase);
  curve->setSymbol(
      new QwtSymbol(kMarks[static_cast<std::size_t>(style.mark) % std::size(kMarks)], inside, QPen(style.colour, 1.2), QSize(7, 7)));
  setSamples(*curve, line.x, line.y);
  return curve;
}

/// A drag zooms in, and a right click zooms back. The pointer's coordinates in the axes' units are shown beside it.
class Zoomer : public QwtPlotZoomer {
 public:
  explicit Zoomer(QWidget* canvas) : QwtPlotZoomer(canvas) {
    setTrackerMode(QwtPicker::AlwaysOn);
    setRubberBandPen(QPen(widgets::ink(255), 1, Qt::DashLine));
    setTrackerPen(QPen(widgets::ink(255)));
  }
  QwtText trackerTextF(const QPointF& at) const override {
    return QwtText(QStringLiteral("%1, %2").arg(at.x(), 0, 'f', 3).arg(at.y(), 0, 'g', 4));
  }
};

/// Exports by the file's ending: SVG, PDF, or CSV with the text that `write` writes. Returns false for other endings and for failures.
template <typename Write>
bool exportPlot(QwtPlot& plot, const QString& file, Write write) {
  const QString ending = QFileInfo(file).suffix().toLower();
  if (ending == QLatin1String("csv")) {
    QSaveFile out(file);
    if (!out.open(QIODevice::WriteOnly)) return false;
    QTextStream text(&out);
    text.setRealNumberPrecision(17);
    write(text);
    text.flush();
    return out.commit();
  }
  if (ending != QLatin1String("svg") && ending != QLatin1String("pdf")) return false;
  if (!QFile(file).open(QIODevice::WriteOnly)) return false;  // the renderer tells nobody
  QwtPlotRenderer renderer;
  renderer.renderDocument(&plot, file, ending, QSizeF(180, 80), 150);
  return QFileInfo(file).size() > 0;
}

/// A button that asks for a file and exports the plot to it.
template <typename Plot>
QToolButton* makeExportButton(Plot* plot, const QString& title, const QString& suggested) {
  auto* button = new QToolButton;
  button->setText(QObject::tr("Export…"));
  button->setToolTip(QObject::tr("writes the plot as SVG, PDF or CSV"));
  QObject::connect(button, &QToolButton::clicked, plot, [=] {
    const QString file = QFileDialog::getSaveFileName(plot, title, suggested, QObject::tr("SVG (*.svg);;PDF (*.pdf);;CSV (*.csv)"));
    if (file.isEmpty() || plot->exportTo(file)) return;
    QMessageBox::warning(
        plot, title, QObject::tr("%1 was not written: its name ends in .svg, .pdf or .csv, and its folder can be written to.").arg(file));
  });
  return button;
}

/// Lays out a plot with legend and zoom in `widget`, below a row of `fields` that ends with the button for its export.
template <typename Widget>
std::pair<QwtPlot*, Zoomer*> addPlot(Widget* widget, const std::vector<QWidget*>& fields, const QString& title, const QString& suggested) {
  auto* layout = new QVBoxLayout(widget);
  layout->setContentsMargins(6, 2, 6, 2);
  layout->setSpacing(2);
  auto* row = new QHBoxLayout;
  for (QWidget* field : fields) row->addWidget(field);
  row->addStretch(1);
  row->addWidget(makeExportButton(widget, title, suggested));
  layout->addLayout(row);
  auto* plot = new QwtPlot;
  layout->addWidget(plot, 1);
  auto* zoomer = new Zoomer(dress(*plot));
  addLegend(*plot);
  return {plot, zoomer};
}

}  // namespace reachlab::gui::plot
