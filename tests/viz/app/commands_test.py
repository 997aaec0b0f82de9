"""shoal render and report: which files they write, and what they say where they cannot."""

import csv
import json
import os
import pathlib
import re
import unittest

import support
from support import ShoalTest, write_hdr

PNG = b"\x89PNG\r\n\x1a\n"


class Commands(ShoalTest):
    def make_output(self, more=""):
        self.make_library(3)
        self.write_manifest(more)
        self.expect(0, "run", "m.yaml")

    def render(self, status, *arguments):
        """With as little to draw as there can be; no display, ever."""
        return self.expect(status, "render", *arguments, "--size", "128x96", "--way", "surfaceless")

    def assert_pictures(self, *names):
        for name in names:
            self.assertTrue((self.folder / name).read_bytes().startswith(PNG), name)


class Rendering(Commands):
    def test_one_picture(self):
        self.make_output()
        done = self.render(0, "out", "--panorama", "p01", "-o", "a.png")
        self.assertEqual((done.out, done.err), ("a.png\n", ""))
        self.assert_pictures("a.png")
        before = (self.folder / "a.png").read_bytes()
        self.render(0, "out", "--panorama", "p01", "-o", "a.png")
        self.assertEqual((self.folder / "a.png").read_bytes(), before)

    def test_a_picture_each(self):
        self.make_output("variants: {plain: {}, dark: {exposure: -2}}\n")
        done = self.render(0, "out", "--panorama", "p0[12]", "-o", "shots/")
        names = [f"shots/{name}.png" for name in ("p01", "p01.dark", "p02", "p02.dark")]
        self.assertEqual(done.out.splitlines(), names)
        self.assert_pictures(*names)
        # A name has all variants; one of them is named with it.
        for pattern, *names in (("p01", "p01", "p01.dark"), ("p01.*", "p01", "p01.dark"), ("p01.plain", "p01"),
                                ("*plain", "p00", "p01", "p02"), ("*1.dark", "p01.dark")):
            done = self.render(0, "out", "--panorama", pattern, "-o", "n-{name}.png")
            self.assertEqual(done.out.splitlines(), [f"n-{name}.png" for name in names], pattern)
        done = self.render(2, "out", "-o", "one.png")
        self.assertIn("one file for 6 pictures", done.err)
        self.assertIn("-o DIR/", done.err)
        self.assertFalse((self.folder / "one.png").exists())

    def test_straight_from_files_with_names_that_lead_out(self):
        write_hdr(self.folder / "a/x.hdr", 1)
        write_hdr(self.folder / "b/x.hdr", 2)
        done = self.render(0, "a/x.hdr", "a/../b/x.hdr", "-o", "shots/")
        self.assertEqual(done.out.splitlines(), ["shots/a/x.hdr.png", "shots/a/__/b/x.hdr.png"])

    def test_pages_of_a_contact_sheet(self):
        self.make_output()
        contact = ("out", "--scene", "contact", "--grid", "1x2")
        self.assertEqual(self.render(0, *contact, "-o", "sheet-{page}.png").out,
                         "sheet-001.png\nsheet-002.png\n")
        self.assertEqual(self.render(0, *contact, "--page", "2", "-o", "two.png").out, "two.png\n")
        self.assertEqual((self.folder / "two.png").read_bytes(), (self.folder / "sheet-002.png").read_bytes())
        self.assertIn("2 pages", self.render(2, *contact, "--page", "3", "-o", "x.png").err)
        self.assertIn("{page}", self.render(2, *contact, "-o", "x.png").err)

    def test_meshes(self):
        self.make_output()
        for name, mark in (("a.glb", b"glTF"), ("a.gltf", b"{"), ("a.vtp", b"<")):
            self.assertEqual(self.render(0, "out", "--panorama", "p00", "-o", name).out, name + "\n")
            self.assertTrue((self.folder / name).read_bytes().startswith(mark), name)
        self.render(0, "out", "--format", "glb", "-o", "meshes/")
        self.assertEqual(len(list((self.folder / "meshes").glob("*.glb"))), 3)
        self.assertIn("only the scene lobes", self.render(2, "out", "--scene", "basis", "-o", "b.glb").err)

    def test_the_basis_needs_no_library(self):
        self.assertEqual(self.render(0, "--scene", "basis", "--degree", "1", "-o", "b.png").out, "b.png\n")
        self.assertIn("OUT is missing", self.render(2, "-o", "b.png").err)

    def test_less_than_the_degree_asked_for_is_told(self):
        self.make_output()
        self.assertEqual(self.render(0, "out", "--panorama", "p00", "--degree", "2", "-o", "a.png").err, "")
        done = self.render(0, "out", "--panorama", "p00", "--degree", "3", "-o", "a.png")
        self.assertEqual(done.err, "warning: --degree 3: p00 ends at degree 2; all that there is is shown\n")
        done = self.render(0, "out", "--degree", "3", "-o", "all/")
        self.assertIn("--degree 3 is beyond 3 panoramas, such as p00 at 2;", done.err)

    def test_what_cannot_be_shown_is_told(self):
        self.make_library(1)
        self.write("lib/bad.hdr", "no picture")
        done = self.render(0, "lib", "-o", "a.png")
        self.assertRegex(done.err, r"^warning: bad is left out: lib/bad\.hdr: ")
        done = self.render(1, "lib", "--panorama", "bad", "-o", "b.png")
        self.assertIn("error: bad: has failed: lib/bad.hdr", done.err)
        done = self.render(1, "lib/bad.hdr", "-o", "b.png")
        self.assertIn("all of them failed", done.err)


    def test_the_frame_of_a_csv_table(self):
        """The store beside it tells its frame, --table-frame that of a table elsewhere: the picture is the same, to the
        bit, and another one where that is taken for native."""
        self.make_output("defaults: {frame: openexr}\ntables: [csv, json]\n")
        (self.folder / "out/coefficients.csv").rename(self.folder / "coefficients.csv")
        def picture(said, *arguments):
            done = self.render(0, *arguments, "--panorama", "p00", "--scene", "sphere", "-o", "a.png")
            self.assertEqual(done.err, said)
            return (self.folder / "a.png").read_bytes()
        wish = picture("", "out/coefficients.json")
        self.assertEqual(picture("", "coefficients.csv", "--table-frame", "openexr"), wish)
        native = picture("warning: coefficients.csv: a CSV table does not tell its frame; it is taken for native "
                         "(--table-frame names another, and a JSON table tells it)\n", "coefficients.csv")
        self.assertNotEqual(native, wish)
        self.assertEqual(picture("", "coefficients.csv", "--table-frame", "native"), native)
        (self.folder / "coefficients.csv").rename(self.folder / "out/coefficients.csv")
        self.assertEqual(picture("", "out/coefficients.csv"), wish)


