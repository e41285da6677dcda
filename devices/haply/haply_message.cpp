#include "devices/haply/haply_message.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace reachlab::devices {
namespace {

using Json = nlohmann::json;

Json parsed(std::string_view message) { return Json::parse(message, nullptr, false); }

// The member of that name, when the value is an object that has it.
const Json* find(const Json* value, const char* name) {
  if (value == nullptr || !value->is_object()) return nullptr;
  const auto at = value->find(name);
  return at == value->end() ? nullptr : &*at;
}

// Absent: 0. nullopt: no finite number.
std::optional<double> numberOf(const Json* value, const char* name) {
  const Json* number = find(value, name);
  if (number == nullptr) return 0;
  if (!number->is_number()) return std::nullopt;
  const double x = number->get<double>();
  return std::isfinite(x) ? std::optional(x) : std::nullopt;
}

std::optional<Vec3> vectorOf(const Json* value) {
  if (value == nullptr || !value->is_object()) return std::nullopt;
  const auto x = numberOf(value, "x"), y = numberOf(value, "y"), z = numberOf(value, "z");
  if (!x || !y || !z) return std::nullopt;
  return Vec3{*x, *y, *z};
}

std::string idOf(const Json& device) {
  const Json* id = find(&device, "device_id");
  return id != nullptr && id->is_string() ? id->get<std::string>() : std::string();
}

const Json* deviceIn(const Json& list, const std::string& id) {
  for (const Json& device : list)
    if (!idOf(device).empty() && (id.empty() || idOf(device) == id)) return &device;
  return nullptr;
}

// What equals its identity may be left out, the place at the origin as well: then nothing else is in it but what we know.
bool isKnownState(const Json* state) {
  if (state == nullptr || !state->is_object() || state->empty()) return false;
  constexpr std::string_view known[] = {
      "cursor_velocity", "current_cursor_force", "current_cursor_position", "body_orientation", "control_mode",
      "control_domain",  "angular_position",     "angular_velocity",        "transform",        "mode"};
  return std::all_of(state->items().begin(), state->items().end(),
                     [&](const auto& item) { return std::find(std::begin(known), std::end(known), item.key()) != std::end(known); });
}

// Wireless grips, and those on a cable.
std::vector<const Json*> gripsIn(const Json& message) {
  std::vector<const Json*> grips;
  for (const char* kind : {"wireless_verse_grip", "verse_grip"})
    if (const Json* list = find(&message, kind); list != nullptr && list->is_array())
      for (const Json& grip : *list)
        if (grip.is_object()) grips.push_back(&grip);
  return grips;
}

void readGrip(const Json& message, const std::string& asked, HaplyState& state) {
  std::vector<const Json*> grips = gripsIn(message);
  if (!asked.empty()) std::erase_if(grips, [&](const Json* grip) { return idOf(*grip) != asked; });
  if (grips.size() != 1) return;
  const Json* buttons = find(find(grips.front(), "state"), "buttons");
  int bit = 0;
  for (const char* name : {"a", "b", "c"}) {
    const Json* button = find(buttons, name);
    if (button != nullptr && button->is_boolean() && button->get<bool>()) state.buttons |= 1u << bit;
    ++bit;
  }
}

}  // namespace

HaplyAnswer readHaplyMessage(std::string_view text, const std::string& id, HaplyState& state, const std::string& grip) {
  const Json message = parsed(text);
  if (!message.is_object()) return HaplyAnswer::NotJson;
  const Json* list = find(&message, "inverse3");
  if (list == nullptr) return message.empty() ? HaplyAnswer::NoDevice : HaplyAnswer::OtherVersion;
  if (!list->is_array()) return HaplyAnswer::OtherVersion;
  const Json* device = deviceIn(*list, id);
  if (device == nullptr) {
    const bool named = list->empty() || !idOf(list->front()).empty();
    return named ? HaplyAnswer::NoDevice : HaplyAnswer::OtherVersion;
  }
  const Json *told = find(device, "state"), *place = find(told, "cursor_position");
  if (place == nullptr && !isKnownState(told)) return HaplyAnswer::OtherVersion;
  const auto position = place == nullptr ? std::optional(Vec3{}) : vectorOf(place);
  if (!position) return HaplyAnswer::NotJson;
  state = {};
  state.id = idOf(*device);
  state.position = *position;
  state.velocity = vectorOf(find(told, "cursor_velocity"));
  readGrip(message, grip, state);
  return HaplyAnswer::State;
}

HaplyService readHaplyService(std::string_view text, const std::string& id) {
  const Json message = parsed(text);
  HaplyService service;
  for (const Json* grip : gripsIn(message)) service.grips.push_back(idOf(*grip));
  const Json* list = find(&message, "inverse3");
  if (list == nullptr || !list->is_array()) return service;
  for (const Json& device : *list)
    if (!idOf(device).empty()) service.devices.push_back(idOf(device));
  const Json* device = deviceIn(*list, id);
  const Json* config = find(device, "config");
  for (const char* name : {"gravity_compensation", "filters"})
    if (const Json* value = find(config, name))
      service.settings += (service.settings.empty() ? "" : ", ") + std::string(name) + " " + value->dump();
  return service;
}

std::string haplyForceCommand(const std::string& id, const Vec3& force) {
  const Vec3 f = isFinite(force) ? force : Vec3{};
  const Json command = {
      {"inverse3",
       Json::array({{{"device_id", id}, {"commands", {{"set_cursor_force", {{"values", {{"x", f.x}, {"y", f.y}, {"z", f.z}}}}}}}}})}};
  return command.dump();
}

std::string haplyGreeting() { return R"({"session":{"configure":{"profile":{"name":"reachlab"}}}})"; }

}  // namespace reachlab::devices
