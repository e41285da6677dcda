"""Writes many seeded faults into one text, each behind a switch that is read when the program starts (fault_switch.h).

An operator or a constant becomes a choice between the whole expression as it is and with the fault, so that precedence and short circuits are
those of the fault written out; a statement becomes one that is passed over. A constant's own definition keeps its value for what needs it at
compile time, and every use of its name elsewhere becomes the choice.
"""
import dataclasses
import re

STOPS = re.compile(r"\b(?:return|case|throw|else|do|co_return|goto|typename|delete|const|auto)\b")
SCALAR = r"(?:double|float|bool|int|unsigned|long|(?:std::)?u?int\d+_t|(?:std::)?size_t|std::ptrdiff_t|std::uint64_t|std::int64_t)"
CALLS_WITHOUT_EFFECT = re.compile(r"\.(?:size|empty|rows|cols)\(\)")
MAY_COMPUTE_BOTH = re.compile(r"[\w\s.:<>=!+*-]+")


@dataclasses.dataclass
class Site:
    number: int
    kind: str
    begin: int
    end: int
    new: str
    region: tuple = (0, 0)   # of the expression or statement that is written twice
    constant: str = ""       # name of the constant in whose definition it stands
    inner: list = dataclasses.field(default_factory=list)


def brackets(bare):
    """Partner of every bracket."""
    partner, open_ = {}, []
    for i, c in enumerate(bare):
        if c in "([{":
            open_.append(i)
        elif c in ")]}" and open_:
            j = open_.pop()
            partner[i], partner[j] = j, i
    return partner


def is_assignment(bare, i):
    return bare[i] == "=" and bare[i - 1] not in "=!<>" and bare[i + 1:i + 2] != "="


def left_of(bare, partner, at):
    """Where the expression begins that reaches from somewhere to `at`."""
    i = at - 1
    while i >= 0:
        c = bare[i]
        if c == ")" or c == "]":
            j = partner.get(i, -1)
            if j < 0 or c == ")" and re.search(r"\b(?:if|for|while|switch)(?: constexpr)? $", bare[max(0, j - 16):j]):
                return i + 1
            i = j - 1
            continue
        if c == "}":
            j = partner.get(i, -1)
            if j < 0 or not re.match(r"[\w>]", bare[j - 1]):
                return i + 1
            i = j - 1
            continue
        if c in "([{;,?":
            return i + 1
        if c == ":":
            if bare[i - 1] == ":":
                i -= 2
                continue
            if bare[i + 1:i + 2] != ":":
                return i + 1
        if is_assignment(bare, i):
            return i + 1
        if c.isalpha() and not re.match(r"\w", bare[i + 1:i + 2]):
            begin = i
            while begin > 0 and re.match(r"\w", bare[begin - 1]):
                begin -= 1
            if STOPS.fullmatch(bare[begin:i + 1]):
                return i + 1
            i = begin - 1
            continue
        i -= 1
    return 0


def right_of(bare, partner, at):
    i = at
    while i < len(bare):
        c = bare[i]
        if c in "([{":
            if i not in partner:
                return i
            i = partner[i] + 1
            continue
        if c in ")]};,?" or is_assignment(bare, i):
            return i
        if c == ":":
            if bare[i + 1:i + 2] == ":":
                i += 2
                continue
            return i
        i += 1
    return len(bare)


def around(bare, partner, at):
    """Begins of the statements and heads that `at` stands in, the nearest first: (begin, end of that head or statement)."""
    i, end = at - 1, at
    heads = []
    while i >= 0:
        c = bare[i]
        if c in ")]":
            i = partner.get(i, i) - 1
            continue
        if c == "}" and partner.get(i, -1) >= 0:
            j = partner[i]
            if bare[j - 1:j] and re.match(r"[\w>]", bare[j - 1]):
                i = j - 1
                continue
            c = ";"
        if c == ";":
            heads.append((i + 1, end))
            i = outer(bare, partner, i)
            end = i
            i -= 1
            continue
        if c == "{":
            heads.append((i + 1, end))
            end = i
        i -= 1
    if end >= 0:
        heads.append((0, end))
    return heads


def outer(bare, partner, at):
    """The { that `at` stands in, or -1."""
    while at >= 0 and bare[at] != "{":
        at = (partner.get(at, at) if bare[at] in ")]}" else at) - 1
    return at


def without_remarks(text):
    """One line, without // remarks, so that it can stand twice."""
    text = re.sub(r'("(?:\\.|[^"\\\n])*")|//[^\n]*', lambda m: m.group(1) or "", text)
    return re.sub(r"\n\s*", " ", text)


def place(text, bare, faults):
    """Sites of the faults, with their regions; those whose region cannot be told are left out."""
    partner = brackets(bare)
    sites, left_out = [], []
    for number, kind, begin, end, new in faults:
        site = Site(number, kind, begin, end, new)
        heads = around(bare, partner, begin)
        own = " ".join(bare[heads[0][0]:heads[0][1]].split())
        if kind == "statement":
            site.region = (begin, end)
        elif re.search(r"(?<!if )\bconstexpr\b", own):  # its own definition
            m = re.search(r"\bconstexpr (?:const )?" + SCALAR + r" (?:\w+ = [^;{}()]*, )*(\w+) =(?: [^;,]*)?$", own)
            if not m:
                left_out.append(number)
                continue
            site.constant = m.group(1)
            site.region = (left_of(bare, partner, begin), right_of(bare, partner, end))
        elif bare[begin - 1:begin] == "<" or bare[end:end + 1] == ">" or re.search(r"\bcase\b[^:]*$", own.replace("::", "")):
            left_out.append(number)
            continue
        elif kind == "constant":
            site.region = (begin, end)
        else:
            site.region = (left_of(bare, partner, begin), right_of(bare, partner, end))
        first, last = site.region
        while kind != "statement" and text[first].isspace():
            first += 1
        while kind != "statement" and text[last - 1].isspace():
            last -= 1
        site.region = (first, last)
        sites.append(site)
    return sites, left_out


