"""shoal view, render and report where shoal-viz is not to be had."""

import os
import shutil

import support
from support import ShoalTest, main, plain_environment


class Missing(ShoalTest):
    def setUp(self):
        super().setUp()
        # A shoal on its own, away from the build tree.
        self.alone = self.folder / "bin" / "shoal"
        self.alone.parent.mkdir()
        shutil.copy(support.BINARY, self.alone)

    def run_alone(self, *arguments, path=""):
        result = support.subprocess.run(
            [self.alone, *arguments], capture_output=True, text=True, cwd=self.folder, timeout=60,
            env=plain_environment(PATH=path or os.fspath(self.folder)))
        return support.Done(result.returncode, result.stdout, result.stderr)

    def test_one_sentence_and_how_to_get_it(self):
        for command in ("view", "render", "report"):
            for arguments in ((), ("out",), ("--help",), ("out", "--scene", "lobes", "-o", "x.png")):
                done = self.run_alone(command, *arguments)
                self.assertEqual(done.status, 1, done)
                self.assertEqual(done.out, "")
                self.assertEqual(len(done.err.splitlines()), 1)
                for text in (f"error: `shoal {command}`", "shoal-viz", "built without it", "libvtk9-dev"):
                    self.assertIn(text, done.err)

    def test_help_lists_them(self):
        done = self.run_alone("--help")
        self.assertEqual(done.status, 0)
        for command in ("preview", "view", "render", "report"):
            self.assertIn(f"\n  {command} ", done.out)

    def stand_in(self, folder):
        program = folder / "shoal-viz"
        folder.mkdir(parents=True, exist_ok=True)
        program.write_text('#!/bin/sh\nprintf "%s|" "$@"\nexit 7\n')
        program.chmod(0o755)

    def test_arguments_and_status_are_those_of_shoal_viz(self):
        """Also those that are commands or options of shoal itself."""
        words = ["render", "run", "--help", "-j", "", "a b", "--", "-o"]
        for place, path in ((self.folder / "bin", "/usr/bin:/bin"),
                            (self.folder / "elsewhere", f"/usr/bin:{self.folder / 'elsewhere'}")):
            self.stand_in(place)
            done = self.run_alone(*words, path=path)
            self.assertEqual((done.status, done.out), (7, "".join(word + "|" for word in words)))
            (place / "shoal-viz").unlink()

    def test_a_misspelt_command_is_told(self):
        done = self.run_alone("redner")
        self.assertEqual(done.status, 2)
        self.assertIn('did you mean "render"', done.err)


if __name__ == "__main__":
    main()
