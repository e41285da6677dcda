#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <thread>

#include "analysis/study/points.h"
#include "analysis/study/report.h"
#include "analysis/study/run_study.h"
#include "analysis/tables.h"
#include "base/fault.h"
#include "base/names.h"
#include "cli/commands/commands.h"
#include "cli/output/progress_line.h"
#include "cli/output/study_words.h"
#include "cli/terminal/at_option.h"
#include "sim/experiment/experiment.h"
#include "sim/record/log/atomic_file.h"
#include "sim/subjects/subject_parameters.h"

namespace reachlab::cli {
namespace {

struct StudyRequest {
  std::string study, out, shard;
  int jobs = 0;
  bool resume = false;
};

std::string outOf(const std::string& out, const std::string& study) { return out.empty() ? nameOfFile(study) + "-study" : out; }

void runStudy(const StudyRequest& request) {
  if (request.study.empty()) throw FaultError(Fault{"study", "is missing", "a study file, or one of status, report, point and sbatch"});
  const study::Design design = study::readDesign(request.study);
  const study::Shard shard = shardOf(request.shard);
  study::checkPoints(design);
  const std::string out = outOf(request.out, request.study);
  atOption("--out", [&] {
    const study::StudyFolder folder = study::makeFolder(design, out);
    const study::ChunksToDo todo = study::chunksToDo(folder, shard);
    if (todo.there > 0 && !request.resume && !study::areTablesThere(folder))
      throw FaultError(Fault{"--out",
                             fmt::format("{}: {} of {} chunks of this share are there already", out, todo.there,
                                         todo.there + static_cast<std::int64_t>(todo.missing.size())),
                             "another folder, or --resume, which continues with the other chunks"});
    const unsigned jobs = request.jobs > 0 ? static_cast<unsigned>(request.jobs) : std::max(1u, std::thread::hardware_concurrency());
    fmt::print(stderr, "{}: {} points, {} subjects each, {} chunks{}; {} thread{}\n", design.name, study::pointCount(design),
               design.subjects, folder.chunks.count(), shard.of > 1 ? fmt::format(", share {} of {}", shard.index, shard.of) : "", jobs,
               jobs == 1 ? "" : "s");
    ProgressLine line;
    study::computeShard(folder, jobs, shard, [&](const study::StudyProgress& progress) { line.tell(describeProgress(progress)); });
    line.end();
    if (study::mergeTables(folder)) fmt::print("{0}/trials.csv.gz {0}/trials.h5 {0}/trials.json\n", out);
    else fmt::print(stderr, "this share is done; the run that finds all chunks there writes the tables\n");
  });
}

void tellStatus(const std::string& folder) {
  const study::StudyStatus s = study::statusOf(study::openFolder(folder));
  const auto known = [&](double value) { return s.rate > 0 || s.tables ? fmt::format("{:.0f}", value) : ""; };
  fmt::print("chunks={} of={} trials={} of={} rate_per_s={} left_s={} tables={}\n", s.chunksDone, s.chunks, s.trialsDone, s.trials,
             known(s.rate), known(s.secondsLeft), s.tables ? "yes" : "no");
}

struct PointRequest {
  std::string folder, out;
  std::int64_t point = 0, subject = 1;
};

void tellPoint(const PointRequest& request) {
  const study::Design& design = study::openFolder(request.folder).design;
  const std::int64_t points = study::pointCount(design);
  if (request.point < 0 || request.point >= points)
    throw FaultError(Fault{"point", fmt::format("is {}", request.point), fmt::format("0 to {}", points - 1)});
  if (request.subject > design.subjects)
    throw FaultError(Fault{"--subject", fmt::format("is {}", request.subject), fmt::format("1 to {}", design.subjects)});
  const study::PointTask task = study::taskOf(design, study::pointAt(design, request.point));
  const std::string folder = request.out.empty() ? "." : request.out;
  const std::string device = task.device;
  if (!design.planText.empty())
    throw FaultError(Fault{"point", "is of a study that goes through a plan", "points of a study of experiments"});
  const study::PointExperiment& experiment = task.experiments.front();
  const std::string file = fmt::format("{}/point-{}-{}.json", folder, request.point, nameOfFile(experiment.name));
  atOption("--out", [&] { record::writeFileAtomically(file, experiment.text); });
  fmt::print("reach run {} --device {} --trials {} --seed {} --fast\n", shellWord(file), shellWord(device), task.plan.blocks.front().trials,
             study::seedOf(design, request.point, request.subject, task.days.front()));
}

struct ReportRequest {
  std::string folder, out;
  study::ReportOptions options;
};

void tellReport(const ReportRequest& request) {
  const study::StudyReport report = study::makeReport(study::openFolder(request.folder), request.options);
  const std::string out = request.out.empty() ? request.folder + "/report" : request.out;
  for (const std::string& file : atOption("--out", [&] { return study::writeReport(report, out); })) fmt::print("{}\n", file);
  for (const std::string& note : report.notes) fmt::print(stderr, "note: {}\n", note);
}

struct SbatchRequest {
  std::string study, out, time = "08:00:00";
  int tasks = 10, cpus = 1;
};

// A task may be killed or put back at any moment: the chunks that are there are done.
void tellSbatch(const SbatchRequest& request) {
  const study::Design design = study::readDesign(request.study);
  const std::string out = outOf(request.out, request.study);
  const std::int64_t chunks = study::planChunks(design).count();
  const auto tasks = static_cast<int>(std::min<std::int64_t>(request.tasks, chunks));
  fmt::print(
      "#!/bin/bash\n"
      "#SBATCH --job-name={}\n"
      "#SBATCH --array=1-{}\n"
      "#SBATCH --cpus-per-task={}\n"
      "#SBATCH --time={}\n"
      "#SBATCH --requeue\n"
      "# {} chunks, {} of them a task; SLURM_ARRAY_TASK_ID and SLURM_ARRAY_TASK_COUNT give the share. The task that finds all chunks "
      "there\n"
      "# writes the tables.\n"
      "srun --ntasks=1 reach study {} --out {} --jobs \"$SLURM_CPUS_PER_TASK\" --resume\n",
      analysis::fileNameOf(design.name), tasks, request.cpus, request.time, chunks, (chunks + tasks - 1) / tasks, shellWord(request.study),
      shellWord(out));
}

void tellParameters() {
  const auto table = [](const char* kind, std::span<const subjects::SubjectParameter> parameters) {
    fmt::print("kind={}\n\n| key | unit | default | allowed | meaning | source |\n|---|---|---|---|---|---|\n", kind);
    for (const subjects::SubjectParameter& p : parameters) {
      const std::string_view status = p.published ? "published: " : "assumed: ";
      fmt::print("| `{}` | {} | {} | {} to {} | {} | {}{} |\n", p.key, p.unit, p.usual, p.least, p.most, p.meaning,
                 p.source.starts_with("assumed") ? "" : status, p.source);
    }
    fmt::print("\n");
  };
  table("plan", subjects::planParameters());
  table("impedance", subjects::impedanceParameters());
  table("ofc", subjects::feedbackParameters());
}

}  // namespace

void addStudyCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("study", "Virtual subjects by the thousand: a grid or a random sample of settings");
  command->require_subcommand(0, 1);
  const auto r = std::make_shared<StudyRequest>();
  command->add_option("study", r->study, "Study file (docs/reference/study.md)");
  command->add_option("--out", r->out, "Folder of the study [default: the file's name with -study, here]");
  command->add_option("--jobs", r->jobs, "Threads [default: one per processor]")->check(CLI::Range(1, 4096));
  command->add_option("--shard", r->shard, "I/N: share I of N of the chunks, 1 to N [default: the task of a Slurm array, or else all]");
  command->add_flag("--resume", r->resume, "Continue with the missing chunks");
  command->footer(
      "The same study gives the same bytes for any number of threads, shares, ranks and interruptions. Each chunk is safe on the disk "
      "when\n"
      "it is done; the run that finds all of them there writes trials.csv.gz, trials.h5 and trials.json (the columns' meanings).\n\n"
      "Examples:\n"
      "  reach study study.json --out stiffness\n"
      "  reach study study.json --out stiffness --shard 2/8 --resume\n"
      "  reach study status stiffness");
  command->callback([command, r] {
    if (command->get_subcommands().empty()) runStudy(*r);
  });

