"""What each fault does behind its switch is what it does written out: on a program that prints all it computes."""
import os
import pathlib
import re
import subprocess
import tempfile

import fault_sites

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEAD = """\
#include <array>
#include <cstdio>
#include <cstdlib>
#include <vector>
"""
TEXT = """\
constexpr double kShortest = 0.5, kLongest = 2.5;  // [m]
constexpr std::array<double, 3> kTable{1.5, 4.0, 8.0};
struct Pair {
  int one = 3;
  bool sound = true;
};
constexpr int twice(int n) { return 2 * n; }
int sum(const std::vector<int>& all, int below) {
  int total = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i] > below && all[i] < 9 || all[i] == 0) continue;
    total += all[i] - 1;
  }
  return total;
}
int sizeOf(const Pair& pair) {
  switch (pair.one) {
    case 3: return pair.sound ? 7 + twice(2) : 8;
    default: break;
  }
  if (!pair.sound || pair.one <= 2) return -pair.one * 2;
  return 5;
}
void run() {
  const auto less = [](double x) { return x <= kLongest && x >= kShortest; };
  double way = 1.0 + kLongest / 2.0 - kShortest;
  way *= kTable[1];
  if (way > 0.0) std::printf("%g ", way);
  std::printf("%d %d ", sum({0, 2, 4, 9, 11}, 3), sizeOf(Pair{}));
  const int seven = 7, many = 1'000;
  for (int i = 0; i < 3; ++i) std::printf("%d ", seven * i + many);
  std::printf("%d %d %d ", sizeOf({4, true}), sizeOf({4, false}), less(0.5) + less(2.5));
}
"""


def compile(folder, text):
    (folder / "program.cpp").write_text(text, encoding="utf-8")
    made = subprocess.run([os.environ.get("CXX", "g++"), "-std=c++20", "-w", "-D_GLIBCXX_ASSERTIONS", f"-I{ROOT}", "program.cpp", "-o", "program"], cwd=folder, capture_output=True, text=True)
    return made.stderr if made.returncode != 0 else None


def told_by(folder, number, seen=None):
    environment = dict(os.environ, REACHLAB_FAULT=str(number), **({"REACHLAB_FAULTS_SEEN": str(seen)} if seen else {}))
    done = subprocess.run([folder / "program"], env=environment, capture_output=True, text=True, timeout=60)
    return done.stdout if done.returncode == 0 else f"died {done.returncode}"


def written_out(folder, faults):
    """What each text with one fault in it prints, all in one program; None for what does not compile."""
    texts = {0: TEXT} | {n: TEXT[:begin] + new + TEXT[end:] for n, _, begin, end, new in faults}
    while True:
        whole, first_lines = HEAD, []
        for number, text in texts.items():
            first_lines.append((whole.count("\n") + 1, number))
            whole += f"namespace n{number} {{\n{text}}}\n"
        whole += "int main() {\n  switch (std::atoi(std::getenv(\"REACHLAB_FAULT\"))) {\n"
        whole += "".join(f"    case {number}: n{number}::run(); break;\n" for number in texts) + "  }\n}\n"
        errors = compile(folder, whole)
        if errors is None:
            return {n: told_by(folder, n) if n in texts else None for n in [0] + [f[0] for f in faults]}
        for m in re.finditer(r"^program\.cpp:(\d+):.*error:", errors, re.M):
            texts.pop(max((line, n) for line, n in first_lines if line <= int(m.group(1)))[1], None)


def check(faults_of, blanked):
    """0 when all agree."""
    bare = blanked(TEXT)
    faults = [(n, *fault[1:]) for n, fault in enumerate(faults_of("program.cpp", TEXT), 1)]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        expected = written_out(folder, faults)
        alone, chosen = [], faults
        while True:  # as with the sources: what the compiler refuses is taken out
            switched, left_out = fault_sites.switched(TEXT, bare, chosen)
            switched = switched.replace("\n", "\n" + HEAD, 1) + "int main() { run(); }\n"
            errors = compile(folder, switched)
            refused = fault_sites.refused(errors, {"program.cpp": switched}) if errors else set()
            alone += left_out + sorted(refused)
            if not errors:
                break
            if not refused:
                print(errors)
                return 1
            chosen = [f for f in chosen if f[0] not in alone]
        seen = folder / "seen"
        seen.write_bytes(bytes(16384))
        wrong = [] if told_by(folder, 0, seen) == expected[0] else ["the program without a fault differs"]
        reached = {n for n, mark in enumerate(seen.read_bytes()) if mark}
        for number, kind, begin, end, new in faults:
            if number in alone or expected[number] is None:
                continue
            words = f"{TEXT.count(chr(10), 0, begin) + 1}: {kind}: {TEXT[begin:end]} -> {new or 'nothing'}"
            got = told_by(folder, number)
            if got != expected[number]:
                wrong.append(f"{words}: written out {expected[number]!r}, behind a switch {got!r}")
            if got != expected[0] and number not in reached:
                wrong.append(f"{words}: is not marked as reached")
    print(f"{len(faults)} faults, {len(alone)} of them do not bear a switch: {len(wrong)} differ from the fault written out")
    for words in wrong:
        print(words)
    return 1 if wrong or len(alone) > len(faults) // 5 else 0
