// Scenes from files: what is good is drawn where it belongs, and what is damaged is refused in words.
#include <gtest/gtest.h>

#include <QElapsedTimer>
#include <QTest>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "base/fault.h"
#include "gui/model/model.h"
#include "gui/model/model_reader.h"
#include "gui/model/model_stream.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace reachlab::gui::model {
namespace {

using Json = nlohmann::json;

const char* const kTable = R"(#VRML V2.0 utf8
WorldInfo { title "a table { with a brace" info [ "}" ] }
DEF wood Appearance { material Material { diffuseColor 0.5 0.3 0.1 transparency 0.25 shininess 0.4 } }
Transform {
  translation 0 -0.1 0  # its top
  children [
    Shape { appearance USE wood geometry Box { size 0.6 0.02 0.4 } }
    DEF leg Transform { translation 0.28 -0.2 0.18 children Shape { appearance USE wood geometry Cylinder { radius 0.01, height 0.4 } } }
    Transform { rotation 0 1 0 3.14159265358979 children USE leg }
  ]
}
DEF mass1 Transform { translation 5 5 5 scale 0.02 0.02 0.02 children [ Shape { geometry Sphere { } } ] }
DEF hand Transform { children Shape { geometry IndexedFaceSet {
  coord Coordinate { point [ 0 0 0, 0.01 0 0, 0.01 0.01 0, 0 0.01 0 ] } coordIndex [ 0 1 2 3 -1 ] solid FALSE } } }
DEF clock TimeSensor { cycleInterval 2 }
ROUTE clock.fraction_changed TO hand.set_translation
)";

const ModelPart& named(const Model& model, std::string_view name, std::size_t skip = 0) {
  for (const ModelPart& part : model.parts)
    if (part.name == name && skip-- == 0) return part;
  throw std::runtime_error("no part " + std::string(name));
}

