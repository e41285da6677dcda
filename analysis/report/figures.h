#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/figure/figure.h"
#include "analysis/recovery.h"
#include "analysis/analysis.h"

namespace reachlab::analysis {

struct NamedFigure {
  std::string name;     // of its file, without ending
  std::string caption;  // plain words, for the report
  figure::Figure figure;
};

// What leads: who follows what. In conclusion_figures.cpp.

/// Scores of subjects by criterion, against the reference; lines join a subject. A panel a condition, and one over all.
NamedFigure scoreFigure(const Analysis& analysis);
/// Protected exceedance probability of each candidate; no panels with one subject.
NamedFigure posteriorFigure(const Analysis& analysis);
/// Of each truth, how many simulated studies named what.
NamedFigure recoveryFigure(const TruthRecovery& recovery);

// The movements. In movement_figures.cpp.

/// The paper's Figs. 5 and 6 of one condition: hand and object velocity; thin lines trials time-scaled to their average, thick solid
/// criterion (1), thick dashed criterion (3), each for the task's T, neither cut nor stretched.
NamedFigure paperFigure(const Analysis& analysis, std::size_t condition);
/// Figs. 9 and 10: the last five successful trials thin, criterion (1) thick grey, the average of all thick black. `subject` empty: of the
/// only one, else of the first.
NamedFigure lastFiveFigure(const Analysis& analysis, std::size_t condition);
/// Small multiples: each subject's mean and scatter with the fitted mean of the closest candidates and of the reference, residuals below.
NamedFigure peopleFigure(const Analysis& analysis, std::size_t condition);

// Learning. In progress_figures.cpp.

/// Success against trial number, a panel a condition, a line a subject.
NamedFigure learningFigure(const Analysis& analysis);

/// All figures of the study that have something to show.
std::vector<NamedFigure> makeFigures(const Analysis& analysis, const std::optional<TruthRecovery>& recovery);

/// How a criterion is drawn everywhere.
struct CriterionLook {
  figure::Color color;
  figure::Dash dash;
};
CriterionLook lookOf(const std::vector<predict::Criterion>& criteria);
/// "(1)", "(4, 6)", "reference": for axes.
std::string shortNameOf(const std::vector<predict::Criterion>& criteria);
/// Where a subject stands among the study's; its line, with the colour and marker that it has everywhere.
int subjectIndex(const Analysis& analysis, const std::string& subject);
figure::Series subjectSeries(const Analysis& analysis, const std::string& subject);
/// An axis with a place for each candidate, from 1 on.
void addCandidates(figure::Axis& axis, std::span<const std::vector<predict::Criterion>> candidates);
/// A title that a panel of a grid can bear.
std::string shortened(const std::string& text, std::size_t most = 34);

}  // namespace reachlab::analysis
