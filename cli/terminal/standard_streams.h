#pragma once

namespace reachlab::cli {

/// From here on nothing that is written to stdout, stderr, std::cout or std::cerr throws or ends the program: the first fault of the standard
/// output is kept for finishStandardOutput, a closed pipe takes the rest without a word (a recording must not end because `head` has seen
/// enough), and control characters from names, keys and labels are written as `\x1b`, so that no file can talk to the terminal.
/// Once, at the start of main, before anything is written.
void guardStandardStreams();

/// True once the reader of the standard output has gone: what only writes to it may stop.
bool isStandardOutputClosed();

/// Flushes, and returns the exit code of the program: `exitCode`, but 3 instead of 0, with one sentence on stderr, when something written to
/// the standard output was lost. A closed pipe is no fault.
int finishStandardOutput(int exitCode);

}  // namespace reachlab::cli
