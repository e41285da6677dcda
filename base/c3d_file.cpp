#include "base/c3d_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <span>

#include "base/error.h"
#include "base/fault.h"

namespace reachlab {
namespace {

constexpr std::size_t kBlock = 512;
constexpr std::size_t kMostLabels = 255;  // of one parameter: its dimensions are bytes
constexpr std::uint16_t kEventKey = 12345;
constexpr unsigned char kMagic = 0x50, kIntel = 84, kDec = 85, kMips = 86;

// ---- writing

void put16(std::string& out, std::size_t value) {
  out += static_cast<char>(value & 0xff);
  out += static_cast<char>((value >> 8) & 0xff);
}
void putFloat(std::string& out, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>((bits >> shift) & 0xff);
}

// The parameter section: groups, each followed by its parameters.
class Parameters {
 public:
  void group(const std::string& name, const std::string& description) {
    ++group_;
    begin(name, -group_, 2 + 1 + description.size());
    tail(description);
  }
  void word(const std::string& name, std::size_t value) {
    open(name, 2, {}, 2, "");
    put16(text_, value);
    tail("");
  }
  void words(const std::string& name, const std::vector<std::size_t>& values, const std::string& description = "") {
    open(name, 2, {values.size()}, 2 * values.size(), description);
    for (const std::size_t value : values) put16(text_, value);
    tail(description);
  }
  void floats(const std::string& name, const std::vector<float>& values, const std::vector<std::size_t>& dimensions,
              const std::string& description = "") {
    open(name, 4, dimensions, 4 * values.size(), description);
    for (const float value : values) putFloat(text_, value);
    tail(description);
  }
  void text(const std::string& name, const std::string& value) {
    const std::string cut = value.empty() ? " " : value.substr(0, kMostLabels);
    open(name, -1, {cut.size()}, cut.size(), "");
    text_ += cut;
    tail("");
  }
  // Texts of equal length, padded; beyond 255 of them in NAME2, NAME3 …
  void texts(const std::string& name, const std::vector<std::string>& values) {
    std::size_t width = 1;
    for (const std::string& value : values) width = std::max(width, std::min<std::size_t>(value.size(), 127));
    std::size_t first = 0, part = 1;
    do {
      const std::size_t count = std::min(values.size() - first, kMostLabels);
      open(part == 1 ? name : name + std::to_string(part), -1, {width, count}, width * count, "");
      for (std::size_t i = 0; i < count; ++i) {
        std::string value = values[first + i].substr(0, width);
        value.resize(width, ' ');
        text_ += value;
      }
      tail("");
      first += count;
      ++part;
    } while (first < values.size());
  }
  // Whole blocks with their header; the record without a name ends them.
  std::string section() {
    std::string whole{1, kMagic, 0, static_cast<char>(kIntel)};
    whole += text_;
    whole += std::string(2, '\0');
    whole.resize((whole.size() + kBlock - 1) / kBlock * kBlock, '\0');
    if (whole.size() / kBlock > 255) throw FaultError(Fault{.what = "a C3D file cannot hold the names of so many points and channels"});
    whole[2] = static_cast<char>(whole.size() / kBlock);
    return whole;
  }