Vec3 middleOf(const ModelPart& part) {
  Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
  for (const Vec3& p : part.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return 0.5 * (low + high);
}

std::string vrml(const std::string& body) { return "#VRML V2.0 utf8\n" + body; }

TEST(Vrml, PutsEachShapeWhereItsFramesSay) {
  const Model model = readVrml(kTable, "table.wrl");
  const ModelPart& top = named(model, "");
  EXPECT_EQ(top.triangles.size(), 12u);
  EXPECT_NEAR(norm(middleOf(top) - Vec3{0, -0.1, 0}), 0, 1e-12);
  EXPECT_NEAR(top.colour[0], 0.5, 1e-12);
  EXPECT_NEAR(top.opacity, 0.75, 1e-12);
  EXPECT_NEAR(norm(middleOf(named(model, "", 1)) - Vec3{0.28, -0.3, 0.18}), 0, 1e-12);
  EXPECT_NEAR(norm(middleOf(named(model, "", 2)) - Vec3{-0.28, -0.3, -0.18}), 0, 1e-12) << "the leg again, turned by pi about y";
}

TEST(Vrml, WhatMovesHasItsOriginWhereTheMassIs) {
  const Model model = readVrml(kTable, "table.wrl");
  EXPECT_NEAR(norm(middleOf(named(model, "mass1"))), 0, 1e-12) << "its own shift is the mass's";
  for (const Vec3& p : named(model, "mass1").points) EXPECT_NEAR(norm(p), 0.02, 1e-12);
  EXPECT_EQ(named(model, "hand").triangles.size(), 2u) << "a face of four corners";
}

TEST(Vrml, FacesOutwards) {
  const char* const solids[] = {"Box { }", "Sphere { }", "Cylinder { }", "Cone { }"};
  const double volumes[] = {8, 4.0 / 3 * std::numbers::pi, 2 * std::numbers::pi, 2.0 / 3 * std::numbers::pi};
  for (std::size_t i = 0; i < 4; ++i) {
    const Model model = readVrml(vrml("Shape { geometry " + std::string(solids[i]) + " }"), "solid.wrl");
    double volume = 0;  // by the divergence theorem; inside out it would be negative
    for (const auto& t : model.parts[0].triangles)
      volume += dot(model.parts[0].points[t[0]], cross(model.parts[0].points[t[1]], model.parts[0].points[t[2]])) / 6;
    EXPECT_NEAR(volume, volumes[i], 0.03 * volumes[i]) << solids[i] << ", of 28 sides";
  }
}

// Twenty-six files that are damaged in one way each, and a word of what is said.
TEST(Vrml, RefusesDamagedFilesInWords) {
  const std::string faces = "Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0 ] } coordIndex [ ";
  std::string deep;
  for (int i = 0; i < 20'000; ++i) deep += "Group { children [ ";
  std::string bomb = "DEF a0 Shape { geometry Box { } }\n";
  for (int i = 1; i < 40; ++i)
    bomb += "DEF a" + std::to_string(i) + " Group { children [ USE a" + std::to_string(i - 1) + " USE a" + std::to_string(i - 1) + " ] }\n";
  const std::pair<std::string, std::string> files[] = {
      {"", "does not begin as a VRML 2.0 file"},
      {"#VRML V1.0 ascii\nSeparator { }", "does not begin as a VRML 2.0 file"},
      {std::string(300, '\0'), "does not begin"},
      {"\x7f"
       "ELF\x02\x01\x01",
       "does not begin"},
      {vrml(""), "has nothing to draw"},
      {vrml("Group { }"), "has nothing to draw"},
      {vrml("Shape {"), "ends in the middle"},
      {vrml("Shape { geometry Box { size 1 1"), "ends in the middle"},
      {vrml("Shape { geometry Box { size 1 one 1 } }"), "one"},
      {vrml("Shape { geometry Box { size 1 -1 1 } }"), "more than 0"},
      {vrml("Shape { geometry Sphere { radius 1e999 } }"), "1e999"},
      {vrml("Shape { geometry Sphere { radius nan } }"), "nan"},
      {vrml("Shape { geometry Torus { } }"), "Torus"},
      {vrml("Shape { geometry Material { } }"), "is no geometry"},
      {vrml("Shape { appearance Appearance { material Material { diffuseColor 1 2 1 } } geometry Box { } }"), "0 to 1"},
      {vrml("USE table"), "not defined before"},
      {vrml("DEF a Group { children USE a }"), "not defined before"},
      {vrml("PROTO Leg [ ] { Box { } }"), "PROTO"},
      {vrml("Inline { url \"http://somewhere/else.wrl\" }"), "Inline"},
      {vrml(faces + "0 50000 2 -1 ] } }"), "the corner 50000, and there are 3 points"},
      {vrml(faces + "0 1 -7 -1 ] } }"), "-7"},
      {vrml(faces + "0 1 2.5 -1 ] } }"), "2.5"},
      {vrml("Shape { geometry IndexedFaceSet { coordIndex [ 0 1 2 -1 ] } }"), "there are 0 points"},
      {vrml("Shape { geometry Box { } ] }"), "]"},
      {vrml("WorldInfo { title \"never ends }"), "never ends"},
      {vrml(deep), "nested deeper"},
      {vrml(bomb), "more than 500000 triangles"},
  };
  for (const auto& [text, word] : files) {
    const std::string said = refusalOf<FaultError>([&, &text = text] { return readVrml(text, "bad.wrl"); });
    EXPECT_NE(said.find(word), std::string::npos) << text.substr(0, 120) << "\n  said: " << said;
    EXPECT_EQ(said.find("bad.wrl"), 0u) << said;
    EXPECT_LT(said.size(), 400u) << said;
  }
}

TEST(Vrml, MutantsAreReadOrRefused) {
  std::mt19937 random(2026);
  const std::string good = kTable;
  int refused = 0;
  constexpr int kMutants = 4000;
  for (int i = 0; i < kMutants; ++i) {
    std::string text = good;
    for (std::size_t n = 1 + random() % 4; n-- > 0;) {
      const std::size_t at = 16 + random() % (text.size() - 16), length = std::min<std::size_t>(1 + random() % 12, text.size() - at);
      switch (random() % 4) {
        case 0: text.erase(at, length); break;
        case 1: text.insert(at, text.substr(16 + random() % (text.size() - 16), length)); break;
        case 2: text[at] = static_cast<char>(random()); break;
        default: text.replace(at, length, random() % 2 == 0 ? " -99999 " : " } "); break;
      }
    }
    const std::string said = refusalOf<FaultError>([&] { check(readVrml(text, "mutant.wrl"), "mutant.wrl"); });
    refused += !said.empty();
  }
  EXPECT_GT(refused, kMutants / 4);
  EXPECT_LT(refused, kMutants);
}

TEST(ModelStream, MutantsOfTheReadersAnswerAreReadOrRefused) {
  const Model model = readVrml(kTable, "table.wrl");
  char* bytes = nullptr;
  std::size_t size = 0;
  std::FILE* out = open_memstream(&bytes, &size);
  write(model, out);
  std::fclose(out);
  const std::string good(bytes, size);
  std::free(bytes);
  EXPECT_EQ(readStream(good, "x").triangleCount(), model.triangleCount());
  std::mt19937 random(7);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string mutant = good;
    for (std::size_t n = 1 + random() % 6; n-- > 0;) mutant[random() % mutant.size()] = static_cast<char>(random());
    if (random() % 3 == 0) mutant.resize(random() % mutant.size());
    refused += !refusalOf<FaultError>([&] { return readStream(mutant, "x"); }).empty();
  }
  EXPECT_GT(refused, 500);
}

class Gltf : public ::testing::Test {
 protected:
  // One triangle of floats and its three indices, after one another in one buffer.
  static Json good() {
    const float places[] = {0, 0, 0, 0.1f, 0, 0, 0, 0.1f, 0};
    const std::uint16_t corners[] = {0, 1, 2};
    std::string bytes(reinterpret_cast<const char*>(places), sizeof places);
    bytes.append(reinterpret_cast<const char*>(corners), sizeof corners);
    const QByteArray coded = QByteArray(bytes.data(), static_cast<int>(bytes.size())).toBase64();
    return {
        {"asset", {{"version", "2.0"}}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0}}}}},
        {"nodes", {{{"name", "mass2"}, {"mesh", 0}, {"translation", {1, 2, 3}}, {"scale", {2, 2, 2}}}}},
        {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", 0}}}}}}},
        {"materials", {{{"pbrMetallicRoughness", {{"baseColorFactor", {0.2, 0.4, 0.6, 0.5}}}}}}},
        {"accessors",
         {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}, {"min", {0, 0, 0}}, {"max", {0.1, 0.1, 0}}},
          {{"bufferView", 1}, {"componentType", 5123}, {"count", 3}, {"type", "SCALAR"}}}},
        {"bufferViews", {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 36}}, {{"buffer", 0}, {"byteOffset", 36}, {"byteLength", 6}}}},
        {"buffers", {{{"byteLength", 42}, {"uri", "data:application/octet-stream;base64," + coded.toStdString()}}}}};
  }
  std::string said(const std::string& text, const char* name = "scene.gltf") {
    const std::string file = folder_.write(name, text);
    return refusalOf<FaultError>([&] { return readModel(file); });
  }
  TemporaryFolder folder_;
};

