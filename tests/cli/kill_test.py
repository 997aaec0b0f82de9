"""A run that is killed leaves nothing half-written, and the next one ends as if nothing had been."""

import random
import shutil
import signal
import subprocess
import time

import support
from support import ShoalTest, is_temporary, start

PANORAMAS = 40
KILLS = 16
MANIFEST = ("tables: [csv, json, npy]\nvariants: {plain: {}, dark: {exposure: -3}}\nmaps:\n"
            "  - {kind: irradiance, size: [64, 32], format: exr}\n"
            "  - {kind: radiance, layout: cube, size: 8, format: hdr}\n")


class Kill(ShoalTest):
    def setUp(self):
        super().setUp()
        self.make_library(PANORAMAS, width=64, height=32)
        self.write_manifest(MANIFEST)
        begin = time.monotonic()
        self.expect(0, "run", "m.yaml")
        self.duration = time.monotonic() - begin
        self.undisturbed = self.outputs()
        self.assertEqual(len(self.undisturbed), 4 + PANORAMAS * 2 * 2)
        self.cut_short = 0  # runs that were killed before they ended

    def kill(self, delay, *options):
        process = start("run", *options, "m.yaml", cwd=self.folder, stdout=subprocess.DEVNULL,
                        stderr=subprocess.DEVNULL)
        time.sleep(delay)
        process.kill()
        self.cut_short += process.wait(60) == -signal.SIGKILL

    def moment(self, index, count):
        """Seconds after the start: more at the beginning, where the store is made and the plan, than later."""
        return self.duration * ((index + 0.5) / count)**1.7

    def check_what_is_left(self):
        """Everything under a final name is what the undisturbed run wrote, to the last byte."""
        if not (self.folder / "out").exists():
            return
        for name, content in self.outputs().items():
            if not is_temporary(name):
                self.assertEqual(content, self.undisturbed.get(name), name)

    def finish(self):
        self.expect(0, "run", "m.yaml")
        self.assertEqual(self.outputs(), self.undisturbed)
        self.expect(0, "verify", "out")

    def test_at_any_moment_of_a_run_from_nothing(self):
        for index in range(KILLS):
            shutil.rmtree(self.folder / "out")
            self.kill(self.moment(index, KILLS))
            self.check_what_is_left()
            self.finish()
        self.assertGreater(self.cut_short, KILLS // 3)

    def test_at_any_moment_of_a_run_that_does_all_again(self):
        for index in range(KILLS // 2):
            self.kill(self.moment(index, KILLS // 2), "--force")
            self.check_what_is_left()
            self.finish()
        self.assertGreater(self.cut_short, KILLS // 6)

    def test_many_times_in_a_row(self):
        shutil.rmtree(self.folder / "out")
        moments = random.Random(1)
        for _ in range(8):
            self.kill(self.duration * moments.uniform(0.1, 0.7))
            self.check_what_is_left()
        self.finish()
        self.assertGreater(self.cut_short, 0)

    def test_a_killed_run_of_other_parameters_leaves_no_mixture(self):
        """Killed while every map is replaced by another: what is finished then is all of one kind."""
        self.kill(self.duration / 2, "--degree", "3")
        self.finish()


if __name__ == "__main__":
    support.main()
