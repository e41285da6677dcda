#include <functional>

#include "analysis/report/figures.h"
#include "analysis/taught_trials.h"

namespace reachlab::analysis {
namespace {

struct Course {
  const char *title, *axis;
  std::function<double(const AnalyzedTrial&)> value;  // not measured: the trial is not of this kind
};

const std::vector<Course>& courses() {
  static const auto millimetres = [](const AnalyzedTrial& t) { return 1e3 * t.measures.maxPerpendicular; };
  static const std::vector<Course> kCourses{
      {"Channel trials", "Adaptation (%)", [](const AnalyzedTrial& t) { return t.measures.adaptation; }},
      {"Trials in the field", "Largest deviation to the right (mm)",
       [](const AnalyzedTrial& t) { return t.scene.inField ? millimetres(t) : kNotMeasured; }},
      {"Trials without a field", "Largest deviation to the right (mm)",
       [](const AnalyzedTrial& t) { return !t.scene.cursor && !t.scene.inField && !t.scene.channel ? millimetres(t) : kNotMeasured; }},
      {"Trials with a cursor", "Hand angle (°, counterclockwise)",
       [](const AnalyzedTrial& t) { return t.scene.cursor ? t.measures.handAngle : kNotMeasured; }}};
  return kCourses;
}

}  // namespace

NamedFigure adaptationFigure(const Analysis& analysis) {
  NamedFigure out{.name = "adaptation"};
  out.caption =
      "Learning from trial to trial: each line is a subject, in the order of its trials. A channel shows how much of the trained "
      "field the hand cancels, and deviations show what is left of it.";
  const auto people = taughtTrials(analysis);
  for (const Course& course : courses()) {
    figure::Panel panel{.title = course.title,
                        .x = {.label = "Trial"},
                        .y = {.label = course.axis},
                        .rules = {{0, false, ""}},
                        .legend = out.figure.panels.empty() ? figure::LegendPlace::Below : figure::LegendPlace::None};
    for (const TaughtTrials& person : people) {
      figure::Series series = subjectSeries(analysis, person.subject);
      series.width = people.size() > 3 ? figure::kThin : figure::kNormal;
      series.marker = figure::MarkerShape::None;
      const TrialKey* last = nullptr;
      for (std::size_t i = 0; i < person.trials.size(); ++i) {
        const double value = course.value(*person.trials[i]);
        if (!(value == value)) continue;  // the line joins the trials of its kind within a block
        const TrialKey& key = person.trials[i]->key;
        const auto add = [&](double y) { series.x.push_back(static_cast<double>(i + 1)), series.y.push_back(y); };
        if (last != nullptr && (last->run != key.run || last->block != key.block)) add(kNotMeasured);
        last = &key;
        add(value);
      }
      if (!series.x.empty()) panel.series.push_back(std::move(series));
    }
    if (!panel.series.empty()) out.figure.panels.push_back(std::move(panel));
  }
  out.figure.columns = out.figure.panels.size() > 1 ? 2 : 1;
  return out;
}

}  // namespace reachlab::analysis