TEST_F(Gltf, IsReadByAProcessOfItsOwn) {
  const Model model = readModel(folder_.write("scene.gltf", good().dump()));
  ASSERT_EQ(model.parts.size(), 1u);
  EXPECT_EQ(model.parts[0].name, "mass2");
  EXPECT_NEAR(norm(model.parts[0].points[1] - Vec3{0.2, 0, 0}), 0, 1e-6) << "scaled, not shifted";
  EXPECT_NEAR(model.parts[0].colour[2], 0.6, 1e-12);
  EXPECT_NEAR(model.parts[0].opacity, 0.5, 1e-12);
}

// Sixteen files, each damaged in one place; among them all that VTK's own importer fell over.
TEST_F(Gltf, RefusesDamagedFilesInWords) {
  Json badIndex = good();
  {
    std::string bytes(42, '\0');
    const std::uint16_t corners[] = {0, 1, 60000};
    std::memcpy(bytes.data() + 36, corners, sizeof corners);
    badIndex["buffers"][0]["uri"] = "data:application/octet-stream;base64," + QByteArray(bytes.data(), 42).toBase64().toStdString();
  }
  Json circle = good();
  circle["nodes"][0]["children"] = {0};
  std::vector<std::string> files{"", "{", "[]", R"({"asset": {"version": "2.0"}})", badIndex.dump(), circle.dump()};
  const Json damaged =
      Json::parse(R"([["/accessors/0/count", 3000000000], ["/accessors/0/count", 4], ["/accessors/0/byteOffset", 4000000000],
    ["/accessors/0/componentType", 9], ["/accessors/1/componentType", 5126], ["/accessors/0/type", "SCALAR"],
    ["/accessors/0/bufferView", 7], ["/bufferViews/0/byteOffset", 1000000], ["/bufferViews/0/buffer", 3],
    ["/meshes/0/primitives/0/attributes/POSITION", 99], ["/meshes/0/primitives/0/indices", 12],
    ["/meshes/0/primitives/0/material", 5], ["/nodes/0/mesh", 8], ["/nodes/0/matrix", [1, 2, 3]], ["/scenes/0/nodes", [4]],
    ["/buffers/0/uri", "missing.bin"]])");
  for (const Json& one : damaged) {
    Json json = good();
    json[Json::json_pointer(one[0].get<std::string>())] = one[1];
    files.push_back(json.dump());
  }
  for (const std::string& text : files) {
    const std::string words = said(text);
    EXPECT_FALSE(words.empty()) << text.substr(0, 300);
    EXPECT_LT(words.size(), 500u) << words;
  }
  EXPECT_FALSE(said("glTF\x02", "scene.glb").empty());
  EXPECT_FALSE(said("solid stl", "scene.stl").empty());
}

