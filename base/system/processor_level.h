#pragma once

namespace reachlab {

/// What this program was compiled for: "x86-64-v3", "native" (the machine that built it) or "x86-64".
const char* processorLevel() noexcept;

/// Ends the program with a sentence where the processor lacks what it was compiled for. Also done before everything else in the program, in code
/// that any processor runs; called by `main`, so that it is linked.
void requireProcessorLevel() noexcept;

}  // namespace reachlab
