#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>

#include "base/error.h"
#include "base/fault.h"
#include "base/json/json_reader.h"
#include "cli/commands/commands.h"
#include "cli/commands/hand_laws.h"
#include "cli/terminal/standard_streams.h"
#include "constraints/constraint.h"
#include "sim/dynamics/scene.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/tested_ranges.h"

namespace reachlab::cli {
namespace {

struct SimulateRequest {
  std::string experiment, hand, method, out;
  double until = -1, every = 0.01, step = 0.001;
  std::vector<double> at, rate, force, angularRate;
};

/// A row of numbers with 17 significant digits, whatever the locale.
class Table {
 public:
  explicit Table(const std::string& out) {
    if (!out.empty()) {
      file_.open(out, std::ios::binary | std::ios::trunc);
      if (!file_) throw ResourceError(fmt::format("{}: cannot be written: {}; choose another --out", out, std::strerror(errno)));
    }
  }
  void text(std::string_view text) { buffer_ += text; }
  void number(double value) {
    isFinite_ = isFinite_ && std::isfinite(value);
    fmt::format_to(std::back_inserter(buffer_), "{}{:.17g}", buffer_.empty() || buffer_.back() == '\n' ? "" : ",", value);
  }
  void vector(const Vec3& v) { number(v.x), number(v.y), number(v.z); }
  bool isFinite() const { return isFinite_; }  // every number of the row so far
  void endRow() {
    buffer_ += '\n';
    stream() << buffer_;
    buffer_.clear();
  }
  bool nobodyReads() const { return !file_.is_open() && cli::isStandardOutputClosed(); }
  void close() {
    stream().flush();
    if (!stream()) throw ResourceError("the rows could not be written: is the disk full?");
  }

