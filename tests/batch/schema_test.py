"""The example manifests obey manifests/shoal.schema.json, and mistakes do not.

    schema_test.py MANIFESTS_FOLDER
"""

import copy
import json
import pathlib
import sys
import unittest

import jsonschema
import yaml

MANIFESTS = pathlib.Path(sys.argv.pop())
SCHEMA = json.loads((MANIFESTS / "shoal.schema.json").read_text())
VALIDATOR = jsonschema.validators.validator_for(SCHEMA)(SCHEMA)

RIGHT = """
shoal: 1
vars: {library: /data, stops: 2}
defaults:
panoramas:
  - {files: ["${library}/*.hdr", x.exr], exclude: "*_t*", tags: [a], degree: "${degree}"}
  - {file: a.hdr, name: key, exposure: "${stops}", frame: {center: +z, right: -x, up: +y}}
variants: {plain: , dark: {exposure: -2}}
quantities: irradiance
maps: [{kind: radiance, layout: cube, size: 32}, {kind: irradiance, size: [64, 32]}]
"""

# What is put where into the right manifest to make it wrong.
MISTAKES = {
    "no version": (("shoal",), None),
    "other version": (("shoal",), 2),
    "unknown key": (("outptu",), "out"),
    "later key": (("exports",), ["three"]),
    "degree too high": (("panoramas", 1, "degree"), 65),
    "degree not whole": (("panoramas", 1, "degree"), 2.5),
    "degree a word": (("panoramas", 1, "degree"), "two"),
    "unknown quadrature": (("defaults",), {"quadrature": "texle"}),
    "file in defaults": (("defaults",), {"file": "a.hdr"}),
    "neither file nor files": (("panoramas", 1, "file"), None),
    "file and files": (("panoramas", 1, "files"), "*.hdr"),
    "name of many": (("panoramas", 0, "name"), "a"),
    "scale zero": (("panoramas", 1, "scale"), 0),
    "white of two": (("panoramas", 1, "white"), [1, 1]),
    "matrix of two rows": (("panoramas", 1, "matrix"), [[1, 0, 0], [0, 1, 0]]),
    "frame without up": (("panoramas", 1, "frame", "up"), None),
    "lights": (("panoramas", 1, "lights"), []),
    "degree in a variant": (("variants", "dark", "degree"), 3),
    "dot in a variant's name": (("variants", "a.b"), {}),
    "quantity twice": (("quantities",), ["radiance", "radiance"]),
    "no tables": (("tables",), []),
    "map without kind": (("maps", 0, "kind"), None),
    "map of size 0": (("maps", 0, "size"), 0),
    "map of three sizes": (("maps", 1, "size"), [1, 2, 3]),
}


def with_change(manifest, path, value):
    changed = copy.deepcopy(manifest)
    place = changed
    for key in path[:-1]:
        place = place[key]
    if value is None:
        del place[path[-1]]
    else:
        place[path[-1]] = value
    return changed


class SchemaTest(unittest.TestCase):
    def test_schema_is_one(self):
        type(VALIDATOR).check_schema(SCHEMA)

    def test_examples(self):
        examples = sorted(MANIFESTS.glob("*.yaml"))
        self.assertGreaterEqual(len(examples), 2)
        for example in examples:
            with self.subTest(example.name):
                VALIDATOR.validate(yaml.safe_load(example.read_text()))

    def test_right(self):
        VALIDATOR.validate(yaml.safe_load(RIGHT))

    def test_mistakes(self):
        right = yaml.safe_load(RIGHT)
        for name, (path, value) in MISTAKES.items():
            with self.subTest(name):
                self.assertFalse(VALIDATOR.is_valid(with_change(right, path, value)))


if __name__ == "__main__":
    unittest.main()
