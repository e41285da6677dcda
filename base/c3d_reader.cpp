#include "base/c3d_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <span>

#include "base/c3d_format.h"
#include "base/fault.h"

namespace reachlab {

using namespace c3d;

namespace {

struct Parameter {
  int type = 0;
  std::vector<std::size_t> dimensions;
  std::span<const unsigned char> data;
};

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& origin)
      : bytes_(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()), origin_(origin) {}

  C3dFile read() {
    need(bytes_.size() >= kBlock && bytes_[1] == kMagic, "is no C3D file", "a file that begins with the bytes of C3D");
    const std::size_t section = (bytes_[0] == 0 ? 1u : bytes_[0]) - 1u;
    const std::size_t at = section * kBlock;
    need(at + kBlock <= bytes_.size() && at > 0, "ends before its parameters", "a whole file");
    processor_ = bytes_[at + 3];
    need(processor_ == kIntel || processor_ == kDec || processor_ == kMips, fmt::format("is of processor type {}", processor_),
         "84 (Intel), 85 (DEC), 86 (MIPS)");
    readParameters(at + 4);
    return readPoints();
  }

 private:
  void need(bool holds, const std::string& what, const std::string& allowed) const {
    if (!holds) throw FaultError(fileFault(origin_, what, allowed));
  }

  std::size_t word(const unsigned char* at) const {
    return processor_ == kMips ? static_cast<std::size_t>(at[0] << 8 | at[1]) : static_cast<std::size_t>(at[1] << 8 | at[0]);
  }
  int signedWord(const unsigned char* at) const { return static_cast<std::int16_t>(word(at)); }
  double real(const unsigned char* at) const {
    std::uint32_t bits = 0;
    if (processor_ == kMips) bits = std::uint32_t{at[0]} << 24 | std::uint32_t{at[1]} << 16 | std::uint32_t{at[2]} << 8 | at[3];
    else if (processor_ == kIntel) bits = std::uint32_t{at[3]} << 24 | std::uint32_t{at[2]} << 16 | std::uint32_t{at[1]} << 8 | at[0];
    else bits = std::uint32_t{at[1]} << 24 | std::uint32_t{at[0]} << 16 | std::uint32_t{at[3]} << 8 | at[2];
    const double value = static_cast<double>(std::bit_cast<float>(bits));
    return processor_ == kDec ? value / 4 : value;  // DEC's exponent is greater by two
  }

  void readParameters(std::size_t at) {
    std::map<int, std::string> groups;
    struct Found {
      int group;
      std::string name;
      Parameter parameter;
    };
    std::vector<Found> all;
    while (at + 2 <= bytes_.size()) {
      const int length = std::abs(static_cast<int>(static_cast<signed char>(bytes_[at])));
      const int id = static_cast<signed char>(bytes_[at + 1]);
      if (length == 0 || id == 0) break;
      const std::size_t offset = at + 2 + static_cast<std::size_t>(length);
      need(offset + 2 <= bytes_.size(), "ends within its parameters", "a whole file");
      std::string name(reinterpret_cast<const char*>(&bytes_[at + 2]), static_cast<std::size_t>(length));
      std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
      if (id < 0) groups[-id] = name;
      else all.push_back({id, name, parameterAt(offset + 2, name)});
      const std::size_t step = word(&bytes_[offset]);
      if (step == 0) break;
      need(step >= 2, "has a parameter " + name + " that leads nowhere", "parameters one after the other");
      at = offset + step;
    }
    for (Found& found : all) parameters_[groups[found.group] + ":" + found.name] = std::move(found.parameter);
  }

  Parameter parameterAt(std::size_t at, const std::string& name) const {
    need(at + 2 <= bytes_.size(), "ends within its parameter " + name, "a whole file");
    Parameter parameter;
    parameter.type = static_cast<signed char>(bytes_[at]);
    const std::size_t rank = bytes_[at + 1];
    need(rank <= 7 && at + 2 + rank <= bytes_.size(), "has a parameter " + name + " of too many dimensions", "up to 7");
    std::size_t count = static_cast<std::size_t>(std::abs(parameter.type));
    for (std::size_t k = 0; k < rank; ++k) {
      parameter.dimensions.push_back(bytes_[at + 2 + k]);
      count *= bytes_[at + 2 + k];
      need(count <= bytes_.size(), "has a parameter " + name + " greater than the file", "a whole file");
    }
    need(at + 2 + rank + count <= bytes_.size(), "ends within its parameter " + name, "a whole file");
    parameter.data = bytes_.subspan(at + 2 + rank, count);
    return parameter;
  }

  const Parameter* find(const std::string& name) const {
    const auto at = parameters_.find(name);
    return at == parameters_.end() ? nullptr : &at->second;
  }
  std::optional<double> number(const std::string& name) const {
    const Parameter* p = find(name);
    if (p == nullptr) return std::nullopt;
    if (p->type == kFloat && p->data.size() >= 4) return real(p->data.data());
    if (p->type == kWord && p->data.size() >= 2) return static_cast<double>(word(p->data.data()));
    if (p->type == kByte && !p->data.empty()) return static_cast<double>(p->data[0]);
    return std::nullopt;
  }
  void addTexts(const Parameter* p, std::vector<std::string>& out) const {
    if (p == nullptr || p->type != kCharacters || p->dimensions.empty()) return;
    const std::size_t width = p->dimensions[0];
    for (std::size_t at = 0; width > 0 && at + width <= p->data.size(); at += width) {
      std::string text(reinterpret_cast<const char*>(&p->data[at]), width);
      text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
      text.erase(text.find_last_not_of(' ') + 1);
      text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
      out.push_back(text);
    }
  }