 private:
  std::ostream& stream() { return file_.is_open() ? static_cast<std::ostream&>(file_) : std::cout; }
  std::ofstream file_;
  std::string buffer_;
  bool isFinite_ = true;
};

void writeHeader(Table& table, int masses, int parameters, bool body) {
  table.text("time_s,hand_x_m,hand_y_m,hand_z_m");
  for (int i = 1; i <= masses; ++i) {
    if (parameters == 1) {
      table.text(fmt::format(",mass{0}_q1,mass{0}_q1_per_s", i));
    } else if (parameters == 2) {
      table.text(fmt::format(",mass{0}_q1,mass{0}_q2,mass{0}_q1_per_s,mass{0}_q2_per_s", i));
    }
    for (const char* axis : {"x", "y", "z"}) table.text(fmt::format(",mass{}_{}_m", i, axis));
    for (const char* axis : {"x", "y", "z"}) table.text(fmt::format(",mass{}_v{}_m_per_s", i, axis));
  }
  if (body) table.text(",body_qw,body_qx,body_qy,body_qz,body_wx_rad_per_s,body_wy_rad_per_s,body_wz_rad_per_s");
  table.text(",force_x_n,force_y_n,force_z_n");
  table.endRow();
}

void writeRow(Table& table, const dynamics::Plant& plant, double time, const dynamics::HandSample& hand, bool coupled, int parameters,
              bool body) {
  std::vector<dynamics::MassState> masses(static_cast<std::size_t>(plant.massCount()));
  plant.observe(hand, masses);
  table.number(time);
  table.vector(coupled ? hand.position : Vec3{});
  for (const dynamics::MassState& mass : masses) {
    for (int k = 0; k < parameters; ++k) table.number(mass.q[k]);
    for (int k = 0; k < parameters; ++k) table.number(mass.qRate[k]);
    table.vector(mass.r);
    table.vector(mass.v);
  }
  if (body) {
    const dynamics::BodyState state = plant.body();
    for (const double part : state.orientation) table.number(part);
    table.vector(state.angularVelocity);
  }
  table.vector(coupled ? plant.couplingForce(hand) : Vec3{});
  if (!table.isFinite())
    throw RefusedError(
        fmt::format("at {:.9g} s a position, velocity or force is beyond the numbers of a computer; use smaller values", time));
  table.endRow();
}

/// A time at which a step must end: a row's, the end, or one at which the hand's law is not smooth.
struct Stop {
  double time = 0;  // [s]
  bool isRow = false;
};

constexpr double kMostRows = 1e7, kMaxSteps = 1e10;

std::vector<Stop> makeSchedule(const SimulateRequest& request, double until, const std::vector<double>& breaks) {
  std::vector<Stop> all;
  const double nearly = 1e-9 * std::min(request.every, request.step);
  for (std::size_t k = 1;; ++k) {
    const double t = static_cast<double>(k) * request.every;
    if (!(t < until - nearly)) break;
    all.push_back({t, true});
  }
  if (until > 0) all.push_back({until, true});
  for (const double t : breaks)
    if (t > nearly && t < until - nearly) all.push_back({t, false});
  std::sort(all.begin(), all.end(), [](const Stop& a, const Stop& b) { return a.time < b.time; });
  std::vector<Stop> stops;
  for (const Stop& stop : all) {
    if (stops.empty() || stop.time - stops.back().time >= nearly) stops.push_back(stop);
    else if (stop.isRow) stops.back() = stop;  // the row's own time stands
  }
  return stops;
}

// Nobody waits for a tick here: a step that would cost more than a tick may is taken in halves. `last` becomes the time reached.
constexpr int kMostHalvings = 12;
dynamics::StepStatus stepInHalves(dynamics::Plant& plant, const HandLaw& law, double t, double dt, int halvings, double& last) {
  dynamics::StepStatus status = plant.step(law.segment(t, dt), dt);
  // Capped, or before a place without continuation: it comes as near as 2^-12 of the step.
  if ((status == dynamics::StepStatus::Capped || status == dynamics::StepStatus::NoContinuation) && halvings > 0) {
    status = stepInHalves(plant, law, t, dt / 2, halvings - 1, last);
    return status == dynamics::StepStatus::Ok ? stepInHalves(plant, law, t + dt / 2, dt / 2, halvings - 1, last) : status;
  }
  last = t + (status == dynamics::StepStatus::Ok ? dt : plant.lastStepFraction() * dt);
  return status;
}

/// The end of the simulation [s].
double checkedEnd(const SimulateRequest& request, const experiment::Experiment& experiment) {
  const auto positive = [](double value, const char* option) {
    if (!(value > 0) || !std::isfinite(value))
      throw FaultError(Fault{option, fmt::format("is {} s", value), "a positive number of seconds"});
  };
  positive(request.every, "--every");
  positive(request.step, "--step");
  if (request.until < 0 && !experiment.task)
    throw FaultError(Fault{"--until", "is missing, and the experiment has no task.duration_s", "seconds"});
  const double until = request.until >= 0 ? request.until : experiment.task->duration;
  if (!std::isfinite(until)) throw FaultError(Fault{"--until", "is not finite", "seconds"});
  if (until / request.every > kMostRows || until / request.step > kMaxSteps)
    throw FaultError(Fault{"--until", fmt::format("{} s are too many rows or steps", until),
                           fmt::format("up to {:.0e} rows of --every and {:.0e} steps of --step", kMostRows, kMaxSteps)});
  return until;
}

void checkVectors(const SimulateRequest& request, const std::vector<double>& at, const std::vector<double>& rate, std::size_t coordinates,
                  bool body) {
  const auto requireCount = [](const char* option, const std::vector<double>& values, std::size_t count, const std::string& allowed) {
    if (values.size() != count) throw FaultError(Fault{option, fmt::format("has {} numbers", values.size()), allowed});
  };
  const std::string here = fmt::format("{} here, separated by commas", coordinates);
  requireCount("--at", at, coordinates, here);
  requireCount("--rate", rate, coordinates, here);
  std::vector<Fault> faults;
  for (const auto& [option, values] :
       {std::pair{"--at", &request.at}, {"--rate", &request.rate}, {"--force", &request.force}, {"--angular-rate", &request.angularRate}})
    checkNumbers(option, *values, -1, experiment::componentRange(), faults);
  if (!faults.empty()) throw FaultError(std::move(faults));
  if (!request.force.empty()) requireCount("--force", request.force, 3, "three, X,Y,Z in N");
  if (request.angularRate.empty()) return;
  if (!body) throw FaultError(Fault{"--angular-rate", "the object does not turn", "for object.kind body only"});
  requireCount("--angular-rate", request.angularRate, 3, "three, X,Y,Z in rad/s");
}

struct Simulation {
  dynamics::Scene& scene;
  const HandLaw& law;
  double step;  // [s]
  bool coupled;
  int parameters;
  bool body;
};

/// Steps from row to row and writes them, until the end or a constraint's end.
void writeRows(const SimulateRequest& request, double until, const Simulation& s) {
  dynamics::Plant& plant = *s.scene.plant;
  Table table(request.out);
  writeHeader(table, plant.massCount(), s.parameters, s.body);
  const auto row = [&](double t) { writeRow(table, plant, t, s.law.function(t), s.coupled, s.parameters, s.body); };
  row(0);
  double now = 0;
  for (const auto [stop, isRow] : makeSchedule(request, until, s.law.breaks)) {
    if (table.nobodyReads()) return;
    const double steps = std::max(1.0, std::ceil((stop - now) / s.step * (1 - 1e-9)));
    double dt = (stop - now) / steps;
    if (std::abs(dt - s.step) < 1e-9 * s.step) dt = s.step;  // the compiled step, not its rounding
    const double begin = now;
    for (double k = 0; k < steps; ++k) {
      const double t = begin + (stop - begin) * (k / steps);
      double last = t;
      const dynamics::StepStatus status = stepInHalves(plant, s.law, t, dt, kMostHalvings, last);
      if (status == dynamics::StepStatus::Ok) continue;
      const std::string reason = plant.stopReason();
      if (status == dynamics::StepStatus::AtEnd || status == dynamics::StepStatus::NoContinuation) {
        if (last > now) row(last);
        table.close();
        std::cerr << fmt::format("stopped at {:.9g} s: {}\n", last, reason.empty() ? std::string(dynamics::describe(status)) : reason);
        return;
      }
      table.close();
      throw RefusedError(fmt::format("at {:.9g} s the step failed ({}{}{}); try a smaller --step, or --method adaptive", t,
                                     describe(status), reason.empty() ? "" : ": ", reason));
    }
    now = stop;
    if (isRow) row(stop);
  }
  table.close();
}

void simulate(const SimulateRequest& request) {
  const experiment::CompiledExperiment compiled = experiment::openExperiment(request.experiment);
  if (compiled.experiment().hands.size() > 1)
    throw FaultError(Fault{"hands", fmt::format("are {}, and simulate moves one", compiled.experiment().hands.size()),
                           fmt::format("one hand; or record it: reach run {} --device A --device B", request.experiment)});
  experiment::Experiment experiment = compiled.experiment();
  const double until = checkedEnd(request, experiment);
  if (!request.method.empty()) experiment.method = request.method;

  const constraints::Constraint& constraint = compiled.constraint();
  const int parameters = constraint.kind == constraints::ConstraintKind::Free ? 0 : constraint.parameterCount();
  const std::size_t coordinates = parameters == 0 ? 3 : static_cast<std::size_t>(parameters);
  if (!experiment.task && request.at.empty())
    throw FaultError(atTheirPlaces({{"task", "is missing, and a simulation needs its start", "{ start, target, … }, or --at"}},
                                   experiment.text, request.experiment));
  if (experiment.object.kind == experiment::ObjectKind::None)
    throw FaultError(atTheirPlaces({{"object.kind", "is none, so there is nothing to simulate", "an object with masses"}}, experiment.text,
                                   request.experiment));
  const HandLaw law = makeHandLaw(request.hand, experiment, constraint);
  const std::vector<double> at = request.at.empty() ? experiment.task->start : request.at;
  std::vector<double> rate = request.rate;
  if (rate.empty()) rate.assign(coordinates, 0.0);
  const bool body = experiment.object.kind == experiment::ObjectKind::Body;
  checkVectors(request, at, rate, coordinates, body);
  if (!experiment.task) experiment.task = experiment::Task{};
  experiment.task->start = at;
  if (experiment.task->target.empty()) experiment.task->target = at;

  // The longest equal step that divides a row and is no longer than asked.
  const double within = std::min(request.every, until > 0 ? until : request.every);
  const double step = within / std::max(1.0, std::ceil(within / request.step * (1 - 1e-12)));
  dynamics::Scene scene = dynamics::compileScene(experiment, constraint, {request.method, step, 0});
  dynamics::Plant& plant = *scene.plant;
  const bool coupled = request.hand != "none";
  if (!request.force.empty()) plant.setExtraForce({request.force[0], request.force[1], request.force[2]});
  plant.setCoupled(coupled);
  plant.place(at, rate);
  if (!request.angularRate.empty()) plant.setAngularVelocity({request.angularRate[0], request.angularRate[1], request.angularRate[2]});
  for (const std::string& warning : scene.choice.warnings) std::cerr << "warning: " << warning << '\n';
  writeRows(request, until, {scene, law, step, coupled, parameters, body});
}

}  // namespace

void addSimulateCommand(CLI::App& app, int&) {
  CLI::App* command =
      app.add_subcommand("simulate", "Moves the object with a hand that is a function of time, and writes its states as CSV");
  const auto request = std::make_shared<SimulateRequest>();
  command->add_option("experiment", request->experiment, "Experiment file, or the name of a shipped one")->required();
  command
      ->add_option("--hand", request->hand,
                   "none (no coupling), hold (at the start), min-jerk (along the chord), min-jerk-along (along the curve), or a "
                   "CSV file with time_s,x_m,y_m,z_m in world coordinates [s, m]")
      ->required();
  command->add_option("--until", request->until, "End of the simulation [s] [default: the task's duration_s]")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--every", request->every, "Time between rows [s] [default: 0.01]");
  command->add_option("--method", request->method, "auto, rk4, exact, abm, adaptive, stiff [default: the experiment's]")
      ->check(CLI::IsMember({"auto", "rk4", "exact", "abm", "adaptive", "stiff"}));
  command->add_option("--step", request->step, "Longest step of the method [s] [default: 0.001]");
  command->add_option("--at", request->at, "Initial parameters of all masses: phi, or u,v; metres when free [default: the start]")
      ->delimiter(',');
  command->add_option("--rate", request->rate, "Initial rates of these parameters [1/s, free: m/s] [default: 0]")->delimiter(',');
  command->add_option("--angular-rate", request->angularRate, "A body's initial angular velocity, world axes, X,Y,Z [rad/s] [default: 0]")
      ->delimiter(',');
  command->add_option("--force", request->force, "Constant extra force on mass 1, X,Y,Z [N]")->delimiter(',');
  command->add_option("--out", request->out, "File for the rows [default: standard output]");
  command->footer(
      "A CSV file of --hand is interpolated by a cubic spline with two continuous derivatives and not-a-knot ends; v_HIP is its derivative. "
      "At the first and the last sample's time v_HIP is the spline's inner velocity there; before the first and after the last the hand "
      "rests where it is, so that its velocity jumps unless the samples begin and end at rest.\n\n"
      "Units are in the column names; massI_q1 is the constraint's parameter. A stop at a constraint's end writes the last row there.\n"
      "A body starts unturned with its centre of mass at the start (or --at); its FP is at fp_offset_m from there. Its columns body_qw … "
      "are\n"
      "the unit quaternion from body to world axes, body_wx_rad_per_s … its angular velocity in world axes.\n\n"
      "Example:\n  reach simulate chain-moderate --hand min-jerk --until 2 --every 0.01 --out chain.csv");
  command->callback([request] { simulate(*request); });
}

}  // namespace reachlab::cli