  CLI::App* status = command->add_subcommand("status", "How far a study is, its rate, and the time that is left");
  status->footer("Example:\n  reach study status stiffness");
  const auto folder = std::make_shared<std::string>();
  status->add_option("folder", *folder, "Folder of the study")->required();
  status->callback([folder] { tellStatus(*folder); });

  CLI::App* point = command->add_subcommand("point", "Writes the experiment of a point, and says how a recorded run repeats a subject");
  point->footer("Example:\n  reach study point stiffness 12 --subject 3 --out point-12");
  const auto p = std::make_shared<PointRequest>();
  point->add_option("folder", p->folder, "Folder of the study")->required();
  point->add_option("point", p->point, "Number of the point, from 0")->required();
  point->add_option("--subject", p->subject, "Number of the subject, from 1")->check(CLI::PositiveNumber)->capture_default_str();
  point->add_option("--out", p->out, "Folder to write to [default: here]");
  point->callback([p] { tellPoint(*p); });

  CLI::App* report = command->add_subcommand("report", "Tables and figures: success, confusion of criteria, power and the smallest design");
  report->footer("Example:\n  reach study report stiffness --subjects 5,8,12 --out figures");
  const auto q = std::make_shared<ReportRequest>();
  report->add_option("folder", q->folder, "Folder of the study")->required();
  report->add_option("--out", q->out, "Folder to write to [default: FOLDER/report]");
  report->add_option("--studies", q->options.studies, "Studies that are drawn for each design")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  report->add_option("--subjects", q->options.subjects, "Numbers of subjects to look at [default: 5, 6, 7 … up to half of those there are]")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  report->add_option("--trials", q->options.trials, "Numbers of trials to look at [default: 10, 12, 15 … up to all]")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  report->callback([q] { tellReport(*q); });