class Messages(Commands):
    def test_errors_are_kind(self):
        self.make_output()
        (self.folder / "taken/p00.png").mkdir(parents=True)
        for status, arguments, *texts in (
                (2, ("out", "--scene", "lobse", "-o", "a.png"), '"lobse"', 'did you mean "lobes"'),
                (2, ("out", "--frame", "opnexr", "-o", "a.png"), "openexr"),
                (2, ("out", "--table-frame", "opnexr", "-o", "a.png"), "openexr"),
                (2, ("out", "--table-frame", "openexr", "-o", "a.png"), "--table-frame", "tells its frame", "--frame"),
                (2, ("out", "--quantity", "radance", "-o", "a.png"), "radiance"),
                (2, ("out", "--panorama", "q*", "-o", "a.png"), '"q*"', "p00, p01, p02"),
                (2, ("out", "--panorama", "po1", "-o", "a.png"), 'did you mean "p01"?'),
                (2, ("out", "--panorama", "p00.plane", "-o", "a.png"), 'did you mean "p00.plain"?'),
                (2, ("out", "--panorama", "*p", "-o", "a.png"), 'did you mean "*p*"?'),
                (2, ("out", "--scene", "compare", "--with", "p*", "-o", "x/"), "3 panoramas", "p00"),
                (2, ("out", "--grid", "0x4", "-o", "a.png"), "--grid 0x4"),
                (2, ("out", "-o", "a.jpg"), "a.jpg", ".png"),
                (2, ("out", "--format", "glb", "-o", "a.png"), "a.png", "--format"),
                (1, ("nowhere", "-o", "a.png"), "nowhere", "run `shoal run MANIFEST` first"),
                (1, ("lib/p00.hdr/", "-o", "a.png"), "p00.hdr"),
                (2, ("out", "--panorama", "p00"), "-o is missing", "-o DIR/"),
                (2, ("out", "--degree", "99", "-o", "a.png"), "--degree", "64", "--help"),
                (2, ("out", "--exposure", "nan", "-o", "a.png"), "--exposure nan", "100"),
                (2, ("out", "--page", "2", "-o", "a.png"), "--page", "contact"),
                (2, ("m.yaml", "-o", "a.png"), "m.yaml", "manifest", "output folder"),
                (1, ("out", "--panorama", "p00", "-o", "lib/p00.hdr/a.png"), "lib/p00.hdr", "is a file"),
                (1, ("out", "--panorama", "p00", "-o", "taken/"), "taken/p00.png", "there is a folder of that name"),
                (1, ("out", "--panorama", "p00", "-o", "/proc/a.png"), "/proc/a.png", "takes no new files"),
                (1, ("out", "-o", "/proc/"), "/proc/p00.png")):  # and not each of them
            done = self.render(status, *arguments)
            self.assertEqual(done.out, "")
            self.assertRegex(done.err, r"^error: ")
            self.assertEqual(len(done.err.splitlines()), 1, done)
            for text in texts:
                self.assertIn(text, done.err)

    def test_where_nothing_can_draw(self):
        """No EGL driver (its loader, libglvnd, finds none) and no X: a sentence, not VTK's abort."""
        self.make_output()
        for display in ({}, {"DISPLAY": ":987"}):
            environment = support.plain_environment(__EGL_VENDOR_LIBRARY_FILENAMES="/nonexistent", **display)
            done = self.expect(1, "render", "out", "--panorama", "p00", "-o", "a.png", env=environment)
            self.assertEqual((done.out, len(done.err.splitlines())), ("", 1), done)
            self.assertRegex(done.err, "^error: nothing here can draw: .*xvfb-run")
            self.assertFalse((self.folder / "a.png").exists())

    def test_size(self):
        self.make_output()
        for size in ("640", "640x", "x480", "0x0", "640x480x3", "100000x10"):
            done = self.expect(2, "render", "out", "--size", size, "-o", "a.png")
            self.assertIn(f"--size {size}", done.err)

    def test_labels_are_coloured_as_those_of_shoal(self):
        self.make_library(1)
        self.write("lib/bad.hdr", "no picture")
        wrong = ("render", "lib", "--panorama", "none", "-o", "a.png")
        said = self.shoal_on_terminal(*wrong).out
        self.assertIn("\x1b[33mwarning:\x1b[0m bad is left out", said)
        self.assertIn("\x1b[31merror:\x1b[0m no panorama is named", said)
        for environment in ({"NO_COLOR": "1"}, {"TERM": "dumb"}):
            self.assertNotRegex(self.shoal_on_terminal(*wrong, **environment).out, support.STYLE)
        self.assertNotIn(support.ESCAPE, self.expect(2, *wrong).err)

    def test_help_is_that_of_shoal(self):
        for command in ("render", "report"):
            done = self.expect(0, command, "--help")
            self.assertIn(f"Usage: shoal {command} ", done.out)
            self.assertNotIn("--way", done.out)


