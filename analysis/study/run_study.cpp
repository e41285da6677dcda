#include "analysis/study/run_study.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>

#include "analysis/study/chunk_worker.h"
#include "base/system/os.h"
#include "base/system/worker_threads.h"

namespace reachlab::study {

void computeChunks(const StudyFolder& folder, unsigned jobs, const NextChunk& next, const std::function<void(std::int64_t trials)>& done) {
  std::mutex mutex;
  runOnThreads(jobs, [&](const std::atomic<bool>& ended) {
    ChunkWorker worker(folder.design);
    while (!ended) {
      const std::optional<std::int64_t> chunk = next();
      if (!chunk) return;
      const auto rows = worker.compute(folder.chunks.at(*chunk), [&](std::int64_t trials) {
        const std::lock_guard lock(mutex);
        done(trials);
        return !ended;
      });
      if (rows) writeChunk(folder.path, *chunk, folder.fingerprint, *rows);
    }
  });
}

void workThrough(const StudyFolder& folder, const Shard& shard, const TellProgress& tell, const ComputeAll& work) {
  const ChunksToDo todo = chunksToDo(folder, shard);
  const auto trialsOf = [&, most = mostTrialsOfSubject(folder.design)](std::int64_t chunk) {
    const PairRange range = folder.chunks.at(chunk);
    return trialsOfPairs(folder.design, most, range.first, range.end);
  };
  StudyProgress progress;
  for (std::int64_t chunk = 0; chunk < folder.chunks.count(); ++chunk)
    if (shard.has(chunk)) progress.trials += trialsOf(chunk);
  progress.trialsDone = progress.trials;
  for (const std::int64_t chunk : todo.missing) progress.trialsDone -= trialsOf(chunk);
  std::atomic<std::size_t> at{0};
  const std::int64_t began = os::now();
  const auto next = [&]() -> std::optional<std::int64_t> {
    const std::size_t i = at++;
    return i < todo.missing.size() ? std::optional(todo.missing[i]) : std::nullopt;
  };
  std::mutex mutex;
  work(next, [&](std::int64_t trials) {
    const std::lock_guard lock(mutex);
    progress.trialsDone += trials;
    progress.trialsNow += trials;
    progress.seconds = static_cast<double>(os::now() - began) * 1e-9;
    if (tell) tell(progress);
  });
}

void computeShard(const StudyFolder& folder, unsigned jobs, const Shard& shard, const TellProgress& tell) {
  workThrough(folder, shard, tell, [&](const NextChunk& next, const auto& done) { computeChunks(folder, jobs, next, done); });
}

void checkPoints(const Design& design) {
  constexpr std::int64_t kMostPoints = 200;
  const std::int64_t points = pointCount(design), looked = std::min(points, kMostPoints);
  std::set<std::pair<std::string, std::string>> seen;
  for (std::int64_t i = 0; i < looked; ++i) {
    const std::int64_t index = looked < 2 ? 0 : i * (points - 1) / (looked - 1);
    checkPoint(design, index, seen);
  }
}

}  // namespace reachlab::study
