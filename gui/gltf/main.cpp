// reachlab-gltf FILE: reads a glTF 2.0 scene with TinyGLTF and writes its triangles to standard output, as gui/model/model_stream.h has them. It
// is a separate process with bounds on time and memory, so that a crash of the library at a damaged file does not end the window.
#include <sys/resource.h>
#include <tiny_gltf.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "gui/model/model_stream.h"
#include "gui/model/transform.h"

namespace {

using namespace reachlab;
using namespace reachlab::gui::model;

constexpr rlim_t kMostMemory = 1'500'000'000, kMostSeconds = 10;
constexpr int kDeepest = 60;
constexpr std::size_t kMostPoints = 3 * kMostTriangles;

struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

template <typename T>
const T& at(const std::vector<T>& all, int index, const char* what) {
  if (index < 0 || static_cast<std::size_t>(index) >= all.size())
    throw Refused(std::string(what) + " " + std::to_string(index) + " is none of " + std::to_string(all.size()));
  return all[static_cast<std::size_t>(index)];
}

// Numbers of an accessor, one after the other, each read inside its buffer.
struct Numbers {
  const unsigned char* first = nullptr;
  std::size_t stride = 0, count = 0;
  int kind = 0;
  template <typename T>
  T at(std::size_t i) const {
    T value{};
    std::memcpy(&value, first + i * stride, sizeof value);
    return value;
  }
};

Numbers numbersOf(const tinygltf::Model& model, int accessorIndex, int many) {
  const tinygltf::Accessor& accessor = at(model.accessors, accessorIndex, "accessor");
  if (accessor.sparse.isSparse) throw Refused("a sparse accessor is not read");
  const tinygltf::BufferView& view = at(model.bufferViews, accessor.bufferView, "bufferView");
  const tinygltf::Buffer& buffer = at(model.buffers, view.buffer, "buffer");
  const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType));
  if (size <= 0 || tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) != many)
    throw Refused("an accessor has another type than its use asks for");
  const std::size_t element = static_cast<std::size_t>(size) * static_cast<std::size_t>(many);
  const std::size_t stride = view.byteStride == 0 ? element : view.byteStride;
  if (stride < element || stride > 255) throw Refused("byteStride is " + std::to_string(stride));
  if (accessor.count > kMostPoints) throw Refused("an accessor has " + std::to_string(accessor.count) + " elements: too many");
  if (view.byteOffset > buffer.data.size() || view.byteLength > buffer.data.size() - view.byteOffset)
    throw Refused("a bufferView runs over its buffer's end");
  if (accessor.count > 0) {
    const std::size_t needed = (accessor.count - 1) * stride + element;
    if (accessor.byteOffset > view.byteLength || needed > view.byteLength - accessor.byteOffset)
      throw Refused("an accessor runs over its bufferView's end");
  }
  return {buffer.data.data() + view.byteOffset + accessor.byteOffset, stride, accessor.count, accessor.componentType};
}