 private:
  // `follows`: bytes from the offset, itself included, to the next record.
  void begin(const std::string& name, int id, std::size_t follows) {
    text_ += static_cast<char>(name.size());
    text_ += static_cast<char>(id);
    text_ += name;
    put16(text_, follows);
  }
  void open(const std::string& name, int type, const std::vector<std::size_t>& dimensions, std::size_t bytes,
            const std::string& description) {
    begin(name, group_, 2 + 1 + 1 + dimensions.size() + bytes + 1 + description.size());
    text_ += static_cast<char>(type);
    text_ += static_cast<char>(dimensions.size());
    for (const std::size_t size : dimensions) text_ += static_cast<char>(size);
  }
  void tail(const std::string& description) {
    text_ += static_cast<char>(description.size());
    text_ += description;
  }
  std::string text_;
  int group_ = 0;
};

std::vector<std::string> each(const std::vector<C3dLabel>& labels, std::string C3dLabel::*member) {
  std::vector<std::string> values;
  for (const C3dLabel& label : labels) values.push_back(label.*member);
  return values;
}

std::string parametersOf(const C3dFile& file, std::size_t dataBlock) {
  Parameters p;
  const std::vector<std::size_t> last{file.frames & 0xffff, file.frames >> 16};
  const auto rate = static_cast<float>(file.rate);
  p.group("POINT", "3D points");
  p.word("USED", file.points.size());
  p.floats("SCALE", {-1}, {}, "negative: floating point");
  p.floats("RATE", {rate}, {}, "frames a second");
  p.word("DATA_START", dataBlock);
  p.word("FRAMES", std::min<std::size_t>(file.frames, 0xffff));
  p.texts("LABELS", each(file.points, &C3dLabel::name));
  p.texts("DESCRIPTIONS", each(file.points, &C3dLabel::description));
  p.texts("UNITS", {file.pointUnit});
  p.text("X_SCREEN", "+X");
  p.text("Y_SCREEN", "+Y");
  p.group("ANALOG", "signals");
  p.word("USED", file.analogs.size());
  p.texts("LABELS", each(file.analogs, &C3dLabel::name));
  p.texts("DESCRIPTIONS", each(file.analogs, &C3dLabel::description));
  p.texts("UNITS", each(file.analogs, &C3dLabel::unit));
  p.floats("GEN_SCALE", {1}, {});
  // A scale and an offset a channel, in parts as the labels are.
  std::size_t first = 0, part = 1;
  do {
    const std::size_t count = std::min(file.analogs.size() - first, kMostLabels);
    const std::string number = part == 1 ? "" : std::to_string(part);
    p.floats("SCALE" + number, std::vector<float>(count, 1.0f), {count});
    p.words("OFFSET" + number, std::vector<std::size_t>(count, 0));
    first += count;
    ++part;
  } while (first < file.analogs.size());
  p.floats("RATE", {rate}, {}, "samples a second");
  p.group("FORCE_PLATFORM", "none");
  p.word("USED", 0);
  p.group("TRIAL", "what the header cannot count");
  p.words("ACTUAL_START_FIELD", {1, 0}, "first frame: low, high word");
  p.words("ACTUAL_END_FIELD", last, "last frame: low, high word");
  p.group("EVENT", "");
  p.word("USED", file.events.size());
  if (!file.events.empty()) {
    std::vector<std::string> labels;
    std::vector<float> times;
    for (const C3dEvent& event : file.events) {
      labels.push_back(event.label);
      const double minutes = std::floor(event.time / 60);
      times.push_back(static_cast<float>(minutes));
      times.push_back(static_cast<float>(event.time - 60 * minutes));
    }
    p.texts("CONTEXTS", std::vector<std::string>(file.events.size(), "General"));
    p.texts("LABELS", labels);
    p.floats("TIMES", times, {2, file.events.size()}, "minutes, seconds");
  }
  p.group("REACHLAB", "what was recorded");
  for (const auto& [name, value] : file.notes) p.text(name, value);
  return p.section();
}

std::string headerOf(const C3dFile& file, std::size_t dataBlock) {
  std::string h;
  h += '\x02';
  h += static_cast<char>(kMagic);
  put16(h, file.points.size());
  put16(h, file.analogs.size());
  put16(h, 1);
  put16(h, std::min<std::size_t>(file.frames, 0xffff));
  put16(h, 0);
  putFloat(h, -1);
  put16(h, dataBlock);
  put16(h, file.analogs.empty() ? 0 : 1);
  putFloat(h, static_cast<float>(file.rate));
  h.resize(2 * 149, '\0');
  put16(h, kEventKey);
  const std::size_t events = std::min<std::size_t>(file.events.size(), 18);
  put16(h, events);
  put16(h, 0);
  for (std::size_t i = 0; i < 18; ++i) putFloat(h, i < events ? static_cast<float>(file.events[i].time) : 0);
  for (std::size_t i = 0; i < 18; ++i) h += i < events ? '\x01' : '\0';  // shown
  put16(h, 0);
  for (std::size_t i = 0; i < 18; ++i) {
    std::string label = i < events ? file.events[i].label.substr(0, 4) : "";
    label.resize(4, ' ');
    h += label;
  }
  h.resize(kBlock, '\0');
  return h;
}

// ---- reading

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
    if (!holds) throw FaultError(Fault{{}, what, allowed, FilePlace{origin_}});
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
    if (p->type == 4 && p->data.size() >= 4) return real(p->data.data());
    if (p->type == 2 && p->data.size() >= 2) return static_cast<double>(word(p->data.data()));
    if (p->type == 1 && !p->data.empty()) return static_cast<double>(p->data[0]);
    return std::nullopt;
  }
  void addTexts(const Parameter* p, std::vector<std::string>& out) const {
    if (p == nullptr || p->type != -1 || p->dimensions.empty()) return;
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
    if (begin != nullptr && end != nullptr && begin->type == 2 && end->type == 2 && begin->data.size() >= 4 && end->data.size() >= 4) {
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
    if (times == nullptr || times->type != 4) return {};
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

std::string c3dBytes(const C3dFile& file) {
  if (file.points.size() > 0xffff || file.analogs.size() > 0xffff || file.frames > 0x7fffffff)
    throw FaultError(Fault{.what = "a C3D file holds 65535 points and channels, and 2147483647 frames at most"});
  // The parameters say where the data begin, which hangs on their own length: that of a word does not.
  const std::size_t dataBlock = 2 + parametersOf(file, 0).size() / kBlock;
  std::string out = headerOf(file, dataBlock) + parametersOf(file, dataBlock);
  out.reserve(out.size() + file.frames * 4 * (4 * file.points.size() + file.analogs.size()) + kBlock);
  for (std::size_t frame = 0; frame < file.frames; ++frame) {
    for (std::size_t i = frame * file.points.size(); i < (frame + 1) * file.points.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) putFloat(out, file.seen[i] != 0 ? file.places[3 * i + k] : 0);
      putFloat(out, file.seen[i] != 0 ? 0 : -1);  // residual and cameras: nobody measured them
    }
    for (std::size_t i = frame * file.analogs.size(); i < (frame + 1) * file.analogs.size(); ++i) putFloat(out, file.signals[i]);
  }
  out.resize((out.size() + kBlock - 1) / kBlock * kBlock, '\0');
  return out;
}

C3dFile readC3d(std::string_view bytes, const std::string& origin) { return Reader(bytes, origin).read(); }

}  // namespace reachlab
