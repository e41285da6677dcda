#pragma once

// For headers that only pass an experiment on: they do not change with it.
namespace reachlab::experiment {
struct Experiment;
struct Arm;
struct Task;
struct SubjectScreen;
class CompiledExperiment;
}  // namespace reachlab::experiment
