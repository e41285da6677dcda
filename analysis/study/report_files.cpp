#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/figure/figure.h"
#include "analysis/measures/statistics.h"
#include "analysis/report/figures.h"
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
  const analysis::Bounds interval = analysis::computeBinomialInterval(successes, trials);
  table.row(successes, trials, percentOf(successes, trials), 100 * interval.low, 100 * interval.high);
}

std::string successTable(const StudyReport& report) {
  TableText table(',', "");
  table.row("key", "value", "successes", "trials", "success_percent", "low_percent", "high_percent");
  for (const SuccessAt& at : report.success) addShare(table.cells(at.key, at.value), at.successes, at.trials);
  return table.takeText();
}

std::string learningTable(const StudyReport& report) {
  TableText table(',', "");
  table.row("block", "first_trial", "last_trial", "successes", "trials", "success_percent", "low_percent", "high_percent");
  for (const LearningAt& at : report.learning) addShare(table.cells(at.block, at.firstTrial, at.lastTrial), at.successes, at.trials);
  return table.takeText();
}

std::string confusionTable(const StudyReport& report) {
  TableText table(',', "");
  table.row("cell", "subjects", "trials", "truth", "named", "studies");
  for (const Confusion& c : report.confusion) {
    const auto& names = c.named.candidates;
    for (std::size_t t = 0; t + 1 < names.size(); ++t)
      for (std::size_t k = 0; k <= names.size(); ++k)
        table.row(c.cell, c.subjects, c.trials, analysis::nameOfCandidate(names[t]),
                  k < names.size() ? analysis::nameOfCandidate(names[k]) : "undecided", c.named.counts[t][k]);
  }
  return table.takeText();
}

std::string powerTable(const StudyReport& report) {
  TableText table(',', "");
  table.row("truth", "cell", "subjects", "trials", "studies", "right", "wrong", "right_percent");
  for (const PowerAt& at : report.power)
    table.row(at.truth, at.cell, at.subjects, at.trials, at.studies, at.right, at.wrong, percentOf(at.right, at.studies));
  return table.takeText();
}

std::string smallestTable(const StudyReport& report) {
  TableText table(',', "");
  table.row("truth", "cell", "level_percent", "subjects", "trials");
  for (const SmallestDesign& at : report.smallest) {
    const auto known = [&](std::size_t count) { return at.subjects > 0 ? std::optional(count) : std::nullopt; };
    table.row(at.truth, at.cell, 100 * at.level, known(at.subjects), known(at.trials));
  }
  return table.takeText();
}