def faulty(text, begin, end, site):
    return without_remarks(text[begin:site.begin] + site.new + text[site.end:end])


def write(text, bare, begin, end, sites):
    """text[begin:end] with the sites' regions, which lie inside, behind their switches."""
    out, at = [], begin
    regions = {}
    for site in sites:
        regions.setdefault(site.region, []).append(site)
    tops = [r for r in regions if not any(o != r and o[0] <= r[0] and r[1] <= o[1] for o in regions)]
    for region in sorted(tops):
        inside = [s for s in sites if s.region != region and region[0] <= s.region[0] and s.region[1] <= region[1]]
        out.append(text[at:region[0]])
        right = write(text, bare, *region, inside)
        here = regions[region]
        statements = [s for s in here if s.kind == "statement"]
        expressions = [s for s in here if s.kind != "statement"]
        if statements:
            out.append(f"{{ if (!seededFault({statements[0].number})) {right} }}")
        elif len(expressions) == 1 and not inside and may_compute_both(bare, region, expressions[0]):
            out.append(f"seededFault({expressions[0].number}, ({right}), ({faulty(text, *region, expressions[0])}))")
        else:
            choice = "".join(f"seededFault({s.number}) ? ({faulty(text, *region, s)}) : " for s in expressions)
            out.append(f"({choice}({right}))")
        at = region[1]
    out.append(text[at:end])
    return "".join(out)


def may_compute_both(bare, region, site):
    if site.new == "/":  # of whole numbers, by 0: ends the program though the fault is not in force
        return False
    if site.kind not in ("comparison", "sign") or site.new.endswith("=") and site.new not in ("<=", ">=", "==", "!="):
        return False
    code = CALLS_WITHOUT_EFFECT.sub("", bare[region[0]:region[1]])
    return bool(MAY_COMPUTE_BOTH.fullmatch(code)) and not re.search(r"->|\+\+|--|(?<![=!<>])=(?!=)|\*(?! )|::\s*$", code)


def switched(text, bare, faults):
    """The text with all faults (number, kind, begin, end, new) behind switches, and the numbers of those that could not be placed."""
    sites, left_out = place(text, bare, faults)
    kept = []
    for site in sorted(sites, key=lambda s: (s.region[0], -s.region[1])):
        crosses = any(k.region[0] < site.region[0] < k.region[1] < site.region[1] for k in kept)
        twice = site.kind == "statement" and any(k.region == site.region for k in kept)
        (left_out.append(site.number) if crosses or twice else kept.append(site))
    constants = [s for s in kept if s.constant]
    plain = [s for s in kept if not s.constant]
    # A define is a line of its own after the definition's last line.
    defines = {}
    for name in {s.constant for s in constants}:
        same = [s for s in constants if s.constant == name]
        if len({s.region for s in same}) > 1:
            left_out += [s.number for s in same]
            continue
        region = same[0].region
        choice = "".join(f"seededFault({s.number}) ? static_cast<std::remove_cv_t<decltype({name})>>({faulty(text, *region, s)}) : " for s in same)
        line_end = text.find("\n", bare.find(";", region[1]))
        defines.setdefault(line_end, []).append(f"#define {name} ({choice}{name})")
    inside = []  # constexpr functions become plain ones
    partner = brackets(bare)
    for site in plain:
        for begin, end in around(bare, partner, site.begin)[1:]:
            table = re.search(r"\bconstexpr\b(?=[^;()]*[\w\]=] ?$)", bare[begin:end])
            if table and not re.search(r"\b(?:if|struct|class|namespace)\b", bare[begin:end]):
                inside.append((begin + table.start(), begin + table.end(), "const"))
                continue
            m = re.search(r"\bconstexpr\b(?=[^;=]*\)[^;=]*$)", bare[begin:end])
            if m and "if constexpr" not in bare[begin:end]:
                inside.append((begin + m.start(), begin + m.end(), "" if "inline" in bare[begin:end] else "inline"))
    written, at = '#include "tests/long/fault_switch.h"\n', 0
    cuts = sorted(set(inside) | {(e, e, "\n" + "\n".join(lines)) for e, lines in defines.items()})
    for begin, end, new in [*cuts, (len(text), len(text), "")]:
        written += write(text, bare, at, begin, [s for s in plain if at <= s.region[0] and s.region[1] <= begin]) + new
        at = end
    left_out += [s.number for s in kept if f"seededFault({s.number}" not in written]
    return written, sorted(set(left_out))


def refused(output, files):
    """Numbers of the faults that a compiler's errors point at. `files`: the text that was compiled, by the end of its path."""
    wrong, beside, named = set(), set(), set()
    for m in re.finditer(r"^(?:In file included from )?\s*([^\s:]+):(\d+):(?:\d+:)?(.*)$", output, re.M):
        path = next((p for p in files if ("/" + m.group(1)).endswith("/" + p)), None)
        if path is None:
            continue
        named.add(path)
        lines = files[path].split("\n")
        line = lines[int(m.group(2)) - 1] if int(m.group(2)) <= len(lines) else ""
        found = {int(n) for n in re.findall(r"seededFault\((\d+)", line)}
        (wrong if "error:" in m.group(3) else beside).update(found)
    if not wrong and not beside and "error" in output:
        wrong = {int(n) for path in named for n in re.findall(r"seededFault\((\d+)", files[path])}
    return wrong or beside
