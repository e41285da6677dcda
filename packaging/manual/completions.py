"""Completions for bash, zsh and fish from a tree of command_line.py. Names that the program knows are asked of it when they are wanted."""

# Values that `reach list WHAT` names, by the name of option or argument.
LISTED = {"experiment": "experiments", "--experiment": "experiments", "--device": "devices", "--criterion": "criteria", "name": "constraints"}
FILES = {"files", "log", "dataset", "--out", "--data", "--json", "--svg", "--figure", "--pictures", "experiment", "name", "--hand", "what"}


def listed(what):
    return f"$(reach list {what} 2>/dev/null | cut -d' ' -f1)"


def long_names(command):
    return [name for option in command.options for name in option.names if name.startswith("--")]


def words_of(option):
    """(fixed words, list asked of the program, files too) that may stand for the option's value."""
    for name in option.names:
        if option.choices:
            return option.choices, "", False
        if name in LISTED:
            return [], LISTED[name], name in FILES
        if name in FILES:
            return [], "", True
    return [], "", False


def reply(option):
    fixed, what, files = words_of(option)
    words = " ".join(fixed) + (listed(what) if what else "")
    lines = []
    if words:
        lines.append(f'COMPREPLY=($(compgen -W "{words}" -- "$word"))')
    if files:
        lines.append('COMPREPLY+=($(compgen -f -- "$word"))')
    return "; ".join(lines) or "COMPREPLY=()"


def bash(tree):
    function = f"_{tree.name}"
    out = [f"# bash completion of {tree.name}, made from its --help", f"{function}() {{",
           '  local word=${COMP_WORDS[COMP_CWORD]} last=${COMP_WORDS[COMP_CWORD-1]} command="" i',
           "  COMPREPLY=()"]
    deep = max(len(c.words) for c in tree.walk()) - 1
    if deep:
        out += ["  for ((i = 1; i < COMP_CWORD && i <= %d; ++i)); do [[ ${COMP_WORDS[i]} == -* ]] && break; command+=${command:+ }${COMP_WORDS[i]}; done" % deep]
        two = " ".join(c.words[1] for c in tree.walk() if len(c.words) == 2 and c.commands)
        out += [f'  case " {two} " in *" ${{command%% *}} "*) ;; *) command=${{command%% *}} ;; esac']
    out += ['  case "$command" in']
    for command in tree.walk():
        out += [f'    "{" ".join(command.words[1:])}")', '      case "$last" in']
        for option in command.options:
            if option.value:
                out += [f'        {"|".join(option.names)}) {reply(option)}; return ;;']
        out += ["      esac",
                f'      if [[ $word == -* ]]; then COMPREPLY=($(compgen -W "{" ".join(long_names(command))}" -- "$word")); return; fi']
        if command.commands:
            out += [f'      COMPREPLY=($(compgen -W "{" ".join(c.words[-1] for c in command.commands)}" -- "$word"))']
        for option in command.positionals[:1]:
            out += [f"      {reply(option)}"]
        out += ["      ;;"]
    out += ["  esac", "}", f"complete -o filenames -F {function} {tree.name}", ""]
    return "\n".join(out)


def quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


def zsh_values(option):
    fixed, what, files = words_of(option)
    if fixed:
        return f"({' '.join(fixed)})"
    if what and files:
        return "{_alternative 'names:name:(" + listed(what) + ")' 'files:file:_files'}"
    if what:
        return f"({listed(what)})"
    return "_files" if files else " "


def zsh_plain(text):
    return text.replace("[", "(").replace("]", ")").replace(":", " ").replace("`", "").replace("$", "").replace("'", "").replace('"', "").replace("\\", "")


def zsh_arguments(command):
    out = []
    for option in command.options:
        for name in option.names:
            value = f":{option.value.lower()}:{zsh_values(option)}" if option.value else ""
            repeats = "*" if option.repeats else ""
            out.append(f'    "{repeats}{name}[{zsh_plain(option.text)}]{value}"')
    for option in command.positionals[:1]:
        out.append(f'    "{"*" if option.repeats else "1"}:{option.names[0]}:{zsh_values(option)}"')
    return out


def zsh(tree):
    out = [f"#compdef {tree.name}", f"# zsh completion of {tree.name}, made from its --help"]

    def function(command):
        name = "_" + command.name.replace("-", "_")
        out.extend([f"{name}() {{", "  local -a commands", "  local context state line", "  typeset -A opt_args"])
        if command.commands:
            out.extend(["  commands=("] + [f"    {quoted(c.words[-1] + ':' + zsh_plain(c.text))}" for c in command.commands] + ["  )"])
            out.extend(["  _arguments -C \\"] + [line + " \\" for line in zsh_arguments(command)] + ['    "1:command:->command" "*::argument:->argument"'])
            out.extend(["  case $state in", f"    command) _describe command commands ;;", "    argument)", "      case $line[1] in"])
            out.extend([f"        {c.words[-1]}) _{c.name.replace('-', '_')} ;;" for c in command.commands])
            out.extend(["      esac ;;", "  esac"])
        else:
            lines = zsh_arguments(command)
            out.extend(["  _arguments \\"] + [line + " \\" for line in lines[:-1]] + lines[-1:])
        out.append("}")
        for inner in command.commands:
            function(inner)

    function(tree)
    out.extend([f'_{tree.name} "$@"', ""])
    return "\n".join(out)


def fish(tree):
    out = [f"# fish completion of {tree.name}, made from its --help", f"complete -c {tree.name} -f"]
    for command in tree.walk():
        seen = "; and ".join(f"__fish_seen_subcommand_from {word}" for word in command.words[1:])
        names = " ".join(c.words[-1] for c in command.commands)
        if command.commands:
            here = f"not __fish_seen_subcommand_from {names}" + (f"; and {seen}" if seen else "")
        else:
            here = seen or "true"
        for inner in command.commands:
            out.append(f"complete -c {tree.name} -n {quoted(here)} -a {inner.words[-1]} -d {quoted(inner.text)}")
        for option in command.options:
            fixed, what, files = words_of(option)
            values = " ".join(fixed) + (f"(reach list {what} 2>/dev/null | string split -f1 ' ')" if what else "")
            long = [name[2:] for name in option.names if name.startswith("--")]
            short = [name[1:] for name in option.names if not name.startswith("--")]
            out.append(f"complete -c {tree.name} -n {quoted(here)}" + "".join(f" -s {s}" for s in short) + "".join(f" -l {n}" for n in long)
                       + (" -r" if option.value else "") + (" -F" if files else "") + (f" -a {quoted(values)}" if values else "") + f" -d {quoted(option.text)}")
        for option in command.positionals[:1]:
            _, what, files = words_of(option)
            fixed = " ".join(words_of(option)[0])
            values = fixed + (f"(reach list {what} 2>/dev/null | string split -f1 ' ')" if what else "")
            if values or files:
                out.append(f"complete -c {tree.name} -n {quoted(here)}" + (" -F" if files else "") + (f" -a {quoted(values)}" if values else ""))
    return "\n".join(out) + "\n"
