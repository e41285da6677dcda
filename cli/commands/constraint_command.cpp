#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <ranges>

#include "base/as_number.h"
#include "base/fault.h"
#include "base/json/json_tree.h"
#include "base/text_file.h"
#include "cli/commands/commands.h"
#include "cli/commands/definition_files.h"
#include "cli/terminal/option_words.h"
#include "constraints/catalogue/definition.h"
#include "constraints/formula/cpp_writer.h"
#include "constraints/geometry/arc_length.h"
#include "constraints/regularity/analysis.h"
#include "constraints/regularity/places.h"
#include "constraints/regularity/surface_branches.h"

namespace reachlab::cli {
namespace {

std::string jsonNumber(double value) { return std::isfinite(value) ? fmt::format("{:.17g}", value) : std::string("null"); }
std::string triple(const Vec3& r) { return fmt::format("[{}, {}, {}]", jsonNumber(r.x), jsonNumber(r.y), jsonNumber(r.z)); }
std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }
std::string list(const std::vector<double>& values) {
  return fmt::format("[{}]", fmt::join(values | std::views::transform(jsonNumber), ", "));
}
// For a person; machines ask for --json.
std::string shortList(const std::vector<double>& values) { return fmt::format("[{:.6g}]", fmt::join(values, ", ")); }
bool isCurve(const constraints::Definition& d) { return d.kind == constraints::ConstraintKind::Curve; }
const char* kindOf(const constraints::Definition& d) { return isCurve(d) ? "curve" : "surface"; }

double parseNumber(const std::string& text, const std::string& option) {
  const auto value = asNumber<double>(text);
  if (!value || !std::isfinite(*value))
    throw FaultError(Fault{option, fmt::format("'{}' is no number", text), "a finite number such as 0.3"});
  return *value;
}

std::vector<double> parseNumbers(const std::string& text, const std::string& option) {
  std::vector<double> values;
  for (const std::string& part : partsBetweenCommas(text)) values.push_back(parseNumber(part, option));
  return values;
}

std::map<std::string, double> parseShape(const std::vector<std::string>& settings) {
  std::map<std::string, double> shape;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos)
      throw FaultError(Fault{"--set", fmt::format("'{}' sets nothing", setting), "KEY=VALUE, such as radius_m=0.12"});
    shape[setting.substr(0, equals)] = parseNumber(setting.substr(equals + 1), "--set " + setting.substr(0, equals));
  }
  return shape;
}

// A name of the catalogue or of the user's folder, else a file.
constraints::Definition definitionOf(const std::string& nameOrFile) {
  if (constraints::findInCatalogue(nameOrFile) != nullptr) return constraints::findDefinition(nameOrFile, "constraint");
  if (nameOrFile.find_first_of("/.") != std::string::npos) return constraints::readDefinition(nameOrFile);
  if (nameOrFile == "free") throw FaultError(Fault{"constraint", "free binds nothing: it has no formula", "a curve or surface"});
  if (isFile(nameOrFile)) return constraints::readDefinition(nameOrFile);
  return constraints::findDefinition(nameOrFile, "constraint");
}

struct ConstraintOptions {
  std::string what, at;
  std::vector<std::string> files, set;
  bool json = false;
};

void printList(const ConstraintOptions& o) {
  auto print = [&, before = "[\n  "](const std::string& name, const char* kind, const std::string& sentence) mutable {
    if (o.json) fmt::print("{}{{\"name\": {}, \"kind\": \"{}\", \"sentence\": {}}}", before, quoted(name), kind, quoted(sentence));
    else fmt::print("{:<22} {:<8} {}\n", name, kind, sentence);
    before = ",\n  ";
  };
  print("free", "free", "Nothing binds the object.");
  for (const constraints::Definition& d : constraints::catalogue()) print(d.name, kindOf(d), d.sentence);
  for (const constraints::Definition& d : ownDefinitions()) print(d.name, kindOf(d), d.sentence);
  if (o.json) fmt::print("\n]\n");
}

