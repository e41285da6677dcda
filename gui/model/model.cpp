#include "gui/model/model.h"

#include <fmt/format.h>

#include <QElapsedTimer>
#include <QFileInfo>
#include <QProcess>
#include <cmath>
#include <sstream>

#include "base/fault.h"
#include "base/json/json_reader.h"
#include "base/system/helper_program.h"
#include "base/text_file.h"
#include "gui/model/model_stream.h"

namespace reachlab::gui::model {
namespace {

constexpr int kPatienceMs = 20'000;

FaultError refusal(const std::string& file, const std::string& what, const std::string& allowed = {}) {
  return FaultError(Fault{{}, what, allowed, FilePlace{file}});
}

// What another program says of a file, as one short line.
std::string shortened(std::string words) {
  for (char& c : words)
    if (static_cast<unsigned char>(c) < 32) c = ' ';
  while (!words.empty() && words.back() == ' ') words.pop_back();
  constexpr std::size_t kMost = 200;
  return words.size() > kMost ? words.substr(0, kMost) + " …" : words;
}

Model readGltf(const std::string& file, const Watch& watch) {
  QProcess process;
  process.start(QString::fromStdString(findHelperProgram("reachlab-gltf", file, "which reads glTF (VRML 2.0 needs no program)")),
                {QString::fromStdString(file)});
  bool ended = !process.waitForStarted();
  QElapsedTimer clock;
  for (clock.start(); !ended && clock.elapsed() < kPatienceMs; ended = process.waitForFinished(50))
    if (watch) watch(std::nan(""));  // throws to give up: the process ends with its QProcess
  if (process.state() != QProcess::NotRunning || process.error() == QProcess::FailedToStart) {
    process.kill();
    process.waitForFinished();
    throw refusal(file, fmt::format("was not read within {} s", kPatienceMs / 1000), "a smaller scene");
  }
  if (process.exitStatus() != QProcess::NormalExit)
    throw refusal(file, "is damaged: the reader of glTF fell over it", "a glTF 2.0 file that a validator passes");
  if (process.exitCode() != 0)
    throw refusal(file, "is no glTF 2.0 scene that is read: " + shortened(process.readAllStandardError().toStdString()));
  return readStream(process.readAllStandardOutput().toStdString(), file);
}

}  // namespace

std::size_t Model::triangleCount() const {
  std::size_t count = 0;
  for (const ModelPart& part : parts) count += part.triangles.size();
  return count;
}

void check(const Model& model, const std::string& file) {
  if (model.triangleCount() > kMostTriangles)
    throw refusal(file, fmt::format("has {} triangles", model.triangleCount()), fmt::format("up to {}", kMostTriangles));
  for (const ModelPart& part : model.parts) {
    for (const Vec3& p : part.points)
      if (!isFinite(p) || norm(p) > 1e6) throw refusal(file, "has a point that is not finite, or a thousand kilometres away", "metres");
    for (const auto& triangle : part.triangles)
      for (const std::uint32_t corner : triangle)
        if (corner >= part.points.size())
          throw refusal(file, fmt::format("has the corner {} of {} points", corner, part.points.size()), "corners that are points");
    for (const double share : {part.colour[0], part.colour[1], part.colour[2], part.opacity})
      if (!(share >= 0 && share <= 1)) throw refusal(file, "has a colour outside 0 to 1", "0 to 1");
  }
}

Model readStream(std::string_view bytes, const std::string& file) {
  const auto broken = [&] { return refusal(file, "is damaged: its reader wrote no whole scene"); };
  if (!bytes.starts_with(kStreamHead)) throw broken();
  bytes.remove_prefix(kStreamHead.size());
  Model model;
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    if (end == std::string_view::npos || !bytes.starts_with("part ")) throw broken();
    std::istringstream line{std::string(bytes.substr(5, end - 5))};
    bytes.remove_prefix(end + 1);
    ModelPart part;
    std::size_t points = 0, triangles = 0;
    line >> part.name >> part.colour[0] >> part.colour[1] >> part.colour[2] >> part.opacity >> points >> triangles;
    if (!line || line.peek() != std::istringstream::traits_type::eof()) throw broken();
    if (part.name == "-") part.name.clear();
    else if (!isMoving(part.name)) throw broken();
    if (points > bytes.size() / sizeof(Vec3) || triangles > (bytes.size() - points * sizeof(Vec3)) / sizeof part.triangles[0])
      throw broken();
    part.points.resize(points);
    part.triangles.resize(triangles);
    if (points > 0) std::memcpy(part.points.data(), bytes.data(), points * sizeof(Vec3));
    bytes.remove_prefix(points * sizeof(Vec3));
    if (triangles > 0) std::memcpy(part.triangles.data(), bytes.data(), triangles * sizeof part.triangles[0]);
    bytes.remove_prefix(triangles * sizeof part.triangles[0]);
    model.parts.push_back(std::move(part));
  }
  if (model.triangleCount() == 0) throw refusal(file, "has nothing to draw", "triangles");
  check(model, file);
  return model;
}

Model readModel(const std::string& file, const Watch& watch) {
  const QFileInfo info(QString::fromStdString(file));
  if (!info.isFile()) throw ResourceError(file + ": there is no such file");
  if (static_cast<std::uintmax_t>(info.size()) > kMostBytes)
    throw refusal(file, fmt::format("has {:.0f} MB", 1e-6 * static_cast<double>(info.size())),
                  fmt::format("up to {:.0f} MB", 1e-6 * static_cast<double>(kMostBytes)));
  const QString ending = info.suffix().toLower();
  if (ending == QLatin1String("wrl") || ending == QLatin1String("vrml")) return readVrml(readTextFile(file, kMostBytes), file, watch);
  if (ending == QLatin1String("gltf") || ending == QLatin1String("glb")) return readGltf(file, watch);
  throw refusal(file, "is no scene that is read, by its ending", ".wrl (VRML 2.0), .gltf, .glb");
}

}  // namespace reachlab::gui::model
