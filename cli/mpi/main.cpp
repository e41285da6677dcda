// `reach-mpi STUDY`: a study over the ranks of an MPI job. Rank 0 hands out chunks one by one to whoever is free and computes beside that;
// everything else is `reach study`, and the bytes are the same.
#include <fmt/format.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <future>
#include <thread>

#include "analysis/study/points.h"
#include "analysis/study/run_study.h"
#include "base/fault.h"
#include "cli/output/progress_line.h"
#include "cli/output/study_words.h"
#include "cli/terminal/exit_code.h"

namespace reachlab::cli {
namespace {

constexpr int kAsk = 1, kAnswer = 2;
constexpr std::int64_t kNoMore = -1;

/// A fault on one rank is the end of all: the chunks that are there stay.
class MpiWorld {
 public:
  MpiWorld(int& argc, char**& argv) {
    int provided = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  ~MpiWorld() { MPI_Finalize(); }
  MpiWorld(const MpiWorld&) = delete;
  MpiWorld& operator=(const MpiWorld&) = delete;
  int rank() const { return rank_; }
  int size() const { return size_; }

 private:
  int rank_ = 0, size_ = 1;
};

// Answers the other ranks until each has been told that nothing is left. Looks every millisecond, so that its own worker has the processor.
void serve(const study::NextChunk& next, int others, const std::function<void(std::int64_t trials)>& done) {
  while (others > 0) {
    int there = 0;
    MPI_Status status{};
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
    if (there == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      continue;
    }
    std::int64_t trials = 0;
    MPI_Recv(&trials, 1, MPI_INT64_T, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    if (trials > 0) done(trials);
    if (status.MPI_TAG != kAsk) continue;
    const std::int64_t chunk = next().value_or(kNoMore);
    MPI_Send(&chunk, 1, MPI_INT64_T, status.MPI_SOURCE, kAnswer, MPI_COMM_WORLD);
    if (chunk == kNoMore) --others;
  }
}

void conduct(const study::StudyFolder& folder, int others) {
  ProgressLine line;
  std::future<void> own;
  const auto tell = [&](const study::StudyProgress& progress) { line.tell(describeProgress(progress)); };
  study::workThrough(folder, {}, tell, [&](const study::NextChunk& next, const auto& done) {
    own = std::async(std::launch::async, [&] { study::computeChunks(folder, 1, next, done); });
    serve(next, others, done);
    own.wait();
  });
  line.end();
  own.get();
}

void work(const study::StudyFolder& folder) {
  std::int64_t trialsSince = 0;
  const auto next = [&]() -> std::optional<std::int64_t> {
    MPI_Send(&trialsSince, 1, MPI_INT64_T, 0, kAsk, MPI_COMM_WORLD);
    trialsSince = 0;
    std::int64_t chunk = kNoMore;
    MPI_Recv(&chunk, 1, MPI_INT64_T, 0, kAnswer, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return chunk == kNoMore ? std::nullopt : std::optional(chunk);
  };
  study::computeChunks(folder, 1, next, [&](std::int64_t trials) { trialsSince += trials; });
}

void runStudy(const std::string& file, const std::string& out, bool resume, const MpiWorld& world) {
  if (world.rank() == 0) {
    const study::Design design = study::readDesign(file);
    study::checkPoints(design);
    const study::StudyFolder folder = study::makeFolder(design, out);
    if (const std::int64_t there = study::chunksToDo(folder).there; there > 0 && !resume && !study::areTablesThere(folder))
      throw FaultError(Fault{"--out", fmt::format("{}: {} chunks are there already", out, there),
                             "another folder, or --resume, which continues with the other chunks"});
  }
  MPI_Barrier(MPI_COMM_WORLD);  // the folder is there
  const study::StudyFolder folder = study::openFolder(out);
  if (world.rank() == 0) conduct(folder, world.size() - 1);
  else work(folder);
  MPI_Barrier(MPI_COMM_WORLD);  // every chunk is there
  if (world.rank() == 0 && study::mergeTables(folder)) fmt::print("{0}/trials.csv.gz {0}/trials.h5 {0}/trials.json\n", out);
}

int run(int argc, char** argv) {
  MpiWorld world(argc, argv);
  CLI::App app{"reach-mpi: a study of virtual subjects over the ranks of an MPI job", "reach-mpi"};
  std::string file, out;
  bool resume = false;
  app.add_option("study", file, "Study file, as for reach study")->required();
  app.add_option("--out", out, "Folder of the study, which every rank reaches")->required();
  app.add_flag("--resume", resume, "Continue with the missing chunks");
  app.footer("Example: mpirun -n 64 reach-mpi study.json --out stiffness --resume");
  const int code = exitCodeOf(app, [&] {
    app.parse(argc, argv);
    runStudy(file, out, resume, world);
    return 0;
  });
  if (code != 0) MPI_Abort(MPI_COMM_WORLD, code);
  return code;
}

}  // namespace
}  // namespace reachlab::cli

int main(int argc, char** argv) { return reachlab::cli::run(argc, argv); }
