#!/usr/bin/env python3
"""How plain the prose is: words a sentence, long sentences, clauses without a noun and semicolons, in README, manual, changelog, decision records
and header comments.

  tests/house/prose.py                  prints the table; exits 1 where a limit is exceeded
  tests/house/prose.py --pages          also one line for each page
  tests/house/prose.py --show PAGE      prints the long sentences and the clauses without a noun of one file
  tests/house/prose.py --self-test      checks that the measure finds its examples

Tables, listings, headings and marks are left out. A formula, a piece of code and a link count as the words that a reader sees. A list item without
a full stop is a sentence. A clause without a noun is one whose subject or object is only a word that points: what, who, none, one, the other."""
import re
import sys
from pathlib import Path

from self_test import judges_wrongly

ROOT = Path(__file__).resolve().parents[2]
LONG = 25
MOST_WORDS = 32000  # README, manual and theory together
# share of long sentences, clauses without a noun and semicolons for each 1000 words
LIMITS = {"README": (0.12, 1.5, 2), "manual": (0.12, 1.5, 3), "changelog": (0.15, 1.5, 4), "decisions": (0.15, 1.5, 4), "headers": (0.12, 1.5, 4)}
FEW = 3  # clauses or semicolons are allowed in any text, however short
HEADERS = ["analysis", "base", "bench", "cli", "constraints", "devices", "gui", "network", "sim"]
VERB = (r"(?:is|are|was|were|has|have|had|does|do|did|can|cannot|could|may|might|must|should|will|would|stands|stays|goes|comes|takes|gives|makes|holds|needs|"
        r"asks|knows|says|gets|begins|becomes|leads|moves|works|means|wins|answers|wants|feels|appears|waits|adds|falls|keeps)")
STOP = r"(?=\s*(?:[.,:;!?)—–]|$))"
NOUNLESS = [re.compile(pattern, re.I) for pattern in (
    r"(?<!\w)what\b(?! (?:time|kind|number|value|happens)\b)",
    r"(?:^|[.,;:(—–] ?|\b(?:and|or|but|for|to|of|by|with|from|that|than|as|is|are|if|asks|tells|says|knows?) )who(?:ever|m)?\b",
    r"(?<!\w)none\b(?! of the \w)",
    rf"(?<!one )\b(?:another|the others?|the former|the latter|the first|the second|the last|neither)\b(?: {VERB}\b|{STOP})",
    rf"(?<!no )\bones?\b(?: {VERB}\b|{STOP})",
    rf"\b(?:no|an?|the|each|every|another) \w+'s\b(?: {VERB}\b|{STOP})",
    r"\bthose (?:that|who|which)\b",
    r"\bthat which\b",
    rf"(?:^|[.;:] )(?:more|less|most|few|fewer|some|many|all|such|so|nothing else|any)\b (?:{VERB})\b",
    r"\bof (?:its|their) own\b|\bin words\b",
)]


def readable(text):
    """A line of Markdown or of a comment as it is read."""
    text = re.sub(r"!\[[^\]]*\]\([^)]*\)", "", text)
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"`[^`]*`|\$[^$]+\$", "Code", text)
    return re.sub(r"\*\*|(?<!\w)[*_](?=\w)|(?<=\w)[*_](?!\w)", "", text)


def markdown(text):
    """Paragraphs and list items."""
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    text = re.sub(r"^(`{3,}).*?^\1\s*$", "", text, flags=re.S | re.M)
    text = re.sub(r"^\$\$.*?^\$\$", "", text, flags=re.S | re.M)
    block = []
    for line in [*text.splitlines(), ""]:
        item = re.match(r"\s*(?:[-*]|\d+\.) (.*)", line)
        table = line.lstrip().startswith(("|", "#", ">", "!["))
        listing = line.startswith("    ") and not block
        if item or table or listing or not line.strip():
            if block:
                yield " ".join(block)
            block = [item[1]] if item else []
        else:
            block.append(line.strip())


def comments(text):
    """Comment paragraphs of a header. Lines that begin with two spaces are formulas and lists."""
    block = []
    for line in [*text.splitlines(), ""]:
        found = re.match(r"\s*///? ?(\s*)(.*)", line) or re.match(r"(?!\s*#).*;\s*// (\s*)(.*)", line)
        if found and found[2] and len(found[1]) < 2 and re.match(r"\s*//", line):
            block.append(found[2])
            continue
        if block:
            yield " ".join(block)
        block = []


