#include "base/names.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <numeric>

namespace reachlab {

std::string nearestName(std::string_view name, const std::vector<std::string>& known) {
  std::string best;
  if (name.empty() || name.size() > 60) return best;
  std::size_t bestDistance = std::min(name.size() - 1, std::max<std::size_t>(2, name.size() / 3)) + 1;
  for (const std::string& candidate : known) {
    std::vector<std::size_t> row(candidate.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= name.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i;
      for (std::size_t j = 1; j <= candidate.size(); ++j) {
        const std::size_t substituted = diagonal + (name[i - 1] != candidate[j - 1]);
        diagonal = row[j];
        row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
      }
    }
    if (row.back() < bestDistance) bestDistance = row.back(), best = candidate;
  }
  return best;
}

std::string didYouMean(std::string_view name, const std::vector<std::string>& known) {
  const std::string nearest = nearestName(name, known);
  return nearest.empty() ? nearest : "; did you mean " + nearest + "?";
}

std::string shellWord(const std::string& text) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || std::strchr("_./:=,+-", c) != nullptr; };
  if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string nameOfFile(const std::string& path) {
  const std::filesystem::path file(path);
  return (file.extension() == ".json" ? file.stem() : file.filename()).string();
}

std::string listOf(const std::vector<std::string>& names, const char* last) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) list += i + 1 == names.size() ? last : ", ";
    list += names[i];
  }
  return list;
}

}  // namespace reachlab
