"""What the manifest's schema, its README, `shoal --help` and the project's README tell agrees."""

import json
import pathlib
import re

import support
from support import ShoalTest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCHEMA = json.loads((ROOT / "manifests" / "shoal.schema.json").read_text())
KEYS = (ROOT / "manifests" / "README.md").read_text()
README = (ROOT / "README.md").read_text()

# What the README's list of features says of a key, where it uses other words than the key itself.
FEATURES = {
    "layout": "every layout", "lights": "lights:", "sky": "sky:", "picture": "picture:",
    "rotate": "rotate:", "views": "views:", "mirror": "mirror:", "window": "window:", "sun": "sun:",
    "dominant": "dominant:", "clamp": "clamp:", "quality": "quality:", "exports": "exports:",
    "frame": "frame", "tables": "tables", "maps": "maps",
}


def keys_of(name):
    return set(SCHEMA["$defs"][name]["properties"])


def words_of(text):
    return set(re.findall(r"[a-z_]+", text))


def all_keys():
    return set(SCHEMA["properties"]) | keys_of("panorama") | keys_of("variant") | keys_of("defaults")


def values_of(name):
    """The words that a key takes, and the keys of its mappings."""
    found = set()
    for one in SCHEMA["$defs"][name]["anyOf"]:
        found |= set(one.get("enum", [])) | set(one.get("properties", {}))
    return found


class Documentation(ShoalTest):
    def test_help_names_every_key(self):
        words = words_of(self.expect(0, "--help").out)
        self.assertEqual(all_keys() - words, set())
        self.assertEqual(keys_of("light") - words, set())
        self.assertEqual(values_of("window") - words, {"none"})

    def test_the_manifests_readme_tells_every_key(self):
        for key in all_keys() | keys_of("light") | keys_of("map") | keys_of("export"):
            self.assertIn(f"`{key}`", KEYS)

    def test_the_manifests_readme_tells_every_value(self):
        for name in ("layout", "window", "dominant", "quadrature", "nonfinite", "negative"):
            told = {word for word in values_of(name) if f"`{word}`" in KEYS}
            self.assertEqual(values_of(name) - told, set(), name)

    def test_the_readme_lists_the_features(self):
        features = README[README.index("## What it does"):README.index("## Seeing the light")]
        for key, words in FEATURES.items():
            self.assertIn(key, all_keys())
            self.assertIn(words, features, key)

    def test_the_readme_names_every_command(self):
        listed = README[README.index("## The command line"):README.index("## The mathematics")]
        help_text = self.expect(0, "--help").out
        commands = help_text[help_text.index("Subcommands"):].split("\n\n")[0]
        names = re.findall(r"^  ([a-z]+)  ", commands, re.M)
        self.assertIn("project", names)
        for name in names:
            self.assertIn(f"\nshoal {name} ", listed)

    def test_profiles_are_told_in_their_readme(self):
        text = (ROOT / "manifests" / "profiles" / "README.md").read_text()
        lines = self.expect(0, "profiles").out.splitlines()[1:]
        self.assertGreater(len(lines), 20)
        for line in lines:
            self.assertIn(f"`{line.split()[0]}`", text)


if __name__ == "__main__":
    support.main()
