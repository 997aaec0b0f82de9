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
defaults: {quality: 20}
tables: [csv, quality]
panoramas:
  - {files: ["${library}/*.hdr", x.exr], exclude: "*_t*", tags: [a], degree: "${degree}"}
  - {file: a.hdr, name: key, exposure: "${stops}", frame: {center: +z, right: -x, up: +y}, rotate: {yaw: 90}}
  - {file: ball.exr, layout: mirror-ball, mirror: left-right, sun: {top: 0.001, action: replace}, clamp: {percentile: 99.9}}
  - name: lamp
    window: auto
    lights: [{disk: {direction: [0, 0, 1], radius: 10, radiance: 5}}, {ambient: {radiance: [1, 1, 1]}}]
  - {name: noon, sky: {turbidity: 3, sun: {elevation: 55, azimuth: "${east}"}, ground: [0.2, 0.3, 0.1], size: [64, 32]}}
  - {name: dusk, sky: {sun: {elevation: 1}}, lights: [{ambient: {radiance: 1}}], picture: {format: hdr}}
variants: {plain: , dark: {exposure: -2, window: {hann: 4}}, set: {views: {count: 8, over: all}}, four: {views: 4}}
quantities: irradiance
exports: [three, {profile: gltf, options: {convolved: "no"}, frame: "+z,-x,+y", suffix: raw}]
maps: [{kind: radiance, layout: cube, size: 32}, {kind: irradiance, size: [64, 32]}]
"""

# What is put where into the right manifest to make it wrong.
MISTAKES = {
    "no version": (("shoal",), None),
    "other version": (("shoal",), 2),
    "unknown key": (("outptu",), "out"),
    "export of nothing": (("exports",), [{"suffix": "a"}]),
    "unknown key of an export": (("exports", 1, "quantity"), "radiance"),
    "degree too high": (("panoramas", 1, "degree"), 65),
    "degree not whole": (("panoramas", 1, "degree"), 2.5),
    "quality too high": (("defaults", "quality"), 65),
    "no such table": (("tables",), ["figures"]),
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
    "lights without a name": (("panoramas", 3, "name"), None),
    "light of two kinds": (("panoramas", 3, "lights", 1, "cosine"), {"direction": [0, 0, 1], "radiance": 1}),
    "disk without radius": (("panoramas", 3, "lights", 0, "disk", "radius"), None),
    "no such light": (("panoramas", 3, "lights", 0, "lamp"), {}),
    "clamp of lights": (("panoramas", 3, "clamp"), 3),
    "sun of a sky": (("panoramas", 4, "sun"), {"top": 0.001}),
    "mirrored otherwise": (("panoramas", 2, "mirror"), "up-down"),
    "sky without a name": (("panoramas", 4, "name"), None),
    "sky without a sun": (("panoramas", 4, "sky", "sun"), None),
    "sun without elevation": (("panoramas", 4, "sky", "sun", "elevation"), None),
    "sun below the horizon": (("panoramas", 4, "sky", "sun", "elevation"), -3),
    "sky too clear": (("panoramas", 4, "sky", "turbidity"), 1.5),
    "albedo above 1": (("panoramas", 4, "sky", "ground"), 1.5),
    "sky in a file": (("panoramas", 1, "sky"), {"sun": {"elevation": 3}}),
    "picture of a file": (("panoramas", 1, "picture"), {}),
    "png picture": (("panoramas", 5, "picture", "format"), "png"),
    "sky in defaults": (("defaults",), {"sky": {"sun": {"elevation": 3}}}),
    "axis without angle": (("panoramas", 1, "rotate"), {"axis": [0, 0, 1]}),
    "two rotations in one": (("panoramas", 1, "rotate"), {"yaw": 1, "quaternion": [1, 0, 0, 0]}),
    "percentile too low": (("panoramas", 1, "clamp"), {"percentile": 98}),
    "sun of neither": (("panoramas", 1, "sun"), {"action": "keep"}),
    "sun of both": (("panoramas", 1, "sun"), {"top": 0.001, "above": 3}),
    "sun too large": (("panoramas", 1, "sun"), {"top": 0.1}),
    "no such action": (("panoramas", 1, "sun"), {"top": 0.001, "action": "hide"}),
    "no such part": (("variants", "dark", "dominant"), "none"),
    "no such window": (("panoramas", 3, "window"), "hanning"),
    "views in an entry": (("panoramas", 1, "views"), 3),
    "views without count": (("variants", "set"), {"views": {"over": "all"}}),
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
