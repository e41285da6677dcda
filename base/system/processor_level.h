#pragma once

namespace reachlab {

/// The processor level of this build: "x86-64-v3", "native" (the machine that built it) or "x86-64".
const char* processorLevel() noexcept;

/// Ends the program with a sentence if the processor lacks an instruction set of the build. The check also runs before everything else in
/// the program, in code that any processor runs. `main` calls this function so that the check is linked.
void requireProcessorLevel() noexcept;

}  // namespace reachlab
