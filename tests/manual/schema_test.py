#!/usr/bin/env python3
"""The schemas of resources/schemas against the program: schema_test.py REACH

- An unknown key put into every object of a file makes `reach validate` name the keys it knows there: exactly the schema's.
- Every example of a key, put in its place, is read; every number beyond a limit of the schema is refused, by key.
- Every shipped file satisfies its schema, and the faulty ones above do not."""
import copy
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import jsonschema

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "packaging/manual"))
from schema_keys import gaps, groups, object_within, resolve  # noqa: E402

POINT = {"schema_version": 1, "constraint": {"name": "ellipse"}, "object": {"kind": "point", "masses_kg": [1]},
         "coupling": {"stiffness_n_per_m": 600},
         "task": {"start": [0], "target": [3], "duration_s": 1, "tolerance": {"position_m": 0.01, "velocity_m_per_s": 0.01, "time_s": 1}},
         "velocity_estimator": {"kind": "auto"}, "arm": {}}
CHAIN = {**POINT, "object": {"kind": "chain", "masses_kg": [1, 1, 1], "stiffness_n_per_m": [1, 1], "damping_n_s_per_m": [0, 0]}}
BODY = {**POINT, "constraint": {"name": "free"}, "object": {"kind": "body", "masses_kg": [1], "inertia_kg_m2": [1, 1, 1]},
        "task": {**POINT["task"], "start": [0, 0, 0], "target": [0.1, 0, 0]}}
LONG = {**POINT, "object": {"kind": "chain", "masses_kg": [1] * 5, "stiffness_n_per_m": [1] * 4}, "hands": [{}, {}]}
PAIR = {**POINT, "object": {"kind": "chain", "masses_kg": [1, 1], "stiffness_n_per_m": [1]}, "hands": [{}, {}]}
HELD = {**BODY, "hands": [{}, {}]}
BARE = {**BODY, "object": {"kind": "none"}, "cursor": {}}
del BARE["coupling"]
FORCES = {"viscous": {"matrix_n_s_per_m": [[0] * 3] * 3}, "elastic": {"matrix_n_per_m": [[0] * 3] * 3},
          "joint-viscous": {"matrix_n_m_s_per_rad": [[0] * 2] * 2}, "channel": {}, "pulse": {"force_n": [1, 0, 0], "at": {"onset_s": 0}, "duration_s": 100}}
FORCED = {kind: {**POINT, "environment": [{"kind": kind, **keys}]} for kind, keys in FORCES.items()}
AT_ONCE = {**POINT, "environment": [{**FORCED["pulse"]["environment"][0], "at": {}}]}
VIEWED = {**POINT, "look": {"cameras": [{"name": "above", "position_m": [0, 0.5, 0.1], "focus_m": [0, 0, 0]}]}}
PLAN = {"schema_version": 1, "trials": 20, "blocks": [{"experiment": "chain-moderate"}]}
KINDS = {"kinds": {"plain": {}, "heavy": {"object.masses_kg[*]": 2}}, "mix": [{"kind": "plain", "count": 7}, {"kind": "heavy", "count": 1}],
         "targets": {"ring": {"count": 8}}}
MIXED = {**PLAN, "trials": 8, **KINDS, "blocks": [{"experiment": "free-point", **KINDS}]}
OF_KINDS = [level + key for level in ("", "blocks[].") for key in (
    "kinds", "mix", "mix[].kind", "mix[].count", "targets", "targets.ring", "targets.ring.count", "targets.ring.radius_m", "targets.ring.first_deg",
    "order", "not_first", "not_twice", "return")]
CURVE = {"schema_version": 1, "name": "x", "kind": "curve", "curve": ["a_m*cos(phi)", "a_m*sin(phi)*cos(phi)", "0"],
         "shape": {"a_m": {"default": 0.1, "min": 0.01, "max": 1}}, "domain": [0, "2*pi"], "start": [0], "target": ["pi"]}
SURFACE = {**CURVE, "kind": "surface", "surface": ["a_m*cos(u)", "a_m*sin(u)", "a_m*v"], "domain": [[0, "2*pi"], [-1, 1]], "start": [0, 0], "target": [1, 1]}
del SURFACE["curve"]

STUDY = {"schema_version": 1, "experiment": "chain-moderate", "subjects": 2}
PLANNED_STUDY = {"schema_version": 1, "subjects": 2}