// One value for a curve, two in brackets for a surface.
template <typename F>
std::string perParameter(const constraints::Definition& d, F&& f) {
  return isCurve(d) ? f(0) : "[" + f(0) + ", " + f(1) + "]";
}

void showJson(const constraints::Definition& d, const constraints::Constraint& c) {
  std::string shape;
  for (const constraints::ShapeParameter& p : d.shape)
    shape += fmt::format("{}    {}: {{\"default\": {}, \"min\": {}, \"max\": {}, \"unit\": {}, \"meaning\": {}{}}}",
                         shape.empty() ? "\n" : ",\n", quoted(p.name), jsonNumber(p.defaultValue), jsonNumber(p.min), jsonNumber(p.max),
                         quoted(p.unit), quoted(p.meaning), p.whole ? ", \"whole\": true" : "");
  const auto domain = [&](std::size_t k) { return fmt::format("[{}, {}]", jsonNumber(c.domain[k].lo), jsonNumber(c.domain[k].hi)); };
  const auto periodic = [&](std::size_t k) { return std::string(c.domain[k].periodic ? "true" : "false"); };
  const auto atEnd = [&](std::size_t k) {
    return std::string(c.domain[k].atEnd == constraints::AtEnd::Bounce ? "\"bounce\"" : "\"stop\"");
  };
  fmt::print(
      "{{\n  \"name\": {},\n  \"kind\": \"{}\",\n  \"{}\": [{}],\n  \"shape\": {{{}{}}},\n  \"domain\": {},\n  \"periodic\": {},\n"
      "  \"at_end\": {},\n  \"start\": {},\n  \"target\": {},\n  \"sentence\": {},\n  \"source\": {}\n}}\n",
      quoted(d.name), kindOf(d), kindOf(d), fmt::join(d.coordinates | std::views::transform(quoted), ", "), shape,
      shape.empty() ? "" : "\n  ", perParameter(d, domain), perParameter(d, periodic), perParameter(d, atEnd), list(d.start),
      list(d.target), quoted(d.sentence), quoted(d.source));
}

void showPlaces(const constraints::Constraint& c) {
  const std::array<constraints::Domain, 2> range = constraints::boundedDomain(c);
  if (c.kind == constraints::ConstraintKind::Curve) {
    fmt::print("length    {:.6g} m from phi = {:.6g} to {:.6g}\n", constraints::ArcLength(c, range[0].lo, range[0].hi).length(),
               range[0].lo, range[0].hi);
    const constraints::SlowPlace slow = constraints::findMinSpeed(c, range[0].lo, range[0].hi);
    fmt::print("|r_phi|   at least {:.3g} m, at phi = {:.6g}\n", slow.speed, slow.phi);
    const constraints::CurveRegularity regularity = constraints::computeRegularity(c, 0.5 * (range[0].lo + range[0].hi));
    std::size_t told = 0;
    for (const constraints::Place& place : regularity.places) {
      if (std::isinf(place.at)) {
        fmt::print("end       as phi grows to {}infinity: the curve has a finite length there\n", place.at < 0 ? "minus " : "");
        ++told;
        continue;
      }
      if (place.at < range[0].lo || place.at > range[0].hi || (range[0].periodic && place.at >= range[0].hi - 1e-9)) continue;
      fmt::print("{:<9} phi = {:.9g}: {}; {}\n", nameOf(place.kind), place.at, place.because,
                 constraints::isPassed(place.kind) ? "passed" : "never crossed");
      ++told;
    }
    if (told == 0) fmt::print("smooth    no kink, jump, pole, end or cusp between phi = {:.6g} and {:.6g}\n", range[0].lo, range[0].hi);
  } else {
    const auto branches = constraints::computeBranches(c);
    for (const constraints::Place& place : branches->places)
      fmt::print("{:<9} {}\n", nameOf(place.kind),
                 place.parameter < 0 ? "along " + place.because + " = 0"
                                     : fmt::format("{} = {:.9g}: {}", place.parameter == 0 ? "u" : "v", place.at, place.because));
    const std::vector<constraints::DegeneratePlace> places = constraints::findDegeneratePlaces(c);
    for (const constraints::DegeneratePlace& p : places)
      fmt::print("{:<9} {}\n", constraints::nameOf(p.kind),
                 p.fixed < 0 ? fmt::format("u = {:.9g}, v = {:.9g}", p.u, p.v)
                             : fmt::format("{} = {:.9g}", p.fixed == 0 ? "u" : "v", p.fixed == 0 ? p.u : p.v));
    if (places.empty() && branches->smooth())
      fmt::print("regular   no degenerate position for u in [{:.6g}, {:.6g}], v in [{:.6g}, {:.6g}]{}\n", range[0].lo, range[0].hi,
                 range[1].lo, range[1].hi, constraints::isProvedRegular(c, range) ? ", shown by interval arithmetic" : "");
    if (places.size() >= constraints::kMaxDegeneratePlaces)
      fmt::print("…         isolated points are listed only up to {} places in all: there may be more of them\n",
                 constraints::kMaxDegeneratePlaces);
  }
}

