#include "base/c3d_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "base/c3d_format.h"
#include "base/fault.h"

namespace reachlab {

using namespace c3d;

namespace {

std::string wordsOf(const std::vector<std::size_t>& values) {
  std::string bytes;
  for (const std::size_t value : values) {
    bytes += static_cast<char>(value & 0xff);
    bytes += static_cast<char>((value >> 8) & 0xff);
  }
  return bytes;
}
void putFloat(std::string& out, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>((bits >> shift) & 0xff);
}
std::string floatsOf(const std::vector<float>& values) {
  std::string bytes;
  for (const float value : values) putFloat(bytes, value);
  return bytes;
}
std::string counted(const std::string& text) { return static_cast<char>(text.size()) + text; }
std::string padded(std::string text, std::size_t size, char with) {
  text.resize(size, with);
  return text;
}
std::string wholeBlocks(std::string bytes) {
  const std::size_t blocks = (bytes.size() + kBlock - 1) / kBlock;
  return padded(std::move(bytes), blocks * kBlock, '\0');
}

// The parameter section: groups, each followed by its parameters.
class Parameters {
 public:
  void group(const std::string& name, const std::string& description) { put(name, -++group_, counted(description)); }
  void add(const std::string& name, int type, const std::vector<std::size_t>& dimensions, const std::string& data,
           const std::string& description = "") {
    std::string body{static_cast<char>(type), static_cast<char>(dimensions.size())};
    for (const std::size_t size : dimensions) body += static_cast<char>(size);
    put(name, group_, body + data + counted(description));
  }
  void word(const std::string& name, std::size_t value) { add(name, kWord, {}, wordsOf({value})); }
  void words(const std::string& name, const std::vector<std::size_t>& values, const std::string& description = "") {
    add(name, kWord, {values.size()}, wordsOf(values), description);
  }
  void floats(const std::string& name, const std::vector<float>& values, const std::vector<std::size_t>& dimensions,
              const std::string& description = "") {
    add(name, kFloat, dimensions, floatsOf(values), description);
  }
  void text(const std::string& name, const std::string& value) {
    const std::string cut = value.empty() ? " " : value.substr(0, kMostLabels);
    add(name, kCharacters, {cut.size()}, cut);
  }
  // Texts of equal length, padded; beyond 255 of them in NAME2, NAME3 …
  void texts(const std::string& name, const std::vector<std::string>& values) {
    std::size_t width = 1;
    for (const std::string& value : values) width = std::max(width, std::min<std::size_t>(value.size(), 127));
    eachPart(values.size(), [&](const std::string& number, std::size_t first, std::size_t count) {
      std::string data;
      for (std::size_t i = first; i < first + count; ++i) data += padded(values[i], width, ' ');
      add(name + number, kCharacters, {width, count}, data);
    });
  }
  // Up to 255 of so many, and then those of the parts "2", "3" …
  template <class Put>
  static void eachPart(std::size_t all, const Put& put) {
    std::size_t first = 0, part = 1;
    do {
      const std::size_t count = std::min(all - first, kMostLabels);
      put(part == 1 ? std::string() : std::to_string(part), first, count);
      first += count;
      ++part;
    } while (first < all);
  }
  // Whole blocks with their header; the record without a name ends them.
  std::string section() {
    std::string whole = wholeBlocks(std::string{1, kMagic, 0, static_cast<char>(kIntel)} + text_ + std::string(2, '\0'));
    if (whole.size() / kBlock > 255) throw FaultError(Fault{.what = "a C3D file cannot hold the names of so many points and channels"});
    whole[2] = static_cast<char>(whole.size() / kBlock);
    return whole;
  }

 private:
  // The offset to the next record counts itself.
  void put(const std::string& name, int id, const std::string& body) {
    text_ += static_cast<char>(name.size()) + (static_cast<char>(id) + name) + wordsOf({2 + body.size()}) + body;
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
  Parameters::eachPart(file.analogs.size(), [&](const std::string& number, std::size_t, std::size_t count) {
    p.floats("SCALE" + number, std::vector<float>(count, 1.0f), {count});
    p.words("OFFSET" + number, std::vector<std::size_t>(count, 0));
  });
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
  std::string h = std::string{2, kMagic} +
                  wordsOf({file.points.size(), file.analogs.size(), 1, std::min<std::size_t>(file.frames, 0xffff), 0}) + floatsOf({-1}) +
                  wordsOf({dataBlock, file.analogs.empty() ? 0u : 1u}) + floatsOf({static_cast<float>(file.rate)});
  const std::size_t events = std::min<std::size_t>(file.events.size(), kMostEvents);
  h = padded(h, 2 * 149, '\0') + wordsOf({kEventKey, events, 0});
  for (std::size_t i = 0; i < kMostEvents; ++i) putFloat(h, i < events ? static_cast<float>(file.events[i].time) : 0);
  h += padded(std::string(events, '\x01'), kMostEvents, '\0') + wordsOf({0});  // shown
  for (std::size_t i = 0; i < kMostEvents; ++i) h += padded(i < events ? file.events[i].label : "", 4, ' ');
  return wholeBlocks(std::move(h));
}

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
  return wholeBlocks(std::move(out));
}

}  // namespace reachlab
