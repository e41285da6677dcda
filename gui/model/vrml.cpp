#include <fmt/format.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "gui/model/shapes.h"
#include "gui/model/transform.h"
#include "gui/model/vrml_words.h"

namespace reachlab::gui::model {
namespace {

constexpr int kDeepest = 60;
constexpr std::size_t kMostPoints = 1'000'000, kMostNodes = 200'000;

struct Look {
  std::array<double, 3> colour{0.8, 0.8, 0.8};
  double opacity = 1;
};

// A node as it was read; DEF names it, USE means it again.
struct Node {
  std::string name;
  Transform frame = Transform::Identity();    // of a Transform
  Transform unmoved = Transform::Identity();  // the same without its shift
  std::vector<std::shared_ptr<const Node>> children;
  std::shared_ptr<const Node> appearance, geometry;  // of a Shape
  std::optional<Look> look;                          // of an Appearance or Material
  std::optional<ModelPart> solid;                    // of a geometry, without its name and colour
  std::optional<std::vector<Vec3>> points;           // of a Coordinate
  bool passedOver = false;
};

using NodePtr = std::shared_ptr<const Node>;

// About an axis. [rad]
struct Turn {
  Vec3 axis{0, 0, 1};
  double angle = 0;
};

const char* const kKnown =
    "Group, Transform, Shape, Appearance, Material, Box, Sphere, Cylinder, Cone, IndexedFaceSet, Coordinate, Anchor, Billboard, Collision";
// Nothing of them is drawn. Each stands between blanks.
constexpr std::string_view kPassedOver =
    " WorldInfo NavigationInfo Viewpoint Background Fog DirectionalLight PointLight SpotLight TimeSensor TouchSensor"
    " PlaneSensor SphereSensor CylinderSensor ProximitySensor VisibilitySensor PositionInterpolator OrientationInterpolator"
    " ColorInterpolator ScalarInterpolator CoordinateInterpolator NormalInterpolator Sound AudioClip Script ImageTexture"
    " PixelTexture MovieTexture TextureTransform TextureCoordinate Normal Color PointSet IndexedLineSet Text FontStyle ";

class Reader {
 public:
  Reader(std::string_view text, const std::string& file, const Watch& watch) : words_(text, file, watch) {}

  std::vector<NodePtr> readAll() {
    std::vector<NodePtr> nodes;
    while (!words_.ended()) readStatement(nodes, 0);
    return nodes;
  }

 private:
  // Nothing is drawn of a ROUTE.
  bool skipRoute() {
    if (!words_.tryTake("ROUTE")) return false;
    words_.take();
    words_.expect("TO", "ROUTE");
    words_.take();
    return true;
  }

  void readStatement(std::vector<NodePtr>& nodes, int depth) {
    if (skipRoute()) return;
    for (const char* refused : {"PROTO", "EXTERNPROTO", "Inline"})
      if (words_.word() == refused) words_.fail(refused, "is not read", "a scene that is written out, in one file");
    if (words_.tryTake("NULL")) return;
    nodes.push_back(readNode(depth));
  }

  NodePtr readNode(int depth) {
    if (depth > kDeepest) words_.fail({}, fmt::format("is nested deeper than {}", kDeepest), "a flatter scene");
    if (++nodes_ > kMostNodes) words_.fail({}, fmt::format("has more than {} nodes", kMostNodes), "a smaller scene");
    if (words_.tryTake("USE")) {
      const auto known = defined_.find(std::string(words_.word()));
      if (known == defined_.end())
        words_.fail("USE", fmt::format("means {}, which is not defined before", words_.shown()), "a name after DEF");
      words_.take();
      return known->second;
    }
    std::string name;
    if (words_.tryTake("DEF")) name = takeName("DEF");
    const std::string type(words_.word());
    if (words_.isQuoted() || words_.ended() || words_.isBracket())
      words_.fail({}, words_.ended() ? "ends in the middle" : fmt::format("has {} where a node begins", words_.shown()), kKnown);
    auto node = std::make_shared<Node>();
    node->name = name;
    node->passedOver = kPassedOver.find(" " + type + " ") != std::string_view::npos;
    const auto read = readers().find(type);
    if (!node->passedOver && read == readers().end()) words_.fail(words_.shown(), "is no node that is read", kKnown);
    words_.take();
    words_.expect("{", type);
    if (node->passedOver) skipBlock(type);
    else (this->*read->second)(*node, depth);
    if (!name.empty()) defined_[name] = node;
    return node;
  }

