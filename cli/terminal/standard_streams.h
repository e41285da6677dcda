#pragma once

namespace reachlab::cli {

/// After this call no output to stdout, stderr, std::cout or std::cerr throws or ends the program. The first fault of the standard output
/// is kept for finishStandardOutput. A closed pipe takes the remaining output silently, since a recording must not end because `head` has
/// seen enough. Control characters from names, keys and labels are written as `\x1b`, so that no file can control the terminal. Once, at
/// the start of main, before anything is written.
void guardStandardStreams();

/// True once the reader of the standard output has gone. Work that only writes to it may stop.
bool isStandardOutputClosed();

/// Flushes, and returns the exit code of the program. When output was lost, it writes one sentence on stderr and returns 3 instead of 0.
/// Otherwise it returns `exitCode`. A closed pipe is no fault.
int finishStandardOutput(int exitCode);

}  // namespace reachlab::cli