std::uint32_t wholeAt(const Numbers& n, std::size_t i) {
  if (n.kind == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return n.at<std::uint8_t>(i);
  if (n.kind == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return n.at<std::uint16_t>(i);
  if (n.kind == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) return n.at<std::uint32_t>(i);
  throw Refused("indices are of componentType " + std::to_string(n.kind));
}

class Scene {
 public:
  explicit Scene(const tinygltf::Model& model) : model_(model) {}

  Model read() {
    if (model_.scenes.empty()) throw Refused("there is no scene");
    for (const int node : at(model_.scenes, model_.defaultScene < 0 ? 0 : model_.defaultScene, "scene").nodes)
      addNode(node, Transform::Identity(), {}, 0);
    return std::move(out_);
  }

 private:
  static Vec3 three(const std::vector<double>& v, const Vec3& otherwise) {
    if (v.empty()) return otherwise;
    if (v.size() != 3) throw Refused("a node's place has " + std::to_string(v.size()) + " numbers");
    return {v[0], v[1], v[2]};
  }

  static Transform frameOf(const tinygltf::Node& node) {
    if (!node.matrix.empty()) {
      if (node.matrix.size() != 16) throw Refused("a matrix has " + std::to_string(node.matrix.size()) + " numbers");
      Transform frame = Transform::Identity();
      frame.affine() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data()).topRows<3>();
      return frame;
    }
    Transform turn = Transform::Identity();
    if (!node.rotation.empty()) {
      if (node.rotation.size() != 4) throw Refused("a rotation has " + std::to_string(node.rotation.size()) + " numbers");
      const Vec3 axis{node.rotation[0], node.rotation[1], node.rotation[2]};
      turn = turned(axis, 2 * std::atan2(norm(axis), node.rotation[3]));
    }
    return shifted(three(node.translation, {})) * turn * scaled(three(node.scale, {1, 1, 1}));
  }

  void addNode(int index, const Transform& outer, const std::string& moving, int depth) {
    if (depth > kDeepest || ++nodes_ > 100'000) throw Refused("nodes are nested without end");
    const tinygltf::Node& node = at(model_.nodes, index, "node");
    const bool named = isMoving(node.name);
    Transform own = frameOf(node);
    if (named) own.translation().setZero();
    const Transform frame = named ? own : outer * own;
    const std::string& name = named ? node.name : moving;
    if (node.mesh >= 0)
      for (const tinygltf::Primitive& primitive : at(model_.meshes, node.mesh, "mesh").primitives) addPrimitive(primitive, frame, name);
    for (const int child : node.children) addNode(child, frame, name, depth + 1);
  }

  void addPrimitive(const tinygltf::Primitive& primitive, const Transform& frame, const std::string& name) {
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != -1) return;  // points and lines are not drawn
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) throw Refused("a primitive has no POSITION");
    const Numbers places = numbersOf(model_, position->second, 3);
    if (places.kind != TINYGLTF_COMPONENT_TYPE_FLOAT) throw Refused("POSITION is no float");
    ModelPart part;
    part.name = name;
    for (std::size_t i = 0; i < places.count; ++i) {
      const auto [x, y, z] = places.at<std::array<float, 3>>(i);
      part.points.push_back(mapped(frame, {x, y, z}));
    }
    std::vector<std::uint32_t> corners;
    if (primitive.indices >= 0) {
      const Numbers indices = numbersOf(model_, primitive.indices, 1);
      for (std::size_t i = 0; i < indices.count; ++i) corners.push_back(wholeAt(indices, i));
    } else {
      for (std::size_t i = 0; i < part.points.size(); ++i) corners.push_back(static_cast<std::uint32_t>(i));
    }
    if (corners.size() % 3 != 0) throw Refused("a primitive's triangles have " + std::to_string(corners.size()) + " corners");
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) part.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    triangles_ += part.triangles.size(), points_ += part.points.size();
    if (triangles_ > kMostTriangles || points_ > kMostPoints) throw Refused("more than " + std::to_string(kMostTriangles) + " triangles");
    if (primitive.material >= 0) {
      const auto& colour = at(model_.materials, primitive.material, "material").pbrMetallicRoughness.baseColorFactor;
      if (colour.size() == 4) part.colour = {colour[0], colour[1], colour[2]}, part.opacity = colour[3];
    }
    out_.parts.push_back(std::move(part));
  }

  const tinygltf::Model& model_;
  Model out_;
  std::size_t nodes_ = 0, triangles_ = 0, points_ = 0;
};

// Pictures are not drawn, so none is decoded.
bool passOver(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int, void*) { return true; }

int refuse(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return refuse("usage: reachlab-gltf FILE");
  for (const auto& [what, most] :
       {std::pair{RLIMIT_AS, kMostMemory}, std::pair{RLIMIT_CPU, kMostSeconds}, std::pair{RLIMIT_CORE, rlim_t{0}}}) {
    const rlimit limit{most, most};
    (void)setrlimit(what, &limit);
  }
  try {
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(passOver, nullptr);
    tinygltf::Model model;
    std::string error, warning;
    const std::string file = argv[1];
    const bool binary = file.size() > 4 && file.substr(file.size() - 4) == ".glb";
    const bool good =
        binary ? loader.LoadBinaryFromFile(&model, &error, &warning, file) : loader.LoadASCIIFromFile(&model, &error, &warning, file);
    if (!good) return refuse(error.empty() ? "is no glTF 2.0 scene" : error);
    write(Scene(model).read(), stdout);
    return std::fflush(stdout) == 0 ? 0 : refuse("standard output is closed");
  } catch (const std::exception& e) {
    return refuse(e.what());
  }
}