  std::string takeName(const std::string& key) {
    if (words_.isQuoted() || words_.ended() || words_.isBracket()) words_.fail(key, words_.found(), "a name");
    return words_.take();
  }

  using ReadNode = void (Reader::*)(Node&, int);
  static const std::map<std::string, ReadNode>& readers() {
    static const std::map<std::string, ReadNode> all{
        {"Group", &Reader::readGroup},           {"Transform", &Reader::readTransform},  {"Anchor", &Reader::readGroup},
        {"Billboard", &Reader::readGroup},       {"Collision", &Reader::readGroup},      {"Shape", &Reader::readShape},
        {"Appearance", &Reader::readAppearance}, {"Material", &Reader::readMaterial},    {"Box", &Reader::readBox},
        {"Sphere", &Reader::readSphere},         {"Cylinder", &Reader::readCylinder},    {"Cone", &Reader::readCone},
        {"IndexedFaceSet", &Reader::readFaces},  {"Coordinate", &Reader::readCoordinate}};
    return all;
  }

  // The value of a field of which nothing is drawn: words up to the next field are its own only where brackets hold them together.
  void skipValue(const std::string& field) {
    if (words_.tryTake("{")) return skipBlock(field);
    if (words_.tryTake("[")) return skipTo("]", field);
    if (words_.tryTake("DEF")) takeName("DEF");
    if (words_.tryTake("USE")) return static_cast<void>(takeName("USE"));
    if (words_.word() == "}" || words_.word() == "]" || words_.ended()) words_.fail(field, "has no value");
    // A node, or one value of one or several words.
    const bool quoted = words_.isQuoted();
    const std::string word = words_.take();
    if (quoted) return;
    if (words_.tryTake("{")) return skipBlock(word);
    while (!words_.ended() && isNumber(words_.word())) words_.take();
  }

  static bool isNumber(std::string_view word) {
    return !word.empty() && (word[0] == '-' || word[0] == '+' || word[0] == '.' || (word[0] >= '0' && word[0] <= '9'));
  }

  void skipBlock(const std::string& what) { skipTo("}", what); }
  void skipTo(std::string_view closing, const std::string& what) {
    std::vector<std::string> open{std::string(closing)};
    while (!open.empty()) {
      if (words_.ended()) words_.fail(what, "ends in the middle", open.back());
      const bool bracket = !words_.isQuoted() && words_.isBracket();
      const std::string word = words_.take();
      if (!bracket) continue;
      if (word == "{") open.emplace_back("}");
      else if (word == "[") open.emplace_back("]");
      else if (word == open.back()) open.pop_back();
      else words_.fail(what, fmt::format("closes with {}", word), open.back());
      if (open.size() > 4 * kDeepest) words_.fail(what, "is nested too deep", "a flatter scene");
    }
  }

  // Takes the value of the field of that name.
  using TakeField = std::function<void(const std::string& field)>;

  // Field after field up to the node's end. The value of a field that is not known is passed over.
  void readFields(const std::string& type, const std::map<std::string, TakeField>& known) {
    while (!words_.tryTake("}")) {
      if (words_.ended()) words_.fail(type, "ends in the middle", "}");
      if (words_.isQuoted() || words_.isBracket() || isNumber(words_.word()))
        words_.fail(type, fmt::format("has {} where a field begins", words_.shown()));
      if (skipRoute()) continue;
      const std::string field = words_.take();
      const auto take = known.find(field);
      if (take != known.end()) take->second(field);
      else skipValue(field);
    }
  }

  void read(const std::string& field, Vec3& vector) {
    for (double* const part : {&vector.x, &vector.y, &vector.z}) *part = words_.number(field);
  }
  void read(const std::string& field, Turn& turn) {
    read(field, turn.axis);
    turn.angle = words_.number(field);
  }
  void read(const std::string& field, bool& value) {
    value = words_.tryTake("TRUE");
    if (!value && !words_.tryTake("FALSE")) words_.fail(field, "has " + words_.shown(), "TRUE, FALSE");
  }
  void readLength(const std::string& field, double& value) {
    value = words_.number(field);
    if (!(value > 0)) words_.fail(field, fmt::format("is {}", value), "more than 0");
  }
  double readShare(const std::string& field) {
    const double value = words_.number(field);
    if (value < 0 || value > 1) words_.fail(field, fmt::format("is {}", value), "0 to 1");
    return value;
  }
  // One value, or several in brackets.
  template <typename ReadOne>
  void readList(ReadOne readOne) {
    if (!words_.tryTake("[")) return readOne();
    while (!words_.tryTake("]")) readOne();
  }

