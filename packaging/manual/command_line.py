"""The command line of a program as it tells it itself: `PROGRAM [COMMAND...] --help`, read into a tree."""
import re
import subprocess
from dataclasses import dataclass, field


@dataclass
class Option:
    names: list        # ["-h", "--help"], or the positional's name
    value: str         # "TEXT", "INT", … ; empty for a flag
    choices: list      # of the value, if it has a fixed set
    bounds: str        # " in [1 - 9999]"
    default: str
    required: bool
    repeats: bool
    text: str


@dataclass
class Command:
    words: list        # ["reach", "run"]
    text: str
    usage: str
    options: list = field(default_factory=list)
    positionals: list = field(default_factory=list)
    commands: list = field(default_factory=list)
    footer: str = ""

    @property
    def name(self):
        return "-".join(self.words)

    def walk(self):
        yield self
        for command in self.commands:
            yield from command.walk()


COLUMN = 30  # where CLI11 begins the right column; a longer left one has a line of its own


def rows(lines):
    """(left, right) of a two-column section; the right column may go on below."""
    found = []
    for line in lines:
        if not line.startswith("   "):
            left, right = line[:COLUMN], line[COLUMN:]
            whole = right == "" or (left.endswith(" ") and left.count("[") == left.count("]") and left.count("{") == left.count("}"))
            found.append([left.strip(), right.strip()] if whole else [line.strip(), ""])
        elif found:
            found[-1][1] = f"{found[-1][1]} {line.strip()}".strip()
    return found


def option(left, right):
    names, _, value = left.partition(" ")
    repeats = value.endswith("...")
    value = value.removesuffix("...").strip(" <>")
    required = right.endswith("(required)")
    right = right.removesuffix(" (required)")
    default, bounds, choices = "", "", []
    if found := re.search(r" \[default: ([^][]*)\]", right):
        default, right = found[1], right.replace(found[0], "", 1)
    if found := re.search(r" \[(?:(\S+ to \S+|more than 0|0 or more)|((?:[\w-]+, )*[\w-]+ or [\w-]+))\]$", right):
        choices, bounds, right = re.split(", | or ", found[2]) if found[2] else [], found[1] or "", right[:found.start()]
    return Option(names.split(","), value, choices, bounds, default, required, repeats, right)


def read(program, words):
    """The tree of `program`, called by the name words[0]."""
    done = subprocess.run([program, *words[1:], "--help"], capture_output=True, text=True, check=True)
    lines = done.stdout.splitlines()
    at = {i: line for i, line in enumerate(lines) if re.fullmatch(r"(?!Examples?:)[A-Z][a-z]+:", line)}
    usage = next(i for i, line in enumerate(lines) if line.startswith("Usage: "))
    command = Command(list(words), " ".join(lines[:usage]).removeprefix(f"{words[0]}: "), lines[usage].removeprefix("Usage: "))
    last = usage + 1
    for start, section in at.items():
        end = next((i for i in range(start + 1, len(lines)) if not lines[i].strip()), len(lines))
        table = rows(lines[start + 1:end])
        if section == "Positionals:":
            last = end
            command.positionals += [option(*row) for row in table]
        elif table[0][0].startswith("-"):
            last = end
            command.options += [option(*row) for row in table]
        elif section == "Subcommands:" or len(words) == 1:  # `reach` has its commands in groups
            last = end
            command.commands += [read(program, [*words, name]) for name, _ in table]
    command.footer = "\n".join(lines[last:]).strip("\n")
    return command