figure::Panel percentPanel(const std::string& x, const std::string& y) {
  figure::Panel panel;
  panel.x.label = x;
  panel.y.label = y;
  panel.y.from = 0.0;
  panel.y.to = 100.0;
  return panel;
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

// One panel a varied key.
figure::Figure successFigure(const StudyReport& report) {
  figure::Figure out;
  std::vector<std::string> keys;
  for (const SuccessAt& at : report.success)
    if (std::find(keys.begin(), keys.end(), at.key) == keys.end()) keys.push_back(at.key);
  for (const std::string& key : keys) {
    figure::Panel panel = percentPanel(key, "Success (%)");
    figure::Series series;
    series.color = palette::kBlue;
    series.marker = figure::MarkerShape::Circle;
    for (const SuccessAt& at : report.success) {
      if (at.key != key) continue;
      const bool number = at.value == fmt::format("{}", at.number);
      if (!number) panel.x.ticks.emplace_back(at.number, at.value);
      const analysis::Bounds interval = analysis::computeBinomialInterval(at.successes, at.trials);
      series.x.push_back(at.number);
      series.y.push_back(percentOf(at.successes, at.trials));
      series.errorLow.push_back(100 * interval.low);
      series.errorHigh.push_back(100 * interval.high);
      if (!number) series.width = 0;
    }
    if (series.width == 0) {
      panel.x.from = -0.5;
      panel.x.to = static_cast<double>(series.x.size()) - 0.5;
    }
    panel.series.push_back(std::move(series));
    panel.legend = figure::LegendPlace::None;
    out.panels.push_back(std::move(panel));
  }
  out.columns = out.panels.size() > 1 ? 2 : 1;
  return out;
}

// A line a block.
figure::Figure learningFigure(const StudyReport& report) {
  figure::Figure out;
  std::map<std::string, figure::Series> lines;
  for (const LearningAt& at : report.learning) {
    figure::Series& line = lines[at.block];
    line.label = at.block;
    line.x.push_back(static_cast<double>(at.firstTrial + at.lastTrial) / 2);
    line.y.push_back(percentOf(at.successes, at.trials));
  }
  if (lines.empty() || lines.begin()->second.x.size() < 2) return out;
  figure::Panel panel = percentPanel("Trial of the block", "Success (%)");
  addLines(lines, panel);
  panel.legend = lines.size() > 1 ? figure::LegendPlace::Right : figure::LegendPlace::None;
  out.panels.push_back(std::move(panel));
  return out;
}

// A panel a population, a line a number of trials.
figure::Figure powerFigure(const StudyReport& report) {
  figure::Figure out;
  std::vector<std::pair<std::string, std::string>> populations;
  for (const PowerAt& at : report.power)
    if (std::find(populations.begin(), populations.end(), std::pair{at.truth, at.cell}) == populations.end())
      populations.emplace_back(at.truth, at.cell);
  for (const auto& [truth, cell] : populations) {
    figure::Panel panel = percentPanel("Subjects", "Right (%), rules at 80 and 95");
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
    panel.rules.push_back({80, false, ""});  // words beside them would lie under the legend
    panel.rules.push_back({95, false, ""});
    panel.legend = figure::LegendPlace::Right;
    out.panels.push_back(std::move(panel));
  }
  out.columns = out.panels.size() > 1 ? 2 : 1;
  return out;
}

std::string textOf(const StudyReport& report, const std::vector<std::string>& figures) {
  std::string text = fmt::format(
      "# {}\n\n{} points, {} virtual subjects each, {} trials in all. Virtual subjects are not people: what they show is what the "
      "analysis\nwould find if people were like them.\n",
      report.name, report.points, report.subjects, report.trials);
  if (!report.success.empty()) {
    text += "\n## Success\n\n| key | value | success % | 95 % interval | trials |\n|---|---|---|---|---|\n";
    for (const SuccessAt& at : report.success) {
      const analysis::Bounds interval = analysis::computeBinomialInterval(at.successes, at.trials);
      text += fmt::format("| {} | {} | {:.1f} | {:.1f} to {:.1f} | {} |\n", at.key, at.value, percentOf(at.successes, at.trials),
                          100 * interval.low, 100 * interval.high, at.trials);
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
  const auto write = [&](const std::string& name, const std::string& text) {
    record::writeFileAtomically(written.emplace_back(out + "/" + name), text);
    if (name.ends_with(".csv"))
      record::writeFileAtomically(written.emplace_back(record::dictionaryPathOf(out + "/" + name)),
                                  record::columnDictionary(text, kMeanings));
  };
  const auto draw = [&](const std::string& name, const figure::Figure& figure) {
    if (figure.panels.empty()) return;
    figures.push_back(name);
    for (const char* ending : {".svg", ".pdf"}) {
      const std::string& file = written.emplace_back(out + "/" + name + ending);
      record::writeFileAtomically(file, figure::renderFor(file, figure));
    }
  };
  record::makeFolders(out);
  write("success.csv", successTable(report));
  write("learning.csv", learningTable(report));
  if (!report.power.empty()) {
    write("confusion.csv", confusionTable(report));
    write("power.csv", powerTable(report));
    write("smallest.csv", smallestTable(report));
  }
  draw("success", successFigure(report));
  draw("learning", learningFigure(report));
  for (std::size_t i = 0; i < report.confusion.size(); ++i)
    draw(report.confusion.size() == 1 ? "confusion" : fmt::format("confusion-{}", i + 1),
         analysis::recoveryFigure(report.confusion[i].named).figure);
  draw("power", powerFigure(report));
  write("report.md", textOf(report, figures));
  return written;
}

}  // namespace reachlab::study