class Effects(Commands):
    SCENES = ("basis", "lobes", "sphere", "degrees", "lit", "compare", "contact")
    OPTIONS = (("--panorama", "p01"), ("--frame", "openexr"), ("--quantity", "irradiance"), ("--channel", "blue"),
               ("--colour", "light"), ("--exposure", "2"), ("--grid", "2x1"), ("--page", "2"),
               ("--with", "p00"), ("--degree", "1"))

    def test_every_option_changes_the_scene_or_is_refused(self):
        """Noise has light of every degree, channel and direction, so what counts changes some pixel."""
        self.make_library(2)
        first = {"--panorama": "p00"}
        for scene in self.SCENES:
            self.assert_effects(scene, {"basis": {}, "contact": {"--grid": "1x1", "--page": "1"}}.get(scene, first))
        self.assert_effects("compare", {**first, "--with": "p01"})

    def picture(self, scene, given):
        """The picture, of panoramas that are projected for it, or nothing; and what was said."""
        arguments = [word for option in given.items() for word in option]
        done = self.shoal("render", "lib", "--scene", scene, *arguments, "--size", "640x360", "--way", "surfaceless",
                          "-o", "a.png")
        return done.status == 0 and (self.folder / "a.png").read_bytes(), done.err

    def assert_effects(self, scene, given):
        plain, said = self.picture(scene, given)
        self.assertTrue(plain, said)
        for option, value in self.OPTIONS:
            picture, said = self.picture(scene, {**given, option: value})
            if picture:
                self.assertFalse(picture == plain, f"{option} changes nothing in {scene} {given}")
            else:
                mark = f"error: {option} has no effect in the scene {scene} (it counts in "
                self.assertTrue(said.startswith(mark), said)
                only_with = option == "--quantity" and scene == "compare"
                self.assertEqual(scene in said.removeprefix(mark), only_with, said)


