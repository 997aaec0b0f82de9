"""`shoal profiles`, and `shoal project --profile`."""

import json

import support
from support import ShoalTest, write_hdr

MINE = """shoal_profile: 1
title: mine
consumer: mine
frame: native
sign: plain
quantity: radiance
degree: 3
number: float64
extension: txt
text: |
  {{l}},{{m}},{{r}},{{g}},{{b}}
"""


class Profiles(ShoalTest):
    def test_the_list(self):
        lines = self.expect(0, "profiles").out.splitlines()
        self.assertEqual(lines[0].split(), ["name", "degree", "frame", "consumer"])
        by_name = {line.split()[0]: line.split() for line in lines[1:]}
        self.assertEqual(by_name["three"][1:3], ["2", "+x,+z,+y"])
        self.assertEqual(by_name["cmft"][1], "4")
        self.assertEqual(by_name["numpy"][1], "all")
        self.assertEqual(list(by_name), sorted(by_name))

    def test_one_of_them_can_be_the_beginning_of_ones_own(self):
        write_hdr(self.folder / "a.hdr", 1)
        text = self.expect(0, "profiles", "three").out
        self.write("mine.yaml", text)
        self.assertEqual(self.expect(0, "project", "--profile", "./mine.yaml", "a.hdr").out,
                         self.expect(0, "project", "--profile", "three", "a.hdr").out)

    def test_a_misspelt_name(self):
        self.assertIn('did you mean "unity"?', self.expect(2, "profiles", "untiy").err)
        write_hdr(self.folder / "a.hdr", 1)
        done = self.expect(2, "project", "--profile", "untiy", "a.hdr")
        self.assertEqual(done.out, "")
        self.assertIn('did you mean "unity"?', done.err)

    def test_the_numbers_are_the_tables(self):
        """Of the profile's degree, which is higher than the default."""
        write_hdr(self.folder / "a.hdr", 1)
        self.write("mine.yaml", MINE)
        table = self.expect(0, "project", "--degree", "3", "a.hdr").out.splitlines()[1:]
        lines = self.expect(0, "project", "--profile", "mine.yaml", "a.hdr").out.splitlines()
        self.assertEqual([line.split(",", 2)[2].split(",") for line in table],
                         [line.split(",") for line in lines])

    def test_frame_and_options(self):
        write_hdr(self.folder / "a.hdr", 1)
        done = self.expect(0, "project", "--profile", "gltf", "--option", "convolved=no", "--frame", "+z,-x,+y",
                           "a.hdr")
        extras = json.loads(done.out)["extensions"]["EXT_lights_image_based"]["lights"][0]["extras"]
        self.assertEqual((extras["convolved"], extras["frame"]), ("no", "+z,-x,+y"))

    def test_what_makes_no_sense(self):
        write_hdr(self.folder / "a.hdr", 1)
        for arguments in (("--profile", "three", "--quantity", "irradiance"),
                          ("--profile", "three", "--format", "json"),
                          ("--profile", "cmft", "--degree", "2"),
                          ("--profile", "gltf", "--option", "convolved"),
                          ("--profile", "gltf", "--option", "convolved=maybe"),
                          ("--option", "convolved=no")):
            done = self.expect(2, "project", *arguments, "a.hdr")
            self.assertEqual(done.out, "")
            self.assertRegex(done.err, "^error: ")

    def test_json_is_one_document(self):
        files = ["a.hdr", "b.hdr"]
        for seed, file in enumerate(files):
            write_hdr(self.folder / file, seed)
        done = self.expect(2, "project", "--profile", "three", *files)
        self.assertEqual(done.out, "")
        self.assertIn("one JSON document of one panorama, but 2 are named", done.err)
        self.assertIn("exports: three", done.err)
        self.assertEqual(self.expect(0, "project", "--profile", "glsl", *files).out.count("vec3 "),
                         2 * self.expect(0, "project", "--profile", "glsl", files[0]).out.count("vec3 "))

    def test_a_fault_in_ones_own_is_told_with_its_place(self):
        write_hdr(self.folder / "a.hdr", 1)
        self.write("mine.yaml", MINE.replace("sign:", "sgin:"))
        done = self.expect(2, "project", "--profile", "mine.yaml", "a.hdr")
        self.assertEqual(done.err, 'error: mine.yaml:5:1: unknown key "sgin" in a profile (did you mean "sign"?)\n')

    def test_a_run_says_what_it_wrote(self):
        self.make_library(3)
        self.write_manifest("exports: [three, glsl]\n")
        done = self.expect(0, "run", "m.yaml")
        self.assertIn("out/exports (6 files written)", done.err)
        text = (self.folder / "out/exports/p00.three.json").read_text()
        self.assertEqual(len(json.loads(text)["sh"]), 27)
        self.expect(0, "verify", "out")
        (self.folder / "out/exports/p00.three.json").write_text(text.replace("1", "2", 1))
        self.assertIn("p00.three.json", self.expect(1, "verify", "out").err + self.shoal("verify", "out").out)

    def test_a_degree_on_the_command_line_that_is_too_low(self):
        self.make_library(1)
        self.write_manifest("exports: [three]\n")
        self.assertIn("needs degree 2", self.expect(2, "run", "m.yaml", "--degree", "1").err)


if __name__ == "__main__":
    support.main()