void show(const ConstraintOptions& o) {
  const constraints::Definition d = definitionOf(o.what);
  const constraints::Constraint c = constraints::makeConstraint(d, parseShape(o.set));
  if (o.json) return showJson(d, c);
  fmt::print("{}: {}\n", d.name, d.sentence);
  const char* axes[] = {"x", "y", "z"};
  for (std::size_t k = 0; k < 3; ++k) fmt::print("{}         {}\n", axes[k], d.coordinates[k]);
  for (const constraints::ShapeParameter& p : d.shape)
    fmt::print("shape     {} = {:.6g}{}  ({:.6g} to {:.6g}): {}\n", p.name, p.defaultValue, p.unit == "1" ? "" : " " + p.unit, p.min, p.max,
               p.meaning);
  const std::vector<std::string> variables = constraints::variablesOf(d.kind);
  for (std::size_t k = 0; k < variables.size(); ++k)
    fmt::print("{:<9} {:.6g} to {:.6g}{}\n", variables[k], c.domain[k].lo, c.domain[k].hi,
               c.domain[k].periodic                              ? ", periodic"
               : std::isinf(c.domain[k].lo)                      ? ""
               : c.domain[k].atEnd == constraints::AtEnd::Bounce ? ", elastic ends"
                                                                 : ", stops at its ends");
  fmt::print("reach     from {} to {}\n", shortList(d.start), shortList(d.target));
  showPlaces(c);
  fmt::print("source    {}\n", d.source);
}

void eval(const ConstraintOptions& o) {
  const constraints::Definition d = definitionOf(o.what);
  const constraints::Constraint c = constraints::makeConstraint(d, parseShape(o.set));
  const std::vector<double> q = parseNumbers(o.at, "--at");
  if (static_cast<int>(q.size()) != c.parameterCount())
    throw FaultError(Fault{"--at", fmt::format("has {} numbers", q.size()), isCurve(d) ? "one, phi" : "two, u,v"});
  std::vector<std::pair<const char*, Vec3>> rows;
  if (isCurve(d)) {
    const constraints::CurvePoint p = constraints::evaluate(c.curve, q[0]);
    rows = {{"r_m", p.r}, {"r_phi", p.rPhi}, {"r_phiphi", p.rPhiPhi}};
  } else {
    const constraints::SurfacePoint p = constraints::evaluate(c.surface, q[0], q[1]);
    rows = {{"r_m", p.r}, {"r_u", p.rU}, {"r_v", p.rV}, {"r_uu", p.rUu}, {"r_uv", p.rUv}, {"r_vv", p.rVv}};
  }
  for (const auto& [name, value] : rows)
    if (!isFinite(value)) throw RefusedError(fmt::format("{}: {} is not finite at {}", d.name, name, o.at));
  if (o.json) fmt::print("{{\"at\": {}", list(q));
  for (const auto& [name, value] : rows) {
    if (o.json) fmt::print(", \"{}\": {}", name, triple(value));
    else fmt::print("{:<9} {} {} {}\n", name, jsonNumber(value.x), jsonNumber(value.y), jsonNumber(value.z));
  }
  if (o.json) fmt::print("}}\n");
}