  // Frames, by the count that is not cut at 65535 where the file has one.
  std::size_t frameCount() const {
    const std::size_t first = word(&bytes_[6]), last = word(&bytes_[8]);
    std::size_t frames = last >= first ? last - first + 1 : 0;
    const Parameter *begin = find("TRIAL:ACTUAL_START_FIELD"), *end = find("TRIAL:ACTUAL_END_FIELD");
    if (begin != nullptr && end != nullptr && begin->type == kWord && end->type == kWord && begin->data.size() >= 4 &&
        end->data.size() >= 4) {
      const auto whole = [this](const Parameter& p) { return word(p.data.data()) | word(p.data.data() + 2) << 16; };
      if (whole(*end) >= whole(*begin)) frames = std::max(frames, whole(*end) - whole(*begin) + 1);
    }
    if (const auto many = number("POINT:LONG_FRAMES"); many && *many >= 1 && *many < 2e9)
      frames = std::max(frames, static_cast<std::size_t>(*many));
    return frames;
  }

  // Labels beside pairs of minutes and seconds.
  std::vector<C3dEvent> events() const {
    std::vector<std::string> labels;
    addTexts(find("EVENT:LABELS"), labels);
    const Parameter* times = find("EVENT:TIMES");
    if (times == nullptr || times->type != kFloat) return {};
    std::vector<C3dEvent> found;
    for (std::size_t i = 0; i < labels.size() && 8 * (i + 1) <= times->data.size(); ++i)
      if (const double time = 60 * real(&times->data[8 * i]) + real(&times->data[8 * i + 4]); std::isfinite(time))
        found.push_back({labels[i], time});
    return found;
  }

  C3dFile readPoints() {
    C3dFile file;
    file.events = events();
    const std::size_t points = word(&bytes_[2]), signals = word(&bytes_[4]);
    need(points > 0, "has no points", "at least one point");
    file.rate = number("POINT:RATE").value_or(real(&bytes_[20]));
    need(file.rate > 0 && file.rate < 1e6 && std::isfinite(file.rate), fmt::format("has {} frames a second", file.rate), "more than 0");
    std::vector<std::string> labels, units;
    addTexts(find("POINT:LABELS"), labels);
    for (int part = 2; find(fmt::format("POINT:LABELS{}", part)) != nullptr; ++part)
      addTexts(find(fmt::format("POINT:LABELS{}", part)), labels);
    addTexts(find("POINT:UNITS"), units);
    file.pointUnit = units.empty() ? "" : units.front();
    for (std::size_t i = 0; i < points; ++i)
      file.points.push_back({i < labels.size() && !labels[i].empty() ? labels[i] : fmt::format("point{}", i + 1)});

    const double scale = number("POINT:SCALE").value_or(real(&bytes_[12]));
    const bool floats = scale < 0;
    need(std::isfinite(scale) && scale != 0, fmt::format("has the scale {}", scale), "a number that is not 0");
    const std::size_t begin = (word(&bytes_[16]) == 0 ? 0 : (word(&bytes_[16]) - 1)) * kBlock;
    const std::size_t width = floats ? 4 : 2, stride = (4 * points + signals) * width;
    file.frames = frameCount();
    need(file.frames > 0, "has no frames", "at least one frame");
    need(begin >= kBlock && begin <= bytes_.size() && file.frames <= (bytes_.size() - begin) / stride,
         fmt::format("says {} frames, and has {}", file.frames, begin <= bytes_.size() ? (bytes_.size() - begin) / stride : 0),
         "a whole file");
    for (std::size_t frame = 0; frame < file.frames; ++frame)
      for (std::size_t i = 0; i < points; ++i) {
        const unsigned char* at = &bytes_[begin + frame * stride + 4 * width * i];
        std::array<double, 4> value{};
        for (std::size_t k = 0; k < 4; ++k) value[k] = floats ? real(at + width * k) : signedWord(at + width * k) * (k < 3 ? scale : 1);
        const bool seen = value[3] >= 0 && std::isfinite(value[0]) && std::isfinite(value[1]) && std::isfinite(value[2]);
        for (std::size_t k = 0; k < 3; ++k) file.places.push_back(static_cast<float>(value[k]));
        file.seen.push_back(seen ? 1 : 0);
      }
    return file;
  }

  std::span<const unsigned char> bytes_;
  std::string origin_;
  unsigned char processor_ = kIntel;
  std::map<std::string, Parameter> parameters_;
};

}  // namespace

C3dFile readC3d(std::string_view bytes, const std::string& origin) { return Reader(bytes, origin).read(); }

}  // namespace reachlab