class Reporting(Commands):
    def test_a_page_beside_the_results(self):
        self.make_output()
        self.assertEqual(self.expect(0, "report", "out").out, "out/report/index.html\n")
        self.assertTrue((self.folder / "out/report/index.html").is_file())

    def test_a_page_of_some(self):
        self.make_output()
        done = self.expect(0, "report", "out", "--panorama", "p01", "-o", "page")
        self.assertEqual(done.out, "page/index.html\n")
        page = (self.folder / "page/index.html").read_text()
        self.assertIn("p01", page)
        self.assertNotIn("p02", page)
        self.assertIn("p00", self.expect(2, "report", "out", "--panorama", "q").err)

    def figures_on_page(self, *source):
        self.expect(0, "report", *source, "-o", "page")
        page = (self.folder / "page/index.html").read_text()
        data = json.loads(re.search(r'id="data">(.*?)</script>', page, re.DOTALL).group(1))
        return {(p["name"], p["variant"] or "plain"): p["figures"] for p in data["panoramas"]}

    def assert_figures(self, found, expected, name):
        """The page has six significant digits."""
        if expected == "":
            self.assertIsNone(found, name)
        else:
            self.assertAlmostEqual(found, float(expected), delta=1e-5 * abs(float(expected)) + 1e-9, msg=name)

    # Whether the store tells the figures, or the page's maker takes them from the coefficients of a
    # table, where no window took a part of these.
    def test_the_page_and_the_table_of_quality_agree(self):
        self.make_output("tables: [csv, quality]\ndefaults: {quality: 6}\n"
                         "variants: {plain: {}, soft: {window: hann}, turned: {rotate: {yaw: 70}}}\n")
        with open(self.folder / "out/quality.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 9)
        stored, measured = self.figures_on_page("out"), self.figures_on_page("out/coefficients.csv")
        for row in rows:
            key = row["panorama"], row["variant"]
            for name in ("contrast", "directionality", "minimum_irradiance", "negative_fraction",
                         "key_temperature", "fill_temperature", "rms_error", "max_error"):
                self.assert_figures(stored[key][name], row[name], name)
                if key[1] != "soft":
                    self.assert_figures(measured[key][name], "" if "_error" in name else row[name], name)


if __name__ == "__main__":
    viz = pathlib.Path(support.BINARY or "/nonexistent").parent / "../../viz/app/shoal-viz"
    if not os.access(viz, os.X_OK):
        print("skipped: shoal-viz was not built")
        raise SystemExit(support.SKIPPED)
    unittest.main()
