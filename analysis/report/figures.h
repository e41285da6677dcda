#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/figure/figure.h"
#include "analysis/recovery.h"
#include "analysis/analysis.h"

namespace reachlab::analysis {

struct NamedFigure {
  std::string name;          // of its file, without ending
  std::string caption = {};  // plain words, for the report
  figure::Figure figure = {};
};

// The conclusions. In conclusion_figures.cpp.

/// Scores of subjects by criterion, against the reference. Bars are 95 % over trials. There is a panel for each condition and a panel over all.
NamedFigure scoreFigure(const Analysis& analysis);
/// Protected exceedance probability of each candidate. No panels with one subject.
NamedFigure posteriorFigure(const Analysis& analysis);
/// For each truth, the number of simulated studies that named each candidate.
NamedFigure recoveryFigure(const TruthRecovery& recovery);

// The movements. In movement_figures.cpp.

/// The paper's Figs. 5 and 6 of one condition: hand and object velocity. Thin lines are trials, time-scaled to their average. Thick lines
/// are criterion (1), solid, and criterion (3), dashed, each for the task's T, neither cut nor stretched.
NamedFigure paperFigure(const Analysis& analysis, std::size_t condition);
/// Figs. 9 and 10: the last five successful trials thin, criterion (1) thick grey, the average of all thick black. The subject is the
/// first.
NamedFigure lastFiveFigure(const Analysis& analysis, std::size_t condition);
/// Small multiples: each subject's mean and scatter with the fitted mean of the closest candidates and of the reference, residuals below.
NamedFigure peopleFigure(const Analysis& analysis, std::size_t condition);

// Learning. In progress_figures.cpp.

/// Success against trial number, a panel per condition, a line per subject.
NamedFigure learningFigure(const Analysis& analysis);

/// Adaptation in channels, deviations, and hand angles over trials, by kind of trial. No panels where nobody was perturbed. In
/// adaptation_figure.cpp.
NamedFigure adaptationFigure(const Analysis& analysis);

/// All figures of the study that have something to show.
std::vector<NamedFigure> makeFigures(const Analysis& analysis, const std::optional<TruthRecovery>& recovery);

/// How figures draw a criterion, and its colours in the window on a dark or light ground. The window has dashes and marks of
/// gui/plot/criterion_style.h, because it shows seven criteria at once.
struct CriterionLook {
  figure::Color color;
  figure::Dash dash;
  std::array<int, 3> onDark, onLight;  // red, green, blue, 0 to 255
};
CriterionLook lookOf(const std::vector<predict::Criterion>& criteria);
/// "(1)", "(4, 6)", "reference": for axes.
std::string shortNameOf(const std::vector<predict::Criterion>& criteria);
/// "Hand velocity (m/s)" or that of the object, against the time from the onset.
figure::Panel velocityPanel(const std::string& title, bool object);
/// [s] of the points of a profile that lasts `duration`.
std::vector<double> profileTimes(double duration);
/// A subject's position among all subjects.
int subjectIndex(const Analysis& analysis, const std::string& subject);
/// A subject's line, with the colour and marker that it has in every figure.
figure::Series subjectSeries(const Analysis& analysis, const std::string& subject);
/// An axis with a place for each candidate, from 1 on.
void addCandidates(figure::Axis& axis, std::span<const std::vector<predict::Criterion>> candidates);
/// A title that a panel of a grid can bear.
std::string shortened(const std::string& text, std::size_t most = 34);

}  // namespace reachlab::analysis