BASES = {"experiment": POINT, "plan": PLAN, "definition": CURVE, "study": STUDY}
# Where a key or one of its examples needs another neighbourhood than the base file's: path, example or None for every one.
NEIGHBOURS = {
    ("shape.*.whole", None): {**CURVE, "shape": {"a_m": {"default": 1, "min": 1, "max": 2}}},
    ("object.kind", None): CHAIN, ("object.masses_kg", None): CHAIN, ("object.stiffness_n_per_m", None): CHAIN,
    ("object.damping_n_s_per_m", None): CHAIN, ("object.inertia_kg_m2", None): BODY, ("object.fp_offset_m", None): BODY,
    ("constraint.name", None): {**POINT, "task": {**POINT["task"], "start": [0, 0.5], "target": [1, 2]}},
    ("constraint.curve", None): {**POINT, "constraint": {"shape": {"a": 0.1, "b": 0.06}}},
    ("constraint.surface", None): {**POINT, "constraint": {}, "task": {**POINT["task"], "start": [-1, 0], "target": [1, 0]}},
    ("constraint.shape", None): {**POINT, "constraint": {"name": "torus"}, "task": {**POINT["task"], "start": [0, 0.5], "target": [1, 2]}},
    ("hands[].mass", None): LONG, ("hands[].stiffness_n_per_m", None): PAIR, ("hands[].damping_n_s_per_m", None): LONG,
    ("hands[].fp_offset_m", None): HELD,
    **{(f"look.cameras[].{key}", None): VIEWED for key in ("name", "position_m", "focus_m", "up", "angle_deg", "parallel")},
    **{(f"environment[].{key}", None): FORCED[kind] for kind, keys in {
        "viscous": ["matrix_n_s_per_m"], "elastic": ["matrix_n_per_m", "centre_m", "when"], "joint-viscous": ["matrix_n_m_s_per_rad"],
        "channel": ["stiffness_n_per_m", "damping_n_s_per_m", "half_width_m", "ramp_s", "break_m"],
        "pulse": ["force_n", "duration_s", "rise_s"]}.items() for key in keys},
    ("environment[].kind", None): FORCED["viscous"],
    ("environment[].at.onset_s", None): AT_ONCE, ("environment[].at.distance_m", None): AT_ONCE,
    **{(f"cursor.{key}", None): BARE for key in ("rotation_deg", "gain", "clamp_deg", "delay_s", "show", "judge")},
    ("surface", None): SURFACE, ("domain", "[[0, \"2*pi\"], [-1, 1]]"): SURFACE, ("periodic", "[true, false]"): SURFACE,
    ("plan", None): PLANNED_STUDY,
    **{(path, None): MIXED for path in OF_KINDS},
    ("blocks[].change", None): {**PLAN, "blocks": [{"experiment": "chain-moderate", "condition": "soft"}]},
}


def put(tree, path, value):
    """`tree` with the value at "task.tolerance.time_s", "blocks[].day" or "shape.*.min"."""
    tree = copy.deepcopy(tree)
    node = tree
    steps = path.replace("[]", ".0").split(".")
    for step in steps[:-1]:
        node = node[0] if isinstance(node, list) else node[next(iter(node))] if step == "*" else node.setdefault(step, {})
    node[steps[-1]] = value
    return tree


def beyond(schema, root):
    """Values just past each limit of a number, or of an array's numbers."""
    schema = resolve(schema, root)
    if isinstance(schema.get("items"), dict):
        count = schema.get("minItems", 2)
        return [[v] * count for v in beyond(schema["items"], root)]
    low = [schema["exclusiveMinimum"]] if "exclusiveMinimum" in schema else [schema["minimum"] - max(1e-9, 1e-9 * abs(schema["minimum"]))] if "minimum" in schema else []
    high = [schema["maximum"] * (1 + 1e-9) + 1] if "maximum" in schema else []
    return low + high


class SchemaTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.schemas = {name: json.loads((ROOT / f"resources/schemas/{name}.schema.json").read_text()) for name in BASES}
        cls.folder = tempfile.TemporaryDirectory()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def validate(self, trees):
        """What `reach validate` says of each: an empty text when it is fine. One call for all."""
        files = []
        for i, tree in enumerate(trees):
            files.append(Path(self.folder.name) / f"{i}.json")
            files[-1].write_text(json.dumps(tree))
        done = subprocess.run([REACH, "validate", *map(str, files)], capture_output=True, text=True, check=False)
        fine = {line.removesuffix(": fine") for line in done.stdout.splitlines()}
        said = [[] for _ in files]
        lines = None  # of the error that is being told; a warning is none
        for line in done.stderr.splitlines():
            for i, file in enumerate(files):
                if line.startswith(f"{file}:"):
                    lines = said[i] if ": error: " in line else None
            if lines is not None:
                lines.append(line)
        for i, file in enumerate(files):
            self.assertNotEqual(str(file) in fine, bool(said[i]), f"{file}: {trees[i]}\n{done.stderr}")
        return ["\n".join(lines) for lines in said]

    def base(self, name, path, example=None):
        return NEIGHBOURS.get((path, json.dumps(example)), NEIGHBOURS.get((path, None), BASES[name]))

    def test_every_key_is_explained(self):
        for name, schema in self.schemas.items():
            self.assertEqual(gaps(schema), [], name)

    def test_a_gap_is_found(self):
        schema = {"properties": {"x_m": {"type": "number"}}}
        self.assertEqual(len(gaps(schema)), 4)

    def test_the_program_knows_the_keys_of_the_schema(self):
        for name, schema in self.schemas.items():
            for group in groups(schema):
                place = (group.path + "." if group.path else "") + "zz"
                of_kinds = name == "plan" and any(path.startswith(group.path) for path in OF_KINDS) and group.path not in ("", "blocks[]")
                base = [MIXED] if of_kinds else {"object": [BODY], "hands[]": [HELD], "look.cameras[]": [VIEWED], "cursor": [BARE], "environment[]": FORCED.values(),
                        "environment[].at": [AT_ONCE]}.get(group.path, [BASES[name]]) if name == "experiment" else [BASES[name]]
                known = set()
                for tree in (put(of, place, 1) for of in base):
                    said = self.validate([tree])[0]
                    named = re.search(r"zz: is not known here\n.*\n.*\nhelp: (?:did you mean [^?]*\? )?[Aa]llowed: (.*)", said)
                    self.assertTrue(named, f"{name} {place}: {said}")
                    known |= set(re.split(r", | or ", named[1]))
                    self.assertFalse(self.satisfies(name, tree), f"{name} {place}")
                self.assertEqual(known, {key.name for key in group.keys}, f"{name}: {group.path or 'the file'}")

    def test_every_example_is_read(self):
        for name, schema in self.schemas.items():
            cases = [(key.path, put(self.base(name, key.path, example), key.path, example))
                     for group in groups(schema) for key in group.keys for example in key.schema.get("examples", [])]
            for (path, tree), said in zip(cases, self.validate([tree for _, tree in cases])):
                faults = [line for line in said.splitlines() if ": error: " in line]
                self.assertEqual(faults, [], f"{name} {path}: {tree}")
                self.assertTrue(self.satisfies(name, tree), f"{name} {path}: {tree}")

    def test_every_limit_holds(self):
        for name, schema in self.schemas.items():
            cases = [(key.path, put(self.base(name, key.path), key.path, value))
                     for group in groups(schema) for key in group.keys
                     if object_within(key.schema, schema)[0] is None for value in beyond(key.schema, schema)]
            self.assertGreater(len(cases), 5 if name != "definition" else -1)
            for (path, tree), said in zip(cases, self.validate([tree for _, tree in cases])):
                self.assertIn(path.split(".")[-1], said, f"{name} {path}: {tree}")
                self.assertFalse(self.satisfies(name, tree), f"{name} {path}: {tree}")

    def test_shipped_files_satisfy_their_schema(self):
        folders = {"experiment": "resources/experiments", "plan": "resources/plans", "definition": "constraints/definitions", "study": "resources/studies"}
        for name, folder in folders.items():
            files = sorted((ROOT / folder).glob("*.json"))
            self.assertTrue(files)
            for file in files:
                text = re.sub(r"(?m)^\s*//.*$", "", file.read_text())
                self.assertTrue(self.satisfies(name, json.loads(text)), file)

    def satisfies(self, name, tree):
        return jsonschema.Draft7Validator(self.schemas[name]).is_valid(tree)


if __name__ == "__main__":
    REACH = sys.argv.pop(1)
    unittest.main()
