# Reachlab's CSV export in R: Rscript session.R FOLDER [PREDICTION.csv]
# The same steps and the same numbers as session.py; base R only.
arguments <- commandArgs(trailingOnly = TRUE)
folder <- arguments[1]

# 1. The trials. Labels are text: read as numbers, subject 01 would become 1.
trials <- read.csv(file.path(folder, "trials.csv"), colClasses = c(subject = "character", session = "character"))
trials <- trials[trials$phase == "recorded" & trials$catch_trial == 0 & trials$outcome %in% c("success", "failure"), ]

# 2. Success, as in the paper's Table 2. Aborted and interrupted trials are no attempts.
by <- trials[c("condition", "session", "subject")]  # the last one varies slowest
successes <- aggregate(list(n = trials$outcome == "success"), by, sum)
counts <- aggregate(list(n = trials$trial), by, length)
cat("subject session condition successes trials percent\n")
cat(sprintf("%s %s %s %d %d %.1f\n", successes$subject, successes$session, successes$condition,
            as.integer(successes$n), counts$n, 100 * successes$n / counts$n), sep = "")

# 3. Movement times of the successful trials.
good <- trials[trials$outcome == "success", ]
cat("condition mean_s sd_s\n")
for (condition in sort(unique(good$condition))) {
  times <- good$movement_time_s[good$condition == condition]
  cat(sprintf("%s %.4f %.4f\n", condition, mean(times), sd(times)))
}

# 4. The hand's velocity along the way of every successful trial, from onset to end, at 101 instants, scaled to the mean movement time.
runs <- unique(good[c("subject", "session", "run")])
profiles <- do.call(rbind, lapply(seq_len(nrow(runs)), function(i) {
  pattern <- sprintf("sub-%s_ses-%s_*_run-%02d_samples.csv", runs$subject[i], runs$session[i], runs$run[i])
  samples <- read.csv(Sys.glob(file.path(folder, pattern))[1])
  rows <- merge(good, runs[i, ])
  rows <- rows[order(rows$trial), ]
  t(sapply(seq_len(nrow(rows)), function(k) {
    time <- seq(rows$task_onset_s[k], rows$end_s[k], length.out = 101)
    at <- function(columns) sapply(sprintf(columns, c("x", "y", "z")), function(c) approx(samples$time_s, samples[[c]], time, rule = 2)$y)
    places <- at("hand_%s_m")
    way <- places[101, ] - places[1, ]
    velocity <- drop(at("hand_v%s_m_per_s") %*% way) / sqrt(sum(way^2))
    velocity * rows$movement_time_s[k] / mean(good$movement_time_s)
  }))
}))
profile <- colMeans(profiles)
cat(sprintf("hand: peak of the mean profile %.4f m/s at %d %%, %d trials\n", max(profile), which.max(profile) - 1L, nrow(profiles)))

# 5. Against a prediction, the paper's epsilon over all samples.
if (length(arguments) > 1) {
  prediction <- read.csv(arguments[2])
  duration <- tail(prediction$time_s, 1)
  expected <- approx(prediction$time_s, prediction$hand_m_per_s, seq(0, duration, length.out = 101))$y * duration / mean(good$movement_time_s)
  cat(sprintf("epsilon %.4f m/s\n", sqrt(mean(sweep(profiles, 2, expected)^2))))
}
