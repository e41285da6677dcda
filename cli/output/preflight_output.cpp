#include "cli/output/preflight_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/output/json_text.h"

namespace reachlab::cli {

using devices::PreflightLine;
using devices::Verdict;

std::string preflightText(const std::vector<PreflightLine>& lines) {
  std::vector<PreflightLine> ordered = lines;
  std::stable_partition(ordered.begin(), ordered.end(), [](const PreflightLine& line) { return line.verdict == Verdict::Warning; });
  std::string text;
  for (const PreflightLine& line : ordered) text += fmt::format("  {:<8} {}\n", devices::nameOf(line.verdict), describe(line));
  return text;
}

std::string preflightJson(const std::vector<PreflightLine>& lines) {
  using Json = nlohmann::ordered_json;
  Json rows = Json::array();
  for (const PreflightLine& line : lines)
    rows.push_back({{"hand", std::max(line.hand, 1)},
                    {"name", line.name},
                    {"verdict", devices::nameOf(line.verdict)},
                    {"asked", line.asked},
                    {"limit", line.limit ? Json(*line.limit) : Json(nullptr)},
                    {"unit", line.unit},
                    {"sentence", line.sentence},
                    {"remedy", line.remedy.empty() ? Json(nullptr) : Json(line.remedy)}});
  return jsonText(rows);
}

}  // namespace reachlab::cli