def sentences(paragraph):
    text = readable(paragraph)
    for part in re.split(r"(?<=[.!?])\)?\s+(?=[A-Z`(*0-9Δεωφ])", text):
        words = re.findall(r"[\w'’°%./+-]*[A-Za-z0-9ÄÖÜäöüΔεωφλ][\w'’°%./+-]*", part)
        if len(words) > 1:
            yield part.strip(), len(words)


def nounless(sentence):
    if sentence.rstrip().endswith("?"):
        return []
    found = {}
    for pattern in NOUNLESS:
        for match in pattern.finditer(sentence):
            found[match.start()] = match.group().strip(" ,.;:(")
    return list(found.values())


def measure(paragraphs):
    count = {"words": 0, "sentences": 0, "long": 0, "nounless": 0, "semicolons": 0}
    for paragraph in paragraphs:
        for sentence, words in sentences(paragraph):
            count["words"] += words
            count["sentences"] += 1
            count["long"] += words > LONG
            count["nounless"] += len(nounless(sentence))
            count["semicolons"] += sentence.count(";")
    return count


def groups():
    manual = [p for p in sorted((ROOT / "docs").rglob("*.md")) if p.parent.name not in ("adr", "reference", "benchmarks")]
    return {"README": [ROOT / "README.md"], "manual": manual, "changelog": [ROOT / "CHANGELOG.md"], "decisions": sorted((ROOT / "docs/adr").glob("0*.md")),
            "headers": [f for top in HEADERS for f in sorted((ROOT / top).rglob("*.h"))]}


def paragraphs_of(file):
    return (comments if file.suffix == ".h" else markdown)(file.read_text())


def line_of(name, count):
    words, per = count["words"] or 1, 1000 / (count["words"] or 1)
    share = count["long"] / (count["sentences"] or 1)
    return f"{name:44} {words:6} {words / (count['sentences'] or 1):5.1f} {100 * share:5.0f} % {count['nounless'] * per:6.1f} {count['semicolons'] * per:6.1f}"


def self_test():
    """The examples of the style guide and of headers as they once were."""
    said = ["What is no hand's stands with the first.", "Who trusts the senses more, answers sooner.", "What holds a hand is said in words.", "A list of keys, and none is there.",
            "The next one is taken.", "It is drawn by who asks for it.", "A trial that is none.", "Channels that are no hand's stand with the first."]
    silent = ["Channels that belong to no single hand are listed under the first hand.", "You can run the block even if the timing check fails.",
              "A person who holds a device feels the object.", "error: run 1 already exists.", "Each trial is judged.", "What is verified?", "One mass hangs on one spring."]
    return judges_wrongly("prose.py", nounless, said, silent)


def show(file):
    for paragraph in paragraphs_of(file):
        for sentence, words in sentences(paragraph):
            found = nounless(sentence)
            if words > LONG or found or ";" in sentence:
                print(f"{words:3} {', '.join(found):30} {sentence}")


def main():
    if (wrong := self_test()) or "--self-test" in sys.argv:
        return wrong
    if "--show" in sys.argv:
        return show(Path(sys.argv[-1]).resolve())
    print(f"{'':44} {'words':>6} {'a sent.':>5} {'>25':>5}  {'no noun':>6} {'semicolons':>6}")
    failed, total = [], 0
    for name, files in groups().items():
        count = {}
        for file in files:
            one = measure(paragraphs_of(file))
            if "--pages" in sys.argv and file.suffix == ".md":
                print(line_of(f"  {file.relative_to(ROOT)}", one))
            count = {key: count.get(key, 0) + value for key, value in one.items()}
        print(line_of(name, count))
        total += count["words"] if name in ("README", "manual") else 0
        long, bare, semicolons = LIMITS[name]
        few = lambda limit: max(limit * count["words"] / 1000, FEW)
        if count["long"] > long * count["sentences"] or count["nounless"] > few(bare) or count["semicolons"] > few(semicolons):
            failed.append(f"{name}: at most {100 * long:.0f} % long sentences, {bare} clauses without a noun and {semicolons} semicolons for each 1000 words")
    if total > MOST_WORDS:
        failed.append(f"README and manual have {total} words of prose, at most {MOST_WORDS}")
    print("\n".join(failed), end="\n" if failed else "")
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main())
