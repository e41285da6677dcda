// Start and target, taken hold of in the scene and put elsewhere by the mouse.
#include <QComboBox>
#include <QLabel>
#include <QMouseEvent>

#include "constraints/constraint.h"
#include "constraints/geometry/task_path.h"
#include "gui/widgets/number_list_edit.h"
#include "sim/experiment/experiment.h"
#include "tests/gui/at_the_window.h"

namespace reachlab::gui {
namespace {

class DraggedPlaces : public AtTheWindow {
 protected:
  void begin(const char* what) {
    request_.what = what;
    open().resize(1500, 950);
    QTest::qWait(50);
  }
  scene::SceneView& view() { return window_->view(); }
  const experiment::Task& task() { return *window_->session().experiment().task; }
  QPoint pixelOf(const std::vector<double>& q) { return view().pixelOf(placeOn(window_->session().compiled().constraint(), q)).toPoint(); }
  void send(QEvent::Type type, const QPoint& at, Qt::MouseButtons buttons) {
    QMouseEvent event(type, at, type == QEvent::MouseMove ? Qt::NoButton : Qt::LeftButton, buttons, {});
    QApplication::sendEvent(view().focusProxy(), &event);
  }
  void take(const QPoint& from) { send(QEvent::MouseButtonPress, from, Qt::LeftButton); }
  void drag(const QPoint& to) { send(QEvent::MouseMove, to, Qt::LeftButton); }
  void drop(const QPoint& at) { send(QEvent::MouseButtonRelease, at, Qt::NoButton); }
  void move(const QPoint& from, const QPoint& to) {
    take(from);
    drag((from + to) / 2);
    drag(to);
    drop(to);
  }
  double apart(const std::vector<double>& q, const QPoint& from) {
    const QPointF off = view().pixelOf(placeOn(window_->session().compiled().constraint(), q)) - from;
    return std::hypot(off.x(), off.y());
  }
};

constexpr double kUnderThePointer = 1.5;  // pixels

TEST_F(DraggedPlaces, LieUnderThePointerOnEveryKindOfShape) {
  struct {
    const char* what;
    std::vector<double> to;  // by the constraint's parameters
  } const cases[] = {{"chain-moderate", {0.17}},    {"ellipse", {1.1}},      {"trefoil", {2.0}},
                     {"torus", {0.7, 0.9}},         {"sphere", {0.5, 0.4}},  {"moebius-strip", {0.9, 0}},
                     {"helicoid", {0.3, 0.4}},      {"plane", {0.05, 0.03}}, {"cycloid", {2}},
                     {"free-point", {0.1, 0.05, 0}}};
  for (const auto& [what, to] : cases) {
    begin(what);
    const std::vector<double> before = task().target;
    if (to.size() != before.size()) ADD_FAILURE() << what;
    const QPoint at = pixelOf(to);
    move(pixelOf(before), at);
    ASSERT_NE(task().target, before) << what << ": " << window_->message().toStdString();
    EXPECT_LE(apart(task().target, at), kUnderThePointer) << what;
    window_->edits().undo();
    EXPECT_EQ(task().target, before) << what;
    window_->edits().setClean();
    window_.reset();
  }
}

TEST_F(DraggedPlaces, AreShownWhileTheyAreDraggedAndGoBackWithEscape) {
  begin("ellipse");
  const std::vector<double> start = task().start, target = task().target;
  const QPoint at = pixelOf({2.2});
  take(pixelOf(target));
  drag(at);
  const QPointF shown = view().pixelOf(view().plan().target);
  EXPECT_LE(std::hypot(shown.x() - at.x(), shown.y() - at.y()), kUnderThePointer);
  EXPECT_EQ(task().target, target) << "not taken over yet";
  EXPECT_TRUE(starts(find<scene::SceneOverlay>("")->label(), "phi = 2.19"));
  QTest::keyClick(view().focusProxy(), Qt::Key_Escape);
  drop(at);
  EXPECT_EQ(task().target, target);
  EXPECT_TRUE(window_->edits().isClean());
  const QPointF back = view().pixelOf(view().plan().target) - pixelOf(target);
  EXPECT_LE(std::hypot(back.x(), back.y()), kUnderThePointer);
  // The start takes along what rests at it. A click alone moves nothing.
  const QPoint elsewhere = pixelOf({-0.5});
  take(pixelOf(start));
  drag(elsewhere);
  EXPECT_EQ(view().frame().masses.back(), view().plan().start);
  drop(elsewhere);
  EXPECT_NEAR(task().start[0], -0.5, 0.02);
  EXPECT_EQ(window_->message(), "The start is moved. Ctrl+Z takes it back.");
  const std::vector<double> moved = task().start;
  take(elsewhere);
  drop(elsewhere);
  EXPECT_EQ(task().start, moved);
}

TEST_F(DraggedPlaces, StayWhereTheyAreDuringARunAndInAPlan) {
  begin("chain-moderate");
  ASSERT_TRUE(startsTrial());
  const std::vector<double> target = task().target;
  move(pixelOf(target), pixelOf({0.1}));
  EXPECT_EQ(task().target, target);
  EXPECT_NE(window_->session().run(), nullptr);
  window_->abortTrial();
  window_->session().endRun();
  move(pixelOf(target), pixelOf({0.1}));
  EXPECT_NE(task().target, target) << "no run is open";
  window_->edits().setClean();
}

// The fields of the same places.
class TypedPlaces : public DraggedPlaces {
 protected:
  void type(const char* field, const QString& text) {
    auto* edit = find<widgets::NumberListEdit>(field);
    edit->setFocus();
    edit->selectAll();
    edit->insert(text);  // QTest has no key for every letter
    QTest::keyClick(edit, Qt::Key_Return);
  }
  QString faults() { return find<QLabel>("taskFaults")->isVisibleTo(window_.get()) ? find<QLabel>("taskFaults")->text() : QString(); }
};

TEST_F(TypedPlaces, AreFractionsOfPi) {
  begin("ellipse");
  const std::pair<const char*, double> entries[] = {{"pi/2", M_PI / 2},   {"3*pi/4", 3 * M_PI / 4},    {"2pi/3", 2 * M_PI / 3},
                                                    {"-pi/6", -M_PI / 6}, {"3 * π / 2", 3 * M_PI / 2}, {"pi/4 + 0.1", 0}};
  for (const auto& [text, value] : entries) {
    type("taskTarget", QString::fromUtf8(text));
    if (value != 0) EXPECT_DOUBLE_EQ(task().target.at(0), value) << text << faults().toStdString();
    else EXPECT_TRUE(faults().contains("no number") || faults().contains("3 numbers")) << faults().toStdString();
  }
  type("taskTarget", "3*pi/4");
  EXPECT_EQ(find<widgets::NumberListEdit>("taskTarget")->text(), "3*pi/4") << "shown as it was typed";
  EXPECT_EQ(faults(), QString());
  window_->edits().setClean();
}

TEST_F(TypedPlaces, AreLengthsAlongTheCurve) {
  begin("ellipse");
  type("taskTarget", "0.1 m");
  // Against a sum of many short chords.
  const auto lengthBetween = [&](double from, double to) {
    double sum = 0;
    constexpr int kParts = 100'000;
    for (int i = 0; i < kParts; ++i)
      sum += norm(placeOn(window_->session().compiled().constraint(), std::vector{from + (to - from) * (i + 1) / kParts}) -
                  placeOn(window_->session().compiled().constraint(), std::vector{from + (to - from) * i / kParts}));
    return sum;
  };
  EXPECT_NEAR(lengthBetween(task().start.at(0), task().target.at(0)), 0.1, 1e-6) << faults().toStdString();
  EXPECT_GT(task().target[0], task().start[0]);
  EXPECT_EQ(find<QLabel>("taskLength")->text(), "0.1 m along the curve");
  type("taskTarget", "-0.05 m");
  EXPECT_LT(task().target[0], task().start[0]) << "the other way";
  EXPECT_NEAR(lengthBetween(task().start[0], task().target[0]), 0.05, 1e-6);
  type("taskStart", "0.15m");
  EXPECT_NEAR(lengthBetween(task().start[0], task().target[0]), 0.15, 1e-6);
  window_->edits().setClean();
}

TEST_F(TypedPlaces, LengthsBeyondTheEndAndOnSurfacesAreRefused) {
  begin("torus");
  type("taskTarget", "0.1 m");
  EXPECT_TRUE(holds(faults(), "no number"));
  EXPECT_FALSE(faults().contains("a length"));
  window_->edits().setClean();
}

TEST_F(TypedPlaces, AFaultGoesWithItsCause) {
  begin("torus");
  type("taskTarget", "abc");
  EXPECT_TRUE(holds(faults(), "\"abc\" is no number"));
  type("taskTarget", "0.5 0.1");
  EXPECT_EQ(faults(), QString()) << "mended";
  const std::vector<double> kept = task().target;
  type("taskTarget", find<widgets::NumberListEdit>("taskStart")->text());
  EXPECT_TRUE(holds(faults(), "start and target are the same position"));
  EXPECT_EQ(task().target, kept);
  type("taskTarget", "0.5 0.1");
  // Of an entry that was refused as a whole: an older state of the experiment takes its place, and has no fault.
  auto* kind = find<QComboBox>("objectKind");
  const auto refusal = [&] { return find<QLabel>("objectFaults")->isHidden() ? QString() : find<QLabel>("objectFaults")->text(); };
  kind->setCurrentText("body");
  Q_EMIT kind->activated(kind->currentIndex());  // it moves free
  EXPECT_NE(refusal(), QString());
  window_->edits().undo();
  EXPECT_EQ(refusal(), QString());
  EXPECT_EQ(kind->currentText(), "point");
}

}  // namespace
}  // namespace reachlab::gui
