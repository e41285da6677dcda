"""Which single faults a file can have, and the order in which a seed draws them (seeded_faults.py)."""
import hashlib
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]

COMPARISONS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&"}
SIGNS = {"+": "-", "-": "+", "+=": "-=", "-=": "+=", "*": "/", "/": "*", "*=": "/=", "/=": "*="}
OPERATOR = re.compile(r"(?<= )(<=|>=|==|!=|&&|\|\||\+=|-=|\*=|/=|<|>|\+|-|\*|/)(?= )")
UNARY = re.compile(r"(?:(?<=[(\[])|(?<=[,=?:] )|(?<=return ))[-!](?=[\w(])")
CONSTANT = re.compile(r"(?<![\w.'])(\d+\.\d*(?:e[-+]?\d+)?|\d+e[-+]?\d+|\d[\d']*|true|false)(?![\w.'])")
STATEMENT = re.compile(r"^(?:(?:if|for|while) \(.*\) )?(?:else )?((?:return|break|continue)|[\w:.\->\[\]()*]+ (?:[-+*/|&]?=) .*|(?:\+\+|--)[\w.\->]+|[\w:.\->]+\(.*\));$")


def blanked(text):
    """The text with comments, strings and preprocessor lines as spaces: places stay what they were."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?:.*?)\)"|"(?:\\.|[^"\\\n])*"|(?<![\da-fA-F])\'(?:\\.|[^\'\\\n])*\'|^[ \t]*#[^\n]*', re.S | re.M)
    return pattern.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text)


def faults_of(path, text):
    """Every single fault of one file: (kind, begin, end, replacement)."""
    bare = blanked(text)
    found = []
    for m in OPERATOR.finditer(bare):
        sign = m.group()
        line = bare[bare.rfind("\n", 0, m.start()) + 1:m.start()]
        if sign in COMPARISONS and not ("template" in line):
            found.append(("comparison", m.start(), m.end(), COMPARISONS[sign]))
        elif sign in SIGNS and not (sign in ("+", "+=") and '"' in (text[m.start() - 2], text[m.end() + 1])):  # texts have no difference
            found.append(("sign", m.start(), m.end(), SIGNS[sign]))
    for m in UNARY.finditer(bare):
        found.append(("sign" if m.group() == "-" else "comparison", m.start(), m.end(), ""))
    for m in CONSTANT.finditer(bare):
        number = m.group().replace("'", "")
        if number in ("true", "false"):
            new = "false" if number == "true" else "true"
        elif number.isdigit():
            new = str(int(number) + 1)
        else:
            new = repr(float(number) * 1.5) if float(number) else "1.0"
        found.append(("constant", m.start(), m.end(), new))
    at = 0
    for line in bare.split("\n"):
        begin = at + len(line) - len(line.lstrip())
        at += len(line) + 1
        m = STATEMENT.match(line.strip())
        if m and not m.group(1).startswith(("static_assert", "using", "namespace")):
            found.append(("statement", begin + m.start(1), begin + len(line.strip()), ";"))
    return [(path, *fault) for fault in found]


def draw(folders, seed):
    """All faults of the folders in an order that the seed gives, the four kinds in turn. Where a fault stands in it hangs on its own line alone
    (and on how often that line stands in its file before), so that a draw stays what it was but for the lines that have changed."""
    kinds = {"comparison": [], "sign": [], "constant": [], "statement": []}
    for folder in folders:
        place = ROOT / folder
        files = [place] if place.is_file() else sorted(p for p in place.rglob("*") if p.suffix in (".cpp", ".h"))
        for file in files:
            name, text, times = str(file.relative_to(ROOT)), file.read_text(encoding="utf-8"), {}
            for fault in faults_of(name, text):
                _, kind, begin, end, new = fault
                first = text.rfind("\n", 0, begin) + 1
                words = f"{seed} {name} {kind} {begin - first} {new} {text[first:text.find(chr(10), end)]}"
                times[words] = times.get(words, 0) + 1
                kinds[kind].append((hashlib.sha256(f"{words} {times[words]}".encode()).digest(), fault))
    queues = [[fault for _, fault in sorted(faults, reverse=True)] for faults in kinds.values()]
    while any(queues):
        for queue in queues:
            if queue:
                yield queue.pop()


def describe(fault):
    path, kind, begin, end, new = fault
    text = (ROOT / path).read_text(encoding="utf-8")
    line = text.count("\n", 0, begin) + 1
    whole = text.split("\n")[line - 1].strip()
    old = " ".join(text[begin:end].split())
    return f"{path}:{line}: {kind}: {old} -> {new or 'nothing'} in: {whole}"
