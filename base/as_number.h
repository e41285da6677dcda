#pragma once
#include <charconv>
#include <optional>
#include <string_view>

namespace reachlab {

/// The number that the whole text is, with a decimal point in every locale. nullopt for other text, and for a number out of the type's range.
template <typename Number>
std::optional<Number> asNumber(std::string_view text) {
  Number value{};
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace reachlab