void check(const ConstraintOptions& o) {
  std::vector<Fault> faults;
  for (const std::string& file : o.files) {
    try {
      const std::string text = readTextFile(file);
      if (parseJson(text, file).find("object") != nullptr)
        throw FaultError(fileFault(file, "is an experiment file, no constraint definition; `reach validate` checks it"));
      const constraints::Definition d = constraints::parseDefinition(text, file);
      const constraints::Constraint c = makeAtAllShapes(d, text, file);
      fmt::print("{}: fine: {} {}\n", file, kindOf(d), d.name);
      showPlaces(c);
    } catch (const FaultError& error) {
      faults.insert(faults.end(), error.faults.begin(), error.faults.end());
    }
  }
  if (!faults.empty()) throw FaultError(std::move(faults));
}

void code(const ConstraintOptions& o) {
  const constraints::Definition d = definitionOf(o.what);
  std::vector<double> defaults;
  for (const constraints::ShapeParameter& p : d.shape) defaults.push_back(p.defaultValue);
  fmt::print("{}", constraints::writeDynamicsCode(*constraints::compileFormula(constraints::formulaOf(d), o.what), d.name, defaults));
}

}  // namespace

void addConstraintCommand(CLI::App& app, int&) {
  CLI::App* command =
      app.add_subcommand("constraint", "Curves and surfaces that a mass may move on: list, show, evaluate, check, print as C++");
  command->require_subcommand(1);
  command->footer(
      "Examples:\n  reach constraint list\n  reach constraint eval torus --at 0.3,1.2 --set minor_m=0.05 --json\n  reach constraint check "
      "my-curve.json");
  const auto options = std::make_shared<ConstraintOptions>();
  const auto add = [&](const char* name, const char* description, const char* example, void (*run)(const ConstraintOptions&)) {
    CLI::App* sub = command->add_subcommand(name, description);
    sub->footer(std::string("Example:\n  reach constraint ") + example);
    sub->callback([options, run] { run(*options); });
    return sub;
  };
  const auto addName = [&](CLI::App* sub) {
    sub->add_option("name", options->what, "name of the catalogue, or a definition file")->required();
  };
  const auto addSet = [&](CLI::App* sub) {
    sub->add_option("--set", options->set, "shape values KEY=VALUE, SI units (radius_m=0.12)")->take_all();
  };
  const auto addJson = [&](CLI::App* sub) { sub->add_flag("--json", options->json, "as JSON, numbers with 17 significant digits"); };

  addJson(add("list", "Names, kinds and a sentence each", "list --json", printList));
  CLI::App* showing = add("show", "Formula, shape, domain and where it is degenerate", "show cardioid", show);
  addName(showing), addSet(showing), addJson(showing);
  CLI::App* evaluating =
      add("eval", "Position [m] and derivatives by the parameters [m]", "eval ellipse --at 0.5 --set a_m=0.12 b_m=0.05 --json", eval);
  addName(evaluating), addSet(evaluating), addJson(evaluating);
  evaluating->add_option("--at", options->at, "parameter phi, or u,v (no unit)")->required();
  CLI::App* checking = add("check", "Every error of definition files, with its position", "check my-curve.json", check);
  checking->add_option("files", options->files, "definition files")->required();
  addName(add("code", "C++ of the coordinates and of M, L, V, Q (curve) or G, C, Q (surface)", "code epitrochoid", code));
}

}  // namespace reachlab::cli
