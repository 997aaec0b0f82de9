"""From a folder of pictures to verified outputs, as a newcomer goes."""

import os

import support
from support import ShoalTest, write_exr, write_hdr


class Init(ShoalTest):
    def test_init_check_run_verify(self):
        write_hdr(self.folder / "hdri/noon.hdr", 1)
        write_exr(self.folder / "hdri/deep/er/dusk.exr", 2)
        done = self.expect(0, "init", "hdri")
        self.assertEqual(done.out, "hdri/shoal.yaml\n")
        self.assertIn("shoal run hdri/shoal.yaml", done.err)
        text = (self.folder / "hdri/shoal.yaml").read_text()
        self.assertGreater(sum("#" in line for line in text.splitlines()), 5, "it explains itself")
        out = self.expect(0, "check", "hdri/shoal.yaml").out
        self.assertIn("2 to project", out)
        done = self.expect(0, "run", "hdri/shoal.yaml")
        self.assertIn("2 panoramas done", done.err)
        table = next(self.folder.rglob("coefficients.csv"))
        self.assertIn("deep/er/dusk,plain,radiance,0,0,", table.read_text())
        done = self.expect(0, "verify", table.parent)
        self.assertIn("0 problems", done.err)
        self.assertIn("2 up to date", self.expect(0, "run", "hdri/shoal.yaml").err, "outputs are no inputs")

    def test_an_existing_manifest_stays(self):
        write_hdr(self.folder / "hdri/noon.hdr", 1)
        self.write("hdri/shoal.yaml", "mine")
        done = self.expect(2, "init", "hdri")
        self.assertIn("exists already", done.err)
        self.assertEqual((self.folder / "hdri/shoal.yaml").read_text(), "mine")

    def test_a_folder_without_panoramas(self):
        (self.folder / "empty").mkdir()
        self.expect(2, "init", "empty")
        self.assertEqual(list((self.folder / "empty").iterdir()), [])


class Verify(ShoalTest):
    def setUp(self):
        super().setUp()
        self.make_library(3)
        self.write_manifest("maps: [{kind: irradiance, size: [16, 8], format: exr}]\n")
        self.expect(0, "run", "m.yaml")

    def flip(self, name):
        path = self.folder / name
        data = bytearray(path.read_bytes())
        data[len(data) // 2] ^= 1
        path.write_bytes(data)

    def problem(self, *arguments):
        done = self.expect(1, "verify", *arguments, "out")
        self.assertEqual(len(done.out.splitlines()), 1, done)
        self.assertIn("1 problem\n", done.err)
        return done.out

    def test_all_is_well(self):
        done = self.expect(0, "verify", "out")
        self.assertEqual(done.out, "")
        self.assertIn("3 panoramas and 4 written files compared", done.err)
        done = self.expect(0, "verify", "--recompute", "-j", "2", "out")
        self.assertIn("3 projected again", done.err)

    def test_a_changed_output(self):
        self.flip("out/maps/p01.irradiance.exr")
        self.assertIn("p01.irradiance.exr", self.problem())
        self.assertIn("3 up to date", self.expect(0, "run", "m.yaml").err)
        self.expect(0, "run", "--force", "m.yaml")
        self.expect(0, "verify", "out")

    def test_a_changed_input(self):
        self.flip("lib/p02.hdr")
        self.assertIn("lib/p02.hdr", self.problem())
        self.assertEqual(self.expect(1, "verify", "--recompute", "out").out.count("p02"), 2)

    def test_a_missing_file(self):
        os.unlink(self.folder / "out/coefficients.csv")
        self.assertIn("coefficients.csv", self.problem())
        self.expect(0, "run", "m.yaml")
        self.expect(0, "verify", "--recompute", "out")

    def test_a_moved_output_folder_is_still_whole(self):
        os.rename(self.folder / "out", self.folder / "moved")
        self.expect(0, "verify", "moved")

    def test_verifying_writes_nothing(self):
        before = {path: path.stat().st_mtime_ns for path in (self.folder / "out").rglob("*")}
        self.expect(0, "verify", "--recompute", "out")
        self.assertEqual({path: path.stat().st_mtime_ns for path in (self.folder / "out").rglob("*")}, before)


if __name__ == "__main__":
    support.main()
