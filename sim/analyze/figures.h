#pragma once
#include <map>
#include <string>
#include <vector>

#include "sim/analyze/study.h"
#include "sim/figure/figure.h"

namespace reachlab::analyze {

struct NamedFigure {
  std::string name;     // of its file, without ending
  std::string caption;  // plain words, for the report
  figure::Figure figure;
};

/// Fig. 5 and 6 (9 and 10) of one condition: hand and object velocity; thin lines trials, thick black their mean, band SD, thick solid
/// criterion (1), thick dashed criterion (3), and the criterion that ranks first where it is neither.
NamedFigure velocityFigure(const StudyResult& study, std::size_t condition);
/// The mean profile against every criterion.
NamedFigure predictionFigure(const StudyResult& study, std::size_t condition);
/// RMS error of each criterion with its interval, a panel a condition and one over all.
NamedFigure rankingFigure(const StudyResult& study);
/// Success against trial number with Wilson's interval, a panel a condition.
NamedFigure learningFigure(const StudyResult& study);

/// All figures of the study that have something to show.
std::vector<NamedFigure> makeFigures(const StudyResult& study);

}  // namespace reachlab::analyze