  template <typename Value>
  TakeField into(Value& value) {
    return [this, &value](const std::string& field) { read(field, value); };
  }
  TakeField lengthInto(double& value) {
    return [this, &value](const std::string& field) { readLength(field, value); };
  }
  // `has`: what the node must hold. `type`: the node's, in messages.
  template <typename Has>
  TakeField nodeInto(NodePtr& node, int depth, Has has, const std::string& type, const std::string& allowed, bool mayBePassedOver = false) {
    return [=, this, &node](const std::string& field) {
      if (words_.tryTake("NULL")) return;
      node = readNode(depth + 1);
      if (!((*node).*has) && !(mayBePassedOver && node->passedOver)) words_.fail(field, "is no " + type, allowed);
    };
  }
  TakeField childrenInto(Node& node, int depth) {
    return [this, &node, depth](const std::string& field) {
      if (!words_.tryTake("[")) return readStatement(node.children, depth + 1);
      while (!words_.tryTake("]")) {
        if (words_.ended()) words_.fail(field, "ends in the middle", "]");
        readStatement(node.children, depth + 1);
      }
    };
  }

  void readGroup(Node& node, int depth) { readFields("Group", {{"children", childrenInto(node, depth)}}); }

  void readTransform(Node& node, int depth) {
    Vec3 shift, centre, scale{1, 1, 1};
    Turn turn, scaleTurn;
    readFields("Transform", {{"translation", into(shift)},
                             {"center", into(centre)},
                             {"scale", into(scale)},
                             {"rotation", into(turn)},
                             {"scaleOrientation", into(scaleTurn)},
                             {"children", childrenInto(node, depth)}});
    node.unmoved =
        turned(turn.axis, turn.angle) * turned(scaleTurn.axis, scaleTurn.angle) * scaled(scale) * turned(scaleTurn.axis, -scaleTurn.angle);
    node.frame = shifted(shift + centre) * node.unmoved * shifted(-centre);
  }

  void readShape(Node& node, int depth) {
    readFields("Shape", {{"appearance", nodeInto(node.appearance, depth, &Node::look, "Appearance", "Appearance", true)},
                         {"geometry",
                          nodeInto(node.geometry, depth, &Node::solid, "geometry", "Box, Sphere, Cylinder, Cone, IndexedFaceSet", true)}});
  }

  void readAppearance(Node& node, int depth) {
    NodePtr material;
    readFields("Appearance", {{"material", nodeInto(material, depth, &Node::look, "Material", "Material")}});
    node.look = material ? *material->look : Look{};
  }

  void readMaterial(Node& node, int) {
    Look& look = node.look.emplace();
    const auto readColour = [&](const std::string& field) {
      for (double& part : look.colour) part = readShare(field);
    };
    const auto readOpacity = [&](const std::string& field) { look.opacity = 1 - readShare(field); };
    readFields("Material", {{"diffuseColor", readColour}, {"transparency", readOpacity}});
  }

  void readBox(Node& node, int) {
    Vec3 size{2, 2, 2};
    const auto readSize = [&](const std::string& field) {
      for (double* const side : {&size.x, &size.y, &size.z}) readLength(field, *side);
    };
    readFields("Box", {{"size", readSize}});
    addBox(node.solid.emplace(), size);
  }

  void readSphere(Node& node, int) {
    double radius = 1;
    readFields("Sphere", {{"radius", lengthInto(radius)}});
    addSphere(node.solid.emplace(), radius);
  }

  void readCylinder(Node& node, int) { readFrustum(node, "Cylinder", "radius", true); }
  void readCone(Node& node, int) { readFrustum(node, "Cone", "bottomRadius", false); }
  void readFrustum(Node& node, const std::string& type, const std::string& radiusKey, bool hasTop) {
    double radius = 1, height = 2;
    bool side = true, top = hasTop, bottom = true;
    std::map<std::string, TakeField> fields{
        {radiusKey, lengthInto(radius)}, {"height", lengthInto(height)}, {"side", into(side)}, {"bottom", into(bottom)}};
    if (hasTop) fields["top"] = into(top);
    readFields(type, fields);
    addFrustum(node.solid.emplace(), radius, hasTop ? radius : 0, height, bottom, top, side);
  }

  void readCoordinate(Node& node, int) {
    std::vector<Vec3>& points = node.points.emplace();
    readFields("Coordinate", {{"point", [&](const std::string& field) {
                                 readList([&] {
                                   if (points.size() >= kMostPoints)
                                     words_.fail(field, fmt::format("has more than {} points", kMostPoints), "fewer");
                                   read(field, points.emplace_back());
                                 });
                               }}});
  }

