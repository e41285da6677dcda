#include "sim/record/log/run_order.h"

#include <algorithm>
#include <filesystem>

namespace reachlab::record {
namespace {

bool isNumber(std::string_view label) {
  return !label.empty() && std::all_of(label.begin(), label.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// The label behind `key` ("_ses-") of a file's name. Empty if it has none.
std::string_view labelOf(std::string_view name, std::string_view key) {
  const std::size_t at = name.find(key);
  if (at == std::string_view::npos) return {};
  const std::string_view rest = name.substr(at + key.size());
  return rest.substr(0, rest.find('_'));
}

}  // namespace

bool labelBefore(std::string_view a, std::string_view b) {
  if (isNumber(a) != isNumber(b)) return isNumber(a);
  if (!isNumber(a)) return a < b;
  const auto digits = [](std::string_view label) { return label.substr(std::min(label.find_first_not_of('0'), label.size())); };
  const std::string_view x = digits(a), y = digits(b);
  if (x != y) return x.size() != y.size() ? x.size() < y.size() : x < y;
  return a < b;  // "1" and "01"
}

bool runBefore(const std::string& a, const std::string& b) {
  const std::string x = "_" + std::filesystem::path(a).filename().string(), y = "_" + std::filesystem::path(b).filename().string();
  if (const auto p = labelOf(x, "_sub-"), q = labelOf(y, "_sub-"); p != q) return p < q;
  for (const char* key : {"_ses-", "_run-"})
    if (const auto p = labelOf(x, key), q = labelOf(y, key); p != q) return labelBefore(p, q);
  return a < b;
}

}  // namespace reachlab::record