  CLI::App* sbatch = command->add_subcommand("sbatch", "Prints the script of a Slurm array for a study");
  sbatch->footer("Example:\n  reach study sbatch study.json --out /scratch/stiffness --tasks 32 > study.sbatch");
  const auto b = std::make_shared<SbatchRequest>();
  sbatch->add_option("study", b->study, "Study file")->required();
  sbatch->add_option("--out", b->out, "Folder of the study, which every node reaches [default: the file's name with -study]");
  sbatch->add_option("--tasks", b->tasks, "Tasks of the array")->check(CLI::Range(1, 100000))->capture_default_str();
  sbatch->add_option("--cpus", b->cpus, "Processors of a task")->check(CLI::Range(1, 4096))->capture_default_str();
  sbatch->add_option("--time", b->time, "Time limit of a task")
      ->check([](const std::string& time) {
        const bool fine = !time.empty() && time.find_first_not_of("0123456789:-") == std::string::npos;
        return fine ? std::string() : std::string("is no time of Slurm; allowed: minutes, HH:MM:SS or D-HH:MM:SS");
      })
      ->capture_default_str();
  sbatch->callback([b] { tellSbatch(*b); });

  CLI::App* parameters =
      command->add_subcommand("parameters", "Every number of the virtual subjects with unit, default and source, as Markdown");
  parameters->footer("Example:\n  reach study parameters > parameters.md");
  parameters->callback(tellParameters);
}

}  // namespace reachlab::cli