  // A face that turns back at a corner is cut wrongly by a fan: such a face is to be written as several.
  void readFaces(Node& node, int depth) {
    NodePtr points;
    std::vector<int> corners;
    bool counterClockwise = true, convex = true;
    const auto readCorners = [&](const std::string& field) {
      readList([&] {
        if (corners.size() >= 4 * kMostPoints) words_.fail(field, "has too many corners", "fewer");
        corners.push_back(words_.whole(field));
      });
    };
    readFields("IndexedFaceSet", {{"ccw", into(counterClockwise)},
                                  {"convex", into(convex)},
                                  {"coord", nodeInto(points, depth, &Node::points, "Coordinate", "Coordinate")},
                                  {"coordIndex", readCorners}});
    ModelPart& solid = node.solid.emplace();
    if (points) solid.points = *points->points;
    std::vector<std::uint32_t> face;
    if (!corners.empty() && corners.back() >= 0) corners.push_back(-1);
    for (const int corner : corners) {
      if (corner >= 0) {
        if (static_cast<std::size_t>(corner) >= solid.points.size())
          words_.fail("coordIndex", fmt::format("has the corner {}, and there are {} points", corner, solid.points.size()),
                      solid.points.empty() ? "points in coord" : fmt::format("0 to {}", solid.points.size() - 1));
        face.push_back(static_cast<std::uint32_t>(corner));
        continue;
      }
      if (corner != -1)
        words_.fail("coordIndex", fmt::format("has the corner {}", corner), "a point's number from 0, or -1 at a face's end");
      if (face.size() > 4 && !convex)
        words_.fail("convex", "is FALSE for a face of more than four corners", "faces that are cut into triangles");
      for (std::size_t i = 2; i < face.size(); ++i) {
        if (counterClockwise) solid.triangles.push_back({face[0], face[i - 1], face[i]});
        else solid.triangles.push_back({face[0], face[i], face[i - 1]});
      }
      if (solid.triangles.size() > kMostTriangles)
        words_.fail("coordIndex", fmt::format("makes more than {} triangles", kMostTriangles), "fewer");
      face.clear();
    }
  }

  VrmlWords words_;
  std::map<std::string, NodePtr> defined_;
  std::size_t nodes_ = 0;
};

struct Work {
  std::size_t nodes = 0, triangles = 0;
};

// Every place a shape stands at, as a part. USE may mean one shape many times: counted, or a page of it would fill the memory.
void collect(const Node& node, const Transform& frame, const std::string& moving, const std::string& file, Work& work, Model& model) {
  if (++work.nodes > 4 * kMostNodes) throw FaultError(Fault{"USE", "means too much again and again", "a smaller scene", FilePlace{file}});
  const bool named = isMoving(node.name);
  const std::string& name = named ? node.name : moving;
  if (node.geometry && node.geometry->solid && !node.geometry->solid->triangles.empty()) {
    ModelPart part = *node.geometry->solid;
    work.triangles += part.triangles.size();
    if (work.triangles > kMostTriangles)
      throw FaultError(Fault{{}, fmt::format("has more than {} triangles", kMostTriangles), "a smaller scene", FilePlace{file}});
    const Transform own = named ? Transform::Identity() : frame;
    for (Vec3& p : part.points) p = mapped(own, p);
    part.name = name;
    if (node.appearance && node.appearance->look)
      part.colour = node.appearance->look->colour, part.opacity = node.appearance->look->opacity;
    model.parts.push_back(std::move(part));
  }
  const Transform inner = named ? node.unmoved : frame * node.frame;
  for (const NodePtr& child : node.children) collect(*child, inner, name, file, work, model);
}

}  // namespace

Model readVrml(std::string_view text, const std::string& file, const Watch& watch) {
  constexpr std::string_view kHead = "#VRML V2.0 utf8";
  if (text.substr(0, kHead.size()) != kHead)
    throw FaultError(Fault{{}, "does not begin as a VRML 2.0 file", std::string(kHead), FilePlace{file, 1, 1}});
  Model model;
  Work work;
  for (const NodePtr& node : Reader(text, file, watch).readAll()) collect(*node, Transform::Identity(), {}, file, work, model);
  if (model.parts.empty()) throw FaultError(Fault{{}, "has nothing to draw", "a Shape with a geometry", FilePlace{file}});
  check(model, file);
  return model;
}

}  // namespace reachlab::gui::model
