#!/usr/bin/env python3
"""Writes docs/reference/*.md from resources/schemas/*.schema.json; with --check only says which pages are not up to date (exit 1).

A schema that leaves a key without meaning, unit, default or example is refused."""
import json
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from schema_keys import gaps, groups, object_within, resolve  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
PAGES = {  # schema: its whole example
    "experiment": "resources/experiments/chain-moderate.json",
    "plan": "resources/plans/paper.json",
    "definition": "constraints/definitions/torus.json",
    "study": "resources/studies/stiffness.json",
}


def value(json_value):
    return "`" + json.dumps(json_value, ensure_ascii=False) + "`"


def kind(schema, root):
    schema = resolve(schema, root)
    if "enum" in schema:
        return ", ".join(value(v) for v in schema["enum"])
    if "anyOf" in schema:
        return "; or ".join(kind(form, root) for form in schema["anyOf"])
    names = schema.get("type", "any")
    names = names if isinstance(names, list) else [names]
    return " or ".join(kind_of(name, schema, root) for name in names)


def kind_of(name, schema, root):
    if name in ("number", "integer"):
        return ("whole number" if name == "integer" else "number") + limits(schema)
    if name == "array":
        few, many = schema.get("minItems"), schema.get("maxItems")
        count = "" if few is None and many is None else f"{few} " if few == many else f"{few or 0} to {many} " if many else f"{few} or more "
        items = schema.get("items")
        inner = kind(items, root) if isinstance(items, dict) else ""
        if "properties" in (resolve(items, root) if isinstance(items, dict) else {}):
            inner = "object"
        return f"array, {count}× {inner}" if count and inner else f"array of {inner}" if inner else f"array of {count.strip()}" if count else "array"
    if name == "object" and isinstance(schema.get("additionalProperties"), dict):
        return "object, names as you like"
    return {"boolean": "`true`, `false`", "string": "text", "null": "`null`"}.get(name, name)


def limits(schema):
    low = f"> {schema['exclusiveMinimum']}" if "exclusiveMinimum" in schema else f"≥ {schema['minimum']}" if "minimum" in schema else ""
    high = f"≤ {schema['maximum']}" if "maximum" in schema else ""
    said = ", ".join(part for part in (low, high) if part)
    return " " + said if said else ""


def default(key):
    if key.required:
        return "**required**"
    return key.schema["default_text"] if "default_text" in key.schema else value(key.schema["default"])


def row(key, root):
    inner, ending = object_within(key.schema, root)
    below = f" [Its keys](#{anchor(key.path + ending)})." if inner is not None else ""
    examples = " ".join(value(v) for v in key.schema.get("examples", []))
    cells = [f"`{key.name}`", key.schema["description"] + below, key.schema.get("unit", ""), default(key), kind(key.schema, root), examples]
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def anchor(path):
    """As Markdown makes it of the heading."""
    return re.sub(r"[^\w-]", "", path).lower()


def page(name, root, example):
    lines = [f"# {root['title'].removeprefix('Reachlab ').capitalize()} file", "",
             f"<!-- Made from resources/schemas/{name}.schema.json by packaging/manual/reference_pages.py. -->", "",
             root["description"], ""]
    for group in groups(root):
        if group.path:
            lines += [f"## {group.path}", ""]
        lines += ["| key | meaning | unit | default | allowed | example |", "|---|---|---|---|---|---|"]
        lines += [row(key, root) for key in group.keys] + [""]
    lines += ["## A whole file", "", f"`{example}`:", "", "```json", (ROOT / example).read_text().rstrip(), "```", ""]
    return "\n".join(lines)


def main():
    stale = []
    for name, example in PAGES.items():
        schema = json.loads((ROOT / f"resources/schemas/{name}.schema.json").read_text())
        unsaid = gaps(schema)
        if unsaid:
            sys.exit("\n".join(f"resources/schemas/{name}.schema.json: {line}" for line in unsaid))
        text = page(name, schema, example)
        target = ROOT / f"docs/reference/{name}.md"
        if "--check" not in sys.argv[1:]:
            target.parent.mkdir(exist_ok=True)
            target.write_text(text)
        elif not target.exists() or target.read_text() != text:
            stale.append(str(target.relative_to(ROOT)))
    if stale:
        sys.exit(f"not up to date: {', '.join(stale)}; packaging/manual/reference_pages.py writes them")


if __name__ == "__main__":
    main()
