#!/usr/bin/env python3
"""Writes man pages and completions of programs from their own --help: command_pages.py VERSION FOLDER PROGRAM...

FOLDER/man1/*.1 (one page a command), FOLDER/bash/NAME, FOLDER/zsh/_NAME, FOLDER/fish/NAME.fish."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from command_line import read  # noqa: E402
from completions import bash, fish, zsh  # noqa: E402

FILES = """\
.TP
.B $REACHLAB_CONSTRAINTS
Folder of your own constraint definitions; else
.B reachlab/constraints
in
.BR $XDG_DATA_HOME ,
or in ~/.local/share.
.TP
.B $REACHLAB_RESOURCES
Folder of the shipped experiments, plans and reaches, where it is not the installed one.
.TP
.B $REACHLAB_LEVEL
x86\\-64\\-v2, x86\\-64\\-v3 or x86\\-64\\-v4: the program for this level of processor, in place of the highest that this processor has. All compute the same bits.
"""


def escaped(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\n".join("\\&" + line if line.startswith((".", "'")) else line for line in text.split("\n"))


def entry(option):
    left = ", ".join(f"\\fB{escaped(name)}\\fR" for name in option.names)
    if option.value and option.names[0].startswith("-"):
        left += f" \\fI{escaped(option.value)}\\fR"
    if option.repeats:
        left += " ..."
    said = [option.text] if option.text else []
    if option.choices:
        said.append("One of " + ", ".join(option.choices) + ".")
    if option.bounds:
        said.append("Allowed: " + option.bounds + ".")
    if option.default:
        said.append(f"Default: {option.default}.")
    if option.required and option.names[0].startswith("-"):
        said.append("Required.")
    return f".TP\n{left}\n{escaped(' '.join(part if part.endswith(('.', ']', ')')) else part + '.' for part in said))}\n"


def man_page(command, version, others):
    title = command.name.upper()
    first = command.text.rstrip(".")
    page = f'.TH "{title}" "1" "" "Reachlab {version}" "User Commands"\n'
    page += f".SH NAME\n{escaped(command.name)} \\- {escaped(first[0].lower() + first[1:])}\n"
    page += f".SH SYNOPSIS\n.B {escaped(command.usage)}\n"
    if command.positionals:
        page += ".SH ARGUMENTS\n" + "".join(entry(option) for option in command.positionals)
    if command.commands:
        page += ".SH COMMANDS\n" + "".join(f".TP\n.BR {escaped(c.name)} (1)\n{escaped(c.text)}\n" for c in command.commands)
    page += ".SH OPTIONS\n" + "".join(entry(option) for option in command.options)
    if command.footer:
        page += f".SH NOTES\n.nf\n{escaped(command.footer)}\n.fi\n"
    if len(command.words) == 1:
        page += ".SH ENVIRONMENT\n" + FILES
    page += ".SH EXIT STATUS\n0: done. 2: wrong usage or a bad file. 3: a device or another resource cannot be had. 4: the computation was refused, with the reason.\n"
    page += ".SH SEE ALSO\n" + ",\n".join(f".BR {escaped(name)} (1)" for name in others if name != command.name) + "\n"
    page += ".PP\nThe manual: /usr/share/doc/reachlab/html/index.html (package reachlab\\-doc).\n"
    return page


def main():
    version, folder, programs = sys.argv[1], Path(sys.argv[2]), sys.argv[3:]
    trees = [read(program, [Path(program).name]) for program in programs]
    for part in ("man1", "bash", "zsh", "fish"):
        (folder / part).mkdir(parents=True, exist_ok=True)
    for tree in trees:
        for command in tree.walk():
            near = [c.name for other in trees for c in other.walk() if len(c.words) <= 2]
            (folder / f"man1/{command.name}.1").write_text(man_page(command, version, near))
        (folder / f"bash/{tree.name}").write_text(bash(tree))
        (folder / f"zsh/_{tree.name}").write_text(zsh(tree))
        (folder / f"fish/{tree.name}.fish").write_text(fish(tree))


if __name__ == "__main__":
    main()
