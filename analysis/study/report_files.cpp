#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "analysis/figure/figure.h"
#include "analysis/measures/statistics.h"
#include "analysis/report/figures.h"
#include "analysis/report/write_analysis.h"
#include "analysis/study/report.h"
#include "analysis/tables.h"
#include "base/table_text.h"
#include "sim/record/export/column_dictionary.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/folder_hold.h"

namespace reachlab::study {
namespace {

namespace palette = figure::palette;

constexpr record::ColumnMeaning kMeanings[] = {
    {"key", "What was varied"},
    {"value", "Its value; everything else that was varied is taken together"},
    {"successes", "Trials that ended as success"},
    {"trials", "Of success.csv and learning.csv: successes and failures. Else: trials of a subject in each condition"},
    {"success_percent", "Share of the trials that ended as success"},
    {"low_percent", "Lower end of Clopper and Pearson's exact 95 % interval; trials of one subject are taken as independent"},
    {"high_percent", "Upper end of that interval"},
    {"block", "Condition and day of a plan; empty: an experiment"},
    {"first_trial", "First trial of the stretch, within its block"},
    {"last_trial", "Last trial of the stretch"},
    {"truth", "Criterion that the virtual subjects follow"},
    {"cell", "What else was varied; empty: nothing"},
    {"named", "What the analysis named; undecided: nothing"},
    {"subjects", "Subjects of a study"},
    {"studies", "Studies that were drawn"},
    {"right", "Studies that named the truth"},
    {"wrong", "Studies that named another criterion or the reference"},
    {"right_percent", "Share of the studies that named the truth"},
    {"level_percent", "Share of right studies that the design has to reach"}};

double percentOf(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

/// Successes, trials, their share and its interval [%].
void addShare(TableText& table, std::size_t successes, std::size_t trials) {
  const analysis::Bounds interval = analysis::computeBinomialInterval(successes, trials).percent();
  table.row(successes, trials, percentOf(successes, trials), interval.low, interval.high);
}

void addRows(TableText& table, const SuccessAt& at) { addShare(table.cells(at.key, at.value), at.successes, at.trials); }

void addRows(TableText& table, const LearningAt& at) {
  addShare(table.cells(at.block, at.firstTrial, at.lastTrial), at.successes, at.trials);
}

void addRows(TableText& table, const Confusion& c) {
  const auto& names = c.named.candidates;
  for (std::size_t t = 0; t + 1 < names.size(); ++t)
    for (std::size_t k = 0; k <= names.size(); ++k)
      table.row(c.cell, c.subjects, c.trials, analysis::nameOfCandidate(names[t]),
                k < names.size() ? analysis::nameOfCandidate(names[k]) : "undecided", c.named.counts[t][k]);
}

void addRows(TableText& table, const PowerAt& at) {
  table.row(at.truth, at.cell, at.subjects, at.trials, at.studies, at.right, at.wrong, percentOf(at.right, at.studies));
}

void addRows(TableText& table, const SmallestDesign& at) {
  const auto known = [&](std::size_t count) { return at.subjects > 0 ? std::optional(count) : std::nullopt; };
  table.row(at.truth, at.cell, 100 * at.level, known(at.subjects), known(at.trials));
}

figure::Panel percentPanel(const std::string& x, const std::string& y, figure::LegendPlace legend) {
  return {.x = {.label = x}, .y = {.label = y, .from = 0.0, .to = 100.0}, .legend = legend};
}

template <class Key>
void addLines(std::map<Key, figure::Series>& lines, figure::Panel& panel) {
  int i = 0;
  for (auto& [key, line] : lines) {
    line.color = palette::series(i);
    line.marker = figure::markerOf(i++);
    panel.series.push_back(std::move(line));
  }
}

figure::Figure figureOf(std::vector<figure::Panel> panels) {
  const int columns = panels.size() > 1 ? 2 : 1;
  return {.panels = std::move(panels), .columns = columns};
}

// One panel a varied key.
figure::Figure successFigure(const StudyReport& report) {
  std::vector<figure::Panel> panels;
  std::vector<std::string> keys;
  for (const SuccessAt& at : report.success)
    if (std::find(keys.begin(), keys.end(), at.key) == keys.end()) keys.push_back(at.key);
  for (const std::string& key : keys) {
    figure::Panel& panel = panels.emplace_back(percentPanel(key, "Success (%)", figure::LegendPlace::None));
    figure::Series series{.color = palette::kBlue, .marker = figure::MarkerShape::Circle};
    for (const SuccessAt& at : report.success) {
      if (at.key != key) continue;
      if (at.value != fmt::format("{}", at.number)) {  // words have no order that a line could follow
        panel.x.ticks.emplace_back(at.number, at.value);
        series.width = 0;
      }
      const analysis::Bounds interval = analysis::computeBinomialInterval(at.successes, at.trials).percent();
      series.x.push_back(at.number);
      series.y.push_back(percentOf(at.successes, at.trials));
      series.errorLow.push_back(interval.low);
      series.errorHigh.push_back(interval.high);
    }
    if (series.width == 0) {
      panel.x.from = -0.5;
      panel.x.to = static_cast<double>(series.x.size()) - 0.5;
    }
    panel.series.push_back(std::move(series));
  }
  return figureOf(std::move(panels));
}

// A line a block.
figure::Figure learningFigure(const StudyReport& report) {
  std::map<std::string, figure::Series> lines;
  for (const LearningAt& at : report.learning) {
    figure::Series& line = lines[at.block];
    line.label = at.block;
    line.x.push_back(static_cast<double>(at.firstTrial + at.lastTrial) / 2);
    line.y.push_back(percentOf(at.successes, at.trials));
  }
  if (lines.empty() || lines.begin()->second.x.size() < 2) return {};
  figure::Panel panel =
      percentPanel("Trial of the block", "Success (%)", lines.size() > 1 ? figure::LegendPlace::Right : figure::LegendPlace::None);
  addLines(lines, panel);
  return figureOf({std::move(panel)});
}

// A panel a population, a line a number of trials.
figure::Figure powerFigure(const StudyReport& report) {
  std::vector<figure::Panel> panels;
  std::vector<std::pair<std::string, std::string>> populations;
  for (const PowerAt& at : report.power)
    if (std::find(populations.begin(), populations.end(), std::pair{at.truth, at.cell}) == populations.end())
      populations.emplace_back(at.truth, at.cell);
  for (const auto& [truth, cell] : populations) {
    figure::Panel& panel = panels.emplace_back(percentPanel("Subjects", "Right (%), rules at 80 and 95", figure::LegendPlace::Right));
    panel.title = analysis::shortened(cell.empty() ? truth : truth + " · " + cell, 44);
    std::map<std::size_t, figure::Series> lines;
    for (const PowerAt& at : report.power) {
      if (at.truth != truth || at.cell != cell) continue;
      figure::Series& line = lines[at.trials];
      line.label = fmt::format("{} trials", at.trials);
      line.x.push_back(static_cast<double>(at.subjects));
      line.y.push_back(percentOf(at.right, at.studies));
    }
    addLines(lines, panel);
    panel.rules = {{80, false, ""}, {95, false, ""}};  // words beside them would lie under the legend
  }
  return figureOf(std::move(panels));
}

std::string textOf(const StudyReport& report, const std::vector<std::string>& figures) {
  std::string text = fmt::format(
      "# {}\n\n{} points, {} virtual subjects each, {} trials in all. Virtual subjects are not people: what they show is what the "
      "analysis\nwould find if people were like them.\n",
      report.name, report.points, report.subjects, report.trials);
  if (!report.success.empty()) {
    text += "\n## Success\n\n| key | value | success % | 95 % interval | trials |\n|---|---|---|---|---|\n";
    for (const SuccessAt& at : report.success) {
      const analysis::Bounds interval = analysis::computeBinomialInterval(at.successes, at.trials).percent();
      text += fmt::format("| {} | {} | {:.1f} | {:.1f} to {:.1f} | {} |\n", at.key, at.value, percentOf(at.successes, at.trials),
                          interval.low, interval.high, at.trials);
    }
  }
  if (report.learning.size() > 1) {
    text += "\n## Success by block\n\n| block | trials | success % |\n|---|---|---|\n";
    std::map<std::string, std::pair<std::size_t, std::size_t>> blocks;
    for (const LearningAt& at : report.learning) blocks[at.block].first += at.successes, blocks[at.block].second += at.trials;
    for (const auto& [block, count] : blocks)
      text += fmt::format("| {} | {} | {:.1f} |\n", block, count.second, percentOf(count.first, count.second));
  }
  for (const Confusion& confusion : report.confusion) {
    const auto& names = confusion.named.candidates;
    text += fmt::format("\n## What is named{}\n\n{} studies of {} subjects with {} trials for each truth.\n\n| truth |",
                        confusion.cell.empty() ? "" : ": " + confusion.cell, confusion.named.studies, confusion.subjects, confusion.trials);
    for (const auto& name : names) text += " " + analysis::nameOfCandidate(name) + " |";
    text += " undecided |\n|---|";
    for (std::size_t k = 0; k <= names.size(); ++k) text += "---|";
    text += "\n";
    for (std::size_t t = 0; t < names.size(); ++t) {
      std::size_t all = 0;
      for (const std::size_t n : confusion.named.counts[t]) all += n;
      if (all == 0) continue;
      text += "| " + analysis::nameOfCandidate(names[t]) + " |";
      for (const std::size_t n : confusion.named.counts[t]) text += fmt::format(" {} |", n);
      text += "\n";
    }
  }
  if (!report.smallest.empty()) {
    text +=
        "\n## The smallest design\n\nLeast subjects times trials, of those looked at (power.csv), whose studies name the truth so "
        "often.\n\n| truth | at | right | subjects | trials |\n|---|---|---|---|---|\n";
    for (const SmallestDesign& at : report.smallest)
      text += at.subjects == 0
                  ? fmt::format("| {} | {} | {:.0f} % | none of those looked at | |\n", at.truth, at.cell, 100 * at.level)
                  : fmt::format("| {} | {} | {:.0f} % | {} | {} |\n", at.truth, at.cell, 100 * at.level, at.subjects, at.trials);
    text += "\nScores of fewer trials than the study has are those of all its trials, so that there the power is a little too high.\n";
  }
  for (const std::string& note : report.notes) text += "\nNote: " + note + ".\n";
  for (const std::string& name : figures) text += fmt::format("\n![{0}]({0}.svg)\n", name);
  return text;
}

}  // namespace

std::vector<std::string> writeReport(const StudyReport& report, const std::string& out) {
  std::vector<std::string> written, figures;
  const auto write = [&](const std::string& name, const std::string& columns, const auto& items) {
    TableText table(',', "");
    for (const auto& item : items) addRows(table, item);
    record::writeFileAtomically(written.emplace_back(out + "/" + name + ".csv"), columns + "\n" + table.text());
    record::writeFileAtomically(written.emplace_back(out + "/" + name + ".json"), record::columnDictionary(columns, kMeanings));
  };
  const auto draw = [&](const std::string& name, const figure::Figure& figure) {
    if (figure.panels.empty()) return;
    figures.push_back(name);
    analysis::writeFigure(out + "/" + name, figure, written);
  };
  record::makeFolders(out);
  write("success", "key,value,successes,trials,success_percent,low_percent,high_percent", report.success);
  write("learning", "block,first_trial,last_trial,successes,trials,success_percent,low_percent,high_percent", report.learning);
  if (!report.power.empty()) {
    write("confusion", "cell,subjects,trials,truth,named,studies", report.confusion);
    write("power", "truth,cell,subjects,trials,studies,right,wrong,right_percent", report.power);
    write("smallest", "truth,cell,level_percent,subjects,trials", report.smallest);
  }
  draw("success", successFigure(report));
  draw("learning", learningFigure(report));
  for (std::size_t i = 0; i < report.confusion.size(); ++i)
    draw(report.confusion.size() == 1 ? "confusion" : fmt::format("confusion-{}", i + 1),
         analysis::recoveryFigure(report.confusion[i].named).figure);
  draw("power", powerFigure(report));
  record::writeFileAtomically(written.emplace_back(out + "/report.md"), textOf(report, figures));
  return written;
}

}  // namespace reachlab::study