TEST_F(Gltf, MutantsAreReadOrRefused) {
  std::mt19937 random(11);
  const std::string text = good().dump();
  int refused = 0;
  constexpr int kMutants = 60;  // a process each
  for (int i = 0; i < kMutants; ++i) {
    std::string mutant = text;
    for (std::size_t n = 1 + random() % 3; n-- > 0;) {
      const std::size_t at = random() % mutant.size();
      if (random() % 2 == 0) mutant[at] = static_cast<char>('0' + random() % 10);
      else mutant.erase(at, 1 + random() % 3);
    }
    refused += !said(mutant).empty();
  }
  EXPECT_GT(refused, kMutants / 3);
}

// So long that it is told of and can be given up.
std::string longScene() {
  std::string points;
  for (int i = 0; i < 900'000; ++i) points += "0.125 0.25 0.375 ";
  return vrml("Shape { geometry IndexedFaceSet { coord Coordinate { point [ " + points + "] } coordIndex [ 0 1 2 -1 ] } }");
}

class ModelReaders : public ::testing::Test {
 protected:
  ModelReaders() {
    QObject::connect(&reader_, &ModelReader::ready, [this] { ++ready_; });
    QObject::connect(&reader_, &ModelReader::failed, [this](const QString& words) { failed_ = words; });
    QObject::connect(&reader_, &ModelReader::progressed, [this](const QString&, int percent) { percents_.push_back(percent); });
    QObject::connect(&reader_, &ModelReader::idle, [this] { ++idle_; });
  }
  TemporaryFolder folder_;
  ModelReader reader_;
  int ready_ = 0, idle_ = 0;
  QString failed_;
  std::vector<int> percents_;
};

TEST_F(ModelReaders, TellHowFarTheyAreAndAreGivenUp) {
  const std::string file = folder_.write("long.wrl", longScene());
  reader_.begin(file);
  const int before = idle_;
  reader_.cancel();
  ASSERT_TRUE(QTest::qWaitFor([&] { return idle_ > before; }, 30'000));
  EXPECT_EQ(ready_, 0);
  EXPECT_TRUE(failed_.isEmpty());
  EXPECT_EQ(reader_.model(), nullptr);
  std::vector<double> shares;
  readModel(file, [&](double share) { shares.push_back(share); });
  ASSERT_GT(shares.size(), 100u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_GT(shares.back(), 0.98);
}

// The bound of scene files is told as 64 MB; that of experiments, 16 MiB, held instead.
TEST_F(ModelReaders, ReadALargeFileUpToTheBoundThatIsTold) {
  const std::string line = "# " + std::string(1'000'000, 'x') + '\n';
  std::string text = kTable;
  while (text.size() < 20'000'000) text += line;
  EXPECT_EQ(readModel(folder_.write("large.wrl", text)).parts.size(), readVrml(kTable, "table.wrl").parts.size());
  while (text.size() < 65'000'000) text += line;
  const std::string larger = folder_.write("larger.wrl", text);
  EXPECT_NE(refusalOf<FaultError>([&] { return readModel(larger); }).find("64 MB"), std::string::npos);
}

TEST_F(ModelReaders, TheNewestWinsAndWaitsForNobodyInTheWindow) {
  const std::string first = folder_.write("long.wrl", longScene()), second = folder_.write("table.wrl", kTable);
  QElapsedTimer clock;
  clock.start();
  reader_.begin(first);
  reader_.begin(second);
  EXPECT_LT(clock.elapsed(), 50) << "the window went on";
  ASSERT_TRUE(QTest::qWaitFor([&] { return ready_ > 0; }, 30'000));
  EXPECT_EQ(reader_.model()->triangleCount(), readVrml(kTable, "table.wrl").triangleCount());
  reader_.begin(folder_ / "missing.wrl");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !failed_.isEmpty(); }, 30'000));
  EXPECT_EQ(reader_.model(), nullptr);
  reader_.begin({});
  EXPECT_EQ(ready_, 2) << "no scene is there at once";
}

}  // namespace
}  // namespace reachlab::gui::model
