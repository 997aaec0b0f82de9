"""Everything there is among the real panoramas, hostile files included, in one manifest."""

import math
import resource
import signal
import unittest

import support
from support import DATA, ShoalTest

MAX_MEGABYTES = 512


@unittest.skipUnless(DATA.is_dir(), f"no real panoramas in {DATA}; set SHOAL_TEST_DATA")
class RealLibrary(ShoalTest):
    def setUp(self):
        super().setUp()
        self.write("all.yaml", f'shoal: 1\noutput: out\npanoramas: [{{files: "{DATA.resolve()}/**/*"}}]\n'
                               "maps: [{kind: irradiance, size: [64, 32], format: exr}]\n")

    def counts(self, done):
        """Panoramas done, up to date, failed."""
        line = next(line for line in done.err.splitlines() if " done" in line)
        words = line.replace(",", "").split()
        return tuple(int(words[words.index(word) + offset]) if word in words else 0
                     for word, offset in (("done", -2), ("up", -1), ("failed", -1)))

    def test_all_at_once(self):
        first = self.expect(1, "run", "all.yaml", timeout=300)
        done, _, failed = self.counts(first)
        self.assertGreater(done, 50)
        self.assertGreater(failed, 50)
        lines = [line for line in first.err.splitlines() if line.startswith("failed: ")]
        self.assertEqual(len(lines), failed, "one line an error")
        for line in lines:
            self.assertIn(str(DATA.resolve()), line)
            self.assertGreater(len(line.split(": ", 2)[2]), 5, line)

        table = self.table()
        self.assertEqual(len(table.splitlines()), 1 + done * 2 * 9)
        for line in table.splitlines()[1:]:
            for number in line.split(b",")[-3:]:
                self.assertTrue(math.isfinite(float(number)), line)

        second = self.expect(1, "run", "--progress", "json", "all.yaml", timeout=300)
        self.assertIn(f'"done": 0, "failed": {failed}, "up_to_date": {done}', second.err)
        self.assertEqual(self.table(), table)

        megabytes = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
        print(f"{done} done, {failed} failed, at most {megabytes:.0f} MB")
        self.assertLess(megabytes, MAX_MEGABYTES)

    def test_the_same_bytes_for_every_thread_count(self):
        self.expect(1, "run", "-j", "1", "all.yaml", timeout=300)
        alone = self.outputs()
        support.shutil.rmtree(self.folder / "out")
        self.expect(1, "run", "-j", "7", "all.yaml", timeout=300)
        self.assertEqual(self.outputs(), alone)

    def test_every_file_by_itself(self):
        """No signal, whatever the file: status 0 with a table, or 1 with one line."""
        bad = [path for folder in ("bad_inputs", "openexr-images/Damaged", "rgbe_variants")
               for path in sorted((DATA / folder).rglob("*")) if path.is_file()]
        self.assertGreater(len(bad), 20)
        for path in bad[::5]:
            done = self.shoal("project", "--degree", "1", path)
            self.assertIn(done.status, (0, 1), f"{path}\n{done}")
            self.assertNotEqual(done.status, -signal.SIGSEGV)
            if done.status == 1:
                self.assertEqual(len([l for l in done.err.splitlines() if l.startswith("failed: ")]), 1, done)


if __name__ == "__main__":
    support.main()
