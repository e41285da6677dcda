#include "base/device_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/as_number.h"
#include "base/fault.h"

namespace reachlab {
namespace {

// "instrument" of "instrument byte".
std::string kindOf(const std::string& device) { return device.substr(0, device.find(' ')); }

}  // namespace

DeviceOptions::DeviceOptions(const std::string& text, std::string device) : device_(std::move(device)) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string item = text.substr(at, end - at);
    const bool first = at == 0;
    at = end + 1;
    const std::size_t equals = item.find('=');
    if (equals == std::string::npos && first) {
      plain_ = item;
      continue;
    }
    const std::string key = item.substr(0, equals);
    const bool twice = std::any_of(items_.begin(), items_.end(), [&](const auto& other) { return other.first == key; });
    if (twice) throw FaultError(Fault{kindOf(device_), fmt::format("{}: {} is given twice", device_, key), {}});
    items_.emplace_back(key, equals == std::string::npos ? "" : item.substr(equals + 1));
  }
}

std::optional<std::string> DeviceOptions::take(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  const auto at = std::find_if(items_.begin(), items_.end(), [&](const auto& item) { return item.first == key; });
  if (at == items_.end()) return std::nullopt;
  std::string value = at->second;
  items_.erase(at);
  return value;
}

template <class Number>
Number DeviceOptions::within(const std::string& key, Number otherwise, Number least, Number most, const char* kind) {
  const auto text = take(key);
  if (!text) return otherwise;
  const auto value = asNumber<Number>(*text);
  if (!value || !(*value >= least) || !(*value <= most))
    throw FaultError(
        Fault{kindOf(device_), fmt::format("{}: {}={}", device_, key, *text), fmt::format("{} from {} to {}", kind, least, most)});
  return *value;
}

double DeviceOptions::number(const std::string& key, double otherwise, double least, double most) {
  return within(key, otherwise, least, most, "a number");
}

int DeviceOptions::count(const std::string& key, int otherwise, int least, int most) {
  return within(key, otherwise, least, most, "a whole number");
}

std::string DeviceOptions::word(const std::string& key, const std::vector<std::string>& allowed) {
  const auto text = take(key);
  if (!text) return allowed.front();
  if (std::find(allowed.begin(), allowed.end(), *text) == allowed.end()) {
    std::vector<std::string> named = allowed;
    std::erase(named, "");  // nothing told
    throw FaultError(Fault{kindOf(device_), fmt::format("{}: {}={}", device_, key, *text), fmt::format("{}", fmt::join(named, ", "))});
  }
  return *text;
}

std::string DeviceOptions::rest() {
  std::string text;
  for (const auto& [key, value] : items_) text += (text.empty() ? "" : ",") + key + "=" + value;
  items_.clear();
  return text;
}

void DeviceOptions::done() const {
  if (items_.empty()) return;
  throw FaultError(Fault{kindOf(device_), fmt::format("{}: {} is not known", device_, items_.front().first),
                         known_.empty() ? std::string("nothing behind the name") : fmt::format("{}", fmt::join(known_, ", "))});
}

}  // namespace reachlab
