#include <cmath>
#include <nlohmann/json.hpp>

#include "base/as_number.h"
#include "constraints/catalogue/definition.h"

namespace reachlab::constraints {
namespace {

using Json = nlohmann::ordered_json;

// Numbers stay numbers, expressions strings, no end null.
Json endJson(const std::string& text) {
  if (text.empty()) return nullptr;
  if (const auto value = asNumber<double>(text)) return *value;
  return text;
}

Json rangeJson(const DomainText& domain) {
  if (domain.lo.empty() && domain.hi.empty()) return nullptr;
  return Json::array({endJson(domain.lo), endJson(domain.hi)});
}

const char* nameOf(AtEnd atEnd) { return atEnd == AtEnd::Bounce ? "bounce" : "stop"; }

}  // namespace

std::string toJson(const Definition& d) {
  const bool curve = d.kind == ConstraintKind::Curve;
  Json j = Json::object();
  j["schema_version"] = 1;
  j["name"] = d.name;
  j["kind"] = curve ? "curve" : "surface";
  j[curve ? "curve" : "surface"] = d.coordinates;
  j["shape"] = Json::object();
  for (const ShapeParameter& p : d.shape) {
    j["shape"][p.name] = {{"default", p.defaultValue}, {"min", p.min}, {"max", p.max}, {"unit", p.unit}, {"meaning", p.meaning}};
    if (p.whole) j["shape"][p.name]["whole"] = true;
  }
  if (curve) {
    j["domain"] = rangeJson(d.domain[0]);
    j["periodic"] = d.domain[0].periodic;
    j["at_end"] = nameOf(d.domain[0].atEnd);
  } else {
    j["domain"] = {rangeJson(d.domain[0]), rangeJson(d.domain[1])};
    j["periodic"] = {d.domain[0].periodic, d.domain[1].periodic};
    j["at_end"] = {nameOf(d.domain[0].atEnd), nameOf(d.domain[1].atEnd)};
  }
  j["start"] = d.start;
  j["target"] = d.target;
  j["sentence"] = d.sentence;
  j["source"] = d.source;
  return j.dump(2) + "\n";
}

}  // namespace reachlab::constraints
