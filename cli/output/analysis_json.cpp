#include "cli/output/analysis_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "analysis/report/wording.h"
#include "analysis/tables.h"
#include "cli/output/json_text.h"

namespace reachlab::cli {
namespace {

using Names = std::vector<std::vector<predict::Criterion>>;
using Json = nlohmann::ordered_json;

Json jsonOf(const analysis::Bounds& i) { return i.finite() ? Json{i.low, i.high} : Json(nullptr); }

/// The paper's epsilon of one signal, as a description.
Json jsonOf(const analysis::EpsilonTable& table, const analysis::ConditionResult& result, bool decided) {
  auto places = Json::array();
  auto together = Json::array();
  for (const analysis::EpsilonPlace& p : table) {
    const auto name = predict::nameOf(result.signals[p.criterion].criterion);
    places.push_back({{"criterion", name},
                      {"epsilon_m_per_s", p.epsilon},
                      {"epsilon_mean_m_per_s", p.mean},
                      {"epsilon_interval_m_per_s", p.interval ? jsonOf(*p.interval) : Json(nullptr)},
                      {"difference_m_per_s", p.difference},
                      {"difference_interval_m_per_s", p.differenceInterval ? jsonOf(*p.differenceInterval) : Json(nullptr)},
                      {"apart_from_first", p.apart}});
    if (&p != &table.front() && !p.apart) together.push_back({predict::nameOf(result.signals[table.front().criterion].criterion), name});
  }
  return {{"decided", decided},
          {"trials", result.used},
          {"subjects", result.conclusion.subjects},
          {"places", places},
          {"not_told_apart", together}};
}

Json jsonOf(const analysis::Conclusion& c, const Names& names, const std::vector<double>& masses) {
  const auto name = [&](const std::optional<std::size_t>& k) { return k ? Json(analysis::nameOfCandidate(names[*k])) : Json(nullptr); };
  const auto byName = [&](const auto& values) {
    auto object = Json::object();
    for (std::size_t k = 0; k < values.size(); ++k) object[analysis::nameOfCandidate(names[k])] = values[k];
    return object;
  };
  auto equivalent = Json::array();
  if (c.best)
    for (std::size_t i = 1; i < names[*c.best].size(); ++i) equivalent.push_back(predict::nameOf(names[*c.best][i]));
  auto together = Json::array();
  for (const auto& [i, j] : c.notToldApart) together.push_back({analysis::nameOfCandidate(names[i]), analysis::nameOfCandidate(names[j])});
  auto atEdge = Json::array();
  for (const std::size_t k : c.atEdge) atEdge.push_back(analysis::nameOfCandidate(names[k]));
  const bool judged = c.best.has_value();
  return {{"criterion", name(c.follows)},
          {"decided", c.decided()},
          {"unit", c.overSubjects ? "subjects" : "trials"},
          {"reason", analysis::nameOf(c.reason)},
          {"equivalent", equivalent},
          {"best", name(c.best)},
          {"p", judged ? Json(c.p) : Json(nullptr)},
          {"rival", name(c.rival)},
          {"rival_score_above_best", c.rival ? Json(c.against[*c.rival].mean) : Json(nullptr)},
          {"rival_score_above_best_interval", c.rival ? jsonOf(analysis::intervalOf(c.against[*c.rival])) : Json(nullptr)},
          {"rival_bayes_factor", c.rival ? Json(analysis::computeBayesFactor(c.against[*c.rival])) : Json(nullptr)},
          {"level", c.level},
          {"least_difference", analysis::kLeastDifference},
          {"subjects", c.subjects},
          {"trials", c.trials},
          {"closest_subjects", byName(c.closest)},
          {"posterior", byName(c.posterior)},
          {"sign_flip_p", c.signFlipP ? Json(*c.signFlipP) : Json(nullptr)},
          {"not_told_apart", together},
          {"reference", {{"p", judged ? Json(c.referenceP) : Json(nullptr)}, {"first", c.referenceFirst}}},
          {"r2", judged ? Json(c.r2) : Json(nullptr)},
          {"ceiling", judged ? Json(c.ceiling) : Json(nullptr)},
          {"misfit", {{"score", judged ? Json(c.misfit.mean) : Json(nullptr)}, {"p", judged ? Json(c.misfit.p) : Json(nullptr)}}},
          {"toward",
           {{"criterion", name(c.mixedWith)},
            {"share", c.mixedWith ? Json(c.mixture.mean) : Json(nullptr)},
            {"share_interval", c.mixedWith ? jsonOf(analysis::intervalOf(c.mixture)) : Json(nullptr)},
            {"p", c.mixedWith ? Json(c.mixtureP) : Json(nullptr)}}},
          {"systematic",
           {{"share", judged ? Json(c.systematic.share) : Json(nullptr)}, {"p", judged ? Json(c.systematic.p()) : Json(nullptr)}}},
          {"masses_at_edge", atEdge},
          {"scores", byName(c.score)},
          {"hand_masses_kg", masses},
          {"sentence", analysis::describeConclusion(c, names)}};
}

Json jsonOfFits(const analysis::Analysis& analysis) {
  auto fits = Json::array();
  for (const analysis::FitRow& f : analysis::fitRows(analysis))
    fits.push_back({{"subject", f.person->subject},
                    {"condition", f.condition},
                    {"criterion", f.criterion},
                    {"equivalent", f.equivalent},
                    {"epsilon_fit_m_per_s", f.fit->epsilonOfAll},
                    {"r2", f.fit->r2},
                    {"score", f.fit->meanScore},
                    {"ceiling", f.person->fit.own.ceiling},
                    {"duration_s", f.fit->duration},
                    {"plan_s", f.plan ? Json(*f.plan) : Json(nullptr)},
                    {"time_law", f.timeLaw},
                    {"hand_mass_kg", f.handMass ? Json(*f.handMass) : Json(nullptr)},
                    {"hand_mass_interval_kg", f.fit->mass ? jsonOf(f.fit->mass->interval) : Json(nullptr)},
                    {"hand_mass_at_edge", f.fit->mass && f.fit->mass->atEdge},
                    {"misfit", f.misfit},
                    {"systematic_share", f.fit->systematic.share},
                    {"systematic_p", f.fit->systematic.p()},
                    {"toward", f.toward.empty() ? Json(nullptr) : Json(f.toward)},
                    {"toward_share", f.toward.empty() ? Json(nullptr) : Json(f.towardShare)},
                    {"toward_p", f.toward.empty() ? Json(nullptr) : Json(f.towardP)},
                    {"trials", f.person->trials},
                    {"decided", f.decided},
                    {"reason", analysis::nameOf(f.person->conclusion.reason)}});
  return fits;
}

Json jsonOf(const analysis::TruthRecovery& r) {
  auto names = Json::array();
  for (const auto& criteria : r.candidates) names.push_back(analysis::nameOfCandidate(criteria));
  auto named = names;
  named.push_back("undecided");
  auto others = Json::array();
  for (const analysis::OtherTruth& o : r.others)
    others.push_back({{"truth", o.name},
                      {"right", o.right},
                      {"wrong", o.wrong},
                      {"undecided", o.undecided},
                      {"wrong_percent", 100 * static_cast<double>(o.wrong) / static_cast<double>(std::max<std::size_t>(1, o.studies()))}});
  return {{"trials", r.trials}, {"seeds", r.studies}, {"truths", names}, {"named", named}, {"counts", r.counts}, {"others", others}};
}

Json jsonOf(const analysis::Analysis& analysis, const analysis::Effect& e) {
  const auto place = [&](int i) { return e.ofDay ? fmt::format("D{}", i) : analysis.conditions[static_cast<std::size_t>(i)].name; };
  return {{"effect", e.ofDay ? "day" : "condition"},
          {"condition", e.ofDay ? Json(analysis.conditions[e.condition].name) : Json(nullptr)},
          {"from", place(e.from)},
          {"to", place(e.to)},
          {"subjects", e.people},
          {"difference_percent", e.points.mean},
          {"difference_interval_percent", jsonOf(e.pointsInterval)},
          {"odds_ratio", std::exp(e.logit.mean)},
          {"odds_ratio_interval", jsonOf(analysis::Bounds{std::exp(e.logitInterval.low), std::exp(e.logitInterval.high)})},
          {"p", e.people > 1 ? Json(e.p) : Json(nullptr)}};
}

}  // namespace

std::string summaryJson(const analysis::Analysis& analysis, const analysis::DatasetIndex& dataset, const analysis::AnalysisFiles& files,
                        const std::optional<analysis::TruthRecovery>& recovery, const std::optional<AnalysisPlan>& plan) {
  Json j = Json::object();
  if (plan) j["plan"] = {{"file", plan->file}, {"date", plan->date}, {"sha256", plan->sha256}, {"departures", plan->departures}};
  j["report"] = files.report;
  j["tables"] = files.tables;
  j["figures"] = files.figures;
  j["runs"] = dataset.runs.size();
  j["notes"] = dataset.notes;
  if (const std::string learning = analysis::describeLearning(analysis); !learning.empty()) j["adaptation"] = learning;
  std::vector<double> masses;
  for (const analysis::ConditionResult& r : analysis.results)
    if (masses.empty()) masses = r.candidates.masses;
  j["conclusion"] = jsonOf(analysis.overall, analysis.common, masses);
  j["conclusion"]["conditions"] = Json::array();
  for (const std::size_t c : analysis.together) j["conclusion"]["conditions"].push_back(analysis.conditions[c].name);
  j["conditions"] = Json::array();
  for (std::size_t c = 0; c < analysis.conditions.size(); ++c) {
    const analysis::ConditionResult& r = analysis.results[c];
    Json condition{{"name", analysis.conditions[c].name}, {"success", r.counts.success},         {"failure", r.counts.failure},
                   {"aborted", r.counts.aborted},         {"interrupted", r.counts.interrupted}, {"invalid_timing", r.counts.invalidTiming},
                   {"before_go", r.counts.beforeGo},      {"other_way", r.counts.otherWay},      {"used", r.used}};
    if (r.used > 0) {
      condition["mean_duration_s"] = r.duration.mean;
      condition["movement_time_s"] = {{"mean", r.movementTime.mean}, {"min", r.movementRange.low}, {"max", r.movementRange.high}};
    }
    if (r.success) condition["success_percent"] = {{"typical", 100 * r.success->mean}, {"interval", jsonOf(r.success->interval.percent())}};
    condition["conclusion"] = jsonOf(r.conclusion, analysis::namesOf(r.candidates), r.candidates.masses);
    condition["hand_ranking"] = jsonOf(r.handEpsilon, r, r.conclusion.decided());
    condition["object_ranking"] = jsonOf(r.objectEpsilon, r, false);
    j["conditions"].push_back(condition);
  }
  j["fits"] = jsonOfFits(analysis);
  j["effects"] = Json::array();
  for (const analysis::Effect& e : analysis.effects) j["effects"].push_back(jsonOf(analysis, e));
  j["learning"] = Json::array();
  for (const analysis::LearningSlope& s : analysis.slopes)
    j["learning"].push_back({{"condition", analysis.conditions[s.condition].name},
                             {"subjects", s.people},
                             {"slope_percent_per_100_trials", s.perHundred},
                             {"interval", jsonOf(s.interval)},
                             {"p", s.people > 1 ? Json(s.p) : Json(nullptr)}});
  if (!analysis.alternatives.empty()) {
    j["alternatives"] = Json::array();
    for (const analysis::AlternativeConclusion& a : analysis.alternatives)
      j["alternatives"].push_back({{"choice", a.choice},
                                   {"condition", a.condition},
                                   {"criterion", a.conclusion.follows ? Json(a.criterion()) : Json(nullptr)},
                                   {"reason", analysis::nameOf(a.conclusion.reason)},
                                   {"best", a.conclusion.best ? Json(a.best()) : Json(nullptr)},
                                   {"p", a.p() ? Json(*a.p()) : Json(nullptr)},
                                   {"changed", a.changed}});
  }
  if (recovery) j["recovery"] = jsonOf(*recovery);
  return jsonText(j);
}

}  // namespace reachlab::cli
