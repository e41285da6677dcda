#include "sim/record/log/run_names.h"

#include <algorithm>
#include <filesystem>

namespace reachlab::record {
namespace {

bool isNumber(std::string_view label) {
  return !label.empty() && std::all_of(label.begin(), label.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

std::string labelIn(const std::string& name, const std::string& key) {
  const std::string whole = "_" + name, before = "_" + key + "-";
  const std::size_t at = whole.find(before);
  if (at == std::string::npos) return {};
  const std::size_t begin = at + before.size();
  return whole.substr(begin, whole.find_first_of("_.", begin) - begin);
}

bool labelBefore(std::string_view a, std::string_view b) {
  if (isNumber(a) != isNumber(b)) return isNumber(a);
  if (!isNumber(a)) return a < b;
  const auto digits = [](std::string_view label) { return label.substr(std::min(label.find_first_not_of('0'), label.size())); };
  const std::string_view x = digits(a), y = digits(b);
  if (x != y) return x.size() != y.size() ? x.size() < y.size() : x < y;
  return a < b;  // "1" and "01"
}

bool runBefore(const std::string& a, const std::string& b) {
  const std::string x = std::filesystem::path(a).filename().string(), y = std::filesystem::path(b).filename().string();
  if (const auto p = labelIn(x, "sub"), q = labelIn(y, "sub"); p != q) return p < q;
  for (const char* key : {"ses", "run"})
    if (const auto p = labelIn(x, key), q = labelIn(y, key); p != q) return labelBefore(p, q);
  return a < b;
}

}  // namespace reachlab::record
