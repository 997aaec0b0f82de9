"""Panoramas that fail among others that do not."""

import shutil

import support
from support import ShoalTest, write_hdr


class Failures(ShoalTest):
    def setUp(self):
        super().setUp()
        self.make_library(6)

    def break_one(self, index=2):
        path = self.folder / f"lib/p{index:02}.hdr"
        good = path.read_bytes()
        path.write_bytes(good[:len(good) // 2])
        return path, good

    def test_the_others_are_done_and_only_it_is_done_again(self):
        path, good = self.break_one()
        done = self.expect(1, "run", "m.yaml")
        self.assertIn("5 panoramas done, 1 failed", done.err)
        self.assertIn("1 panorama of the manifest not in the tables", done.err)
        table = self.table()
        self.assertNotIn(b"p02", table)
        done = self.expect(1, "run", "--explain", "m.yaml")
        self.assertIn("runs: p02 (failed before)", done.err)
        self.assertIn("0 panoramas done, 5 up to date, 1 failed", done.err)
        self.assertEqual(self.table(), table)
        path.write_bytes(good)
        self.assertIn("1 panorama done, 5 up to date", self.expect(0, "run", "m.yaml").err)
        incremental = self.outputs()
        shutil.rmtree(self.folder / "out")
        self.expect(0, "run", "m.yaml")
        self.assertEqual(self.outputs(), incremental)

    def test_a_panorama_that_was_good_and_is_bad_now_leaves_the_tables(self):
        self.expect(0, "run", "m.yaml")
        self.break_one()
        self.expect(1, "run", "m.yaml")
        self.assertNotIn(b"p02", self.table())

    def test_every_failure_is_one_line_in_manifest_order(self):
        for index in (0, 2, 4):
            self.break_one(index)
        done = self.expect(1, "run", "-j", "7", "m.yaml")
        failed = [line for line in done.err.splitlines() if line.startswith("failed: ")]
        self.assertEqual([line.split("lib/")[1][:3] for line in failed], ["p00", "p02", "p04"])

    def test_fail_fast(self):
        self.break_one(0)
        for index in range(6, 60):
            write_hdr(self.folder / f"lib/p{index:02}.hdr", index)
        done = self.expect(1, "run", "-j", "1", "--fail-fast", "m.yaml")
        self.assertIn("0 panoramas done, 1 failed", done.err)
        self.assertNotIn("interrupted", done.err)
        done = self.expect(1, "run", "-j", "1", "m.yaml")
        self.assertIn("59 panoramas done", done.err)

    def test_fail_fast_without_failure_is_a_run_like_any(self):
        self.expect(0, "run", "--fail-fast", "m.yaml")
        self.assertIn(b"p05", self.table())

    def test_pixels_that_the_policy_forbids(self):
        """A float picture with a NaN: it says how many and where, and `nonfinite: zero` takes it."""
        path = self.folder / "lib/p01.exr"
        data = bytearray(path.read_bytes())
        data[-4:] = b"\x00\x00\xc0\x7f"  # the last sample of the last row, red
        path.write_bytes(data)
        done = self.expect(1, "run", "m.yaml")
        self.assertRegex(done.err, r"failed: lib/p01\.exr.*1 pixel.*row 15, column 31.*nonfinite: zero")
        self.write_manifest("defaults: {nonfinite: zero}\n")
        done = self.expect(0, "run", "m.yaml")
        self.assertIn("warning: p01:", done.err)


if __name__ == "__main__":
    support.main()
