"""Walks a JSON schema of resources/schemas: every object with its keys, references resolved, annotations beside a reference kept."""
from dataclasses import dataclass


@dataclass
class Key:
    path: str          # "task.tolerance", "blocks[]", "shape.*"
    name: str
    schema: dict       # resolved
    required: bool


@dataclass
class Group:
    path: str          # "" for the file itself
    schema: dict
    keys: list


def resolve(schema, root):
    if "$ref" not in schema:
        return schema
    target = root
    for part in schema["$ref"].removeprefix("#/").split("/"):
        target = target[part]
    return {**resolve(target, root), **{k: v for k, v in schema.items() if k != "$ref"}}


def object_within(schema, root):
    """The object that a key's value may be, with the end of its path: itself, an array's element, any member, or one of several forms."""
    schema = resolve(schema, root)
    if "properties" in schema:
        return schema, ""
    if isinstance(schema.get("items"), dict) and "properties" in resolve(schema["items"], root):
        return resolve(schema["items"], root), "[]"
    if isinstance(schema.get("additionalProperties"), dict) and "properties" in resolve(schema["additionalProperties"], root):
        return resolve(schema["additionalProperties"], root), ".*"
    for form in schema.get("anyOf", []):
        if "properties" in resolve(form, root):
            return resolve(form, root), ""
    return None, ""


def groups(root):
    """Every object of the file, outer ones first."""
    found = []

    def walk(path, schema):
        required = schema.get("required", [])
        keys = [Key(f"{path}.{name}".lstrip("."), name, resolve(value, root), name in required)
                for name, value in schema["properties"].items()]
        found.append(Group(path, schema, keys))
        for key in keys:
            inner, ending = object_within(key.schema, root)
            if inner is not None:
                walk(key.path + ending, inner)

    walk("", root)
    return found


def holds_numbers(schema, root):
    schema = resolve(schema, root)
    kind = schema.get("type")
    kinds = kind if isinstance(kind, list) else [kind]
    if "number" in kinds or "integer" in kinds:
        return True
    items = schema.get("items")
    return isinstance(items, dict) and holds_numbers(items, root)


def gaps(root):
    """What a schema leaves unsaid about its keys: a list of sentences."""
    missing = []
    for group in groups(root):
        for key in group.keys:
            inner, _ = object_within(key.schema, root)
            if not key.schema.get("description"):
                missing.append(f"{key.path}: no description")
            if not key.required and "default" not in key.schema and "default_text" not in key.schema:
                missing.append(f"{key.path}: neither required nor with a default")
            if holds_numbers(key.schema, root) and "unit" not in key.schema:
                missing.append(f"{key.path}: a number without unit")
            if inner is None and not key.schema.get("examples"):
                missing.append(f"{key.path}: no example")
    return missing
