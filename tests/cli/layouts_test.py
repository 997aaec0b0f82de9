"""Layouts that are recognised: what is told of them, once a panorama, and to whom."""

import json

from support import ShoalTest, main, write_exr, write_hdr

FACES = ["px", "nx", "py", "ny", "pz", "nz"]
BY_ATTRIBUTE = "note: cube.exr: it is cube-openexr by its envmap attribute\n"
BY_NAMES = "note: sky_px.hdr: it is cube-faces by the names of six files, sky_px.hdr to sky_nz.hdr\n"


class Layouts(ShoalTest):
    def make_cubes(self):
        write_exr(self.folder / "cube.exr", 1, 8, 48, envmap=1)
        for seed, face in enumerate(FACES):
            write_hdr(self.folder / f"sky_{face}.hdr", seed, 8, 8)

    def test_what_was_recognised_is_told(self):
        self.make_cubes()
        for command in ("project", "quality"):
            self.assertEqual(self.expect(0, command, "cube.exr").err, BY_ATTRIBUTE)
            done = self.expect(0, command, "--layout", "auto", "sky_px.hdr", "cube.exr")
            self.assertEqual(done.err, BY_NAMES + BY_ATTRIBUTE)

    def test_what_was_asked_for_is_no_news(self):
        self.make_cubes()
        for command in ("project", "quality"):
            self.assertEqual(self.expect(0, command, "--layout", "cube-openexr", "cube.exr").err, "")
            self.assertEqual(self.expect(0, command, "--layout", "cube-faces", "sky_px.hdr").err, "")
        write_exr(self.folder / "latlong.exr", 1, 32, 16, envmap=0)
        self.assertEqual(self.expect(0, "project", "latlong.exr").err, "", "the usual layout")

    def test_programs_are_told_nothing_but_their_data(self):
        self.make_cubes()
        for command in ("project", "quality"):
            done = self.expect(0, command, "--format", "json", "cube.exr")
            self.assertEqual(done.err, "")
            json.loads(done.out)

    def test_a_guess_is_a_warning(self):
        write_hdr(self.folder / "probe.hdr", 1, 32, 32)
        done = self.expect(0, "project", "--layout", "auto", "probe.hdr")
        self.assertIn("warning: probe.hdr: it was taken for an angular map, because it is square", done.err)
        self.assertNotIn("note:", done.err)

    def test_the_plan_tells_what_is_known_before_a_file_is_opened(self):
        self.make_cubes()
        self.write("m.yaml", "shoal: 1\noutput: out\npanoramas:\n  - {file: cube.exr}\n"
                             "  - {file: sky_px.hdr, layout: auto}\n  - {file: sky_nx.hdr, layout: angular}\n")
        told = self.expect(0, "check", "m.yaml").out
        self.assertRegex(told, r"cube +\(new\)\n")
        self.assertRegex(told, r"sky_px +\(new, cube-faces\)\n")
        self.assertRegex(told, r"sky_nx +\(new, angular\)\n")
        self.assertIn("(new, cube-faces)", self.expect(0, "run", "--explain", "m.yaml").err)

    def test_previews_lie_as_their_scenes_do(self):
        self.make_cubes()
        done = self.expect(0, "preview", "--layout", "auto", "--width", "20", "-o", "small", "cube.exr", "sky_px.hdr")
        lines = [json.loads(line) for line in done.out.splitlines()]
        self.assertEqual([line["layout"] for line in lines], ["cube-openexr", "cube-faces"])
        self.assertEqual([(line["width"], line["height"]) for line in lines], [(20, 10), (20, 10)])
        self.assertEqual(done.err, "")
        for file, small in (("cube.exr", "000001.exr"), ("sky_px.hdr", "000002.exr")):
            whole = self.expect(0, "project", "--degree", "0", "--layout", "auto", file).out
            shrunk = self.expect(0, "project", "--degree", "0", f"small/{small}").out
            for a, b in zip(*(map(float, text.splitlines()[1].split(",")[4:]) for text in (whole, shrunk))):
                self.assertAlmostEqual(a / b, 1, delta=0.1, msg=file)
        self.assertIn("unknown layout", self.expect(2, "preview", "--layout", "cubes", "-o", "x", "cube.exr").err)


if __name__ == "__main__":
    main()
