"""shoal view under Xvfb: keys and mouse as hardware gives them, and what the screen shows then."""

import math
import os
import pathlib
import subprocess
import sys
import unittest

import support
from support import ShoalTest, plain_environment

sys.path.insert(0, os.fspath(pathlib.Path(__file__).parent))
import made_lights  # noqa: E402
import x_display  # noqa: E402
from x_display import wait_until  # noqa: E402

WIDTH, HEIGHT = 640, 360
SCREEN = (800, 600)
SCENES = ("basis", "lobes", "sphere", "degrees", "lit", "compare", "contact")
PANORAMAS = ("dusk", "harbour", "studio")


class Window:
    """shoal view, running."""

    def __init__(self, test, display, *arguments):
        self.test, self.display, self.messages = test, display, test.folder / "messages"
        with open(self.messages, "w") as messages:
            self.process = subprocess.Popen(
                [support.BINARY, "view", *arguments, "--size", f"{WIDTH}x{HEIGHT}"], cwd=test.folder,
                env=plain_environment(DISPLAY=display.name), stdout=subprocess.PIPE, stderr=messages, text=True)
        test.addCleanup(self.stop)
        display.point(WIDTH // 2, HEIGHT // 2)
        wait_until(lambda: display.titles() or self.process.poll() is not None, "no window opens")
        test.assertIsNone(self.process.poll(), self.messages.read_text())
        self.now = self.settled(None)

    def stop(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()

    def picture(self):
        return self.display.picture(WIDTH, HEIGHT)

    def settled(self, before):
        """The picture once it is another than `before` and changes no more."""
        seen = []

        def is_settled():
            seen.append(self.picture())
            return seen[-1] != before and any(seen[-1]) and seen[-3:].count(seen[-1]) == 3 and seen[-1]
        return wait_until(is_settled, "the picture does not change")

    def changed_by(self, action):
        """The picture after what must change it."""
        before, self.now = self.now, None
        action()
        self.now = self.settled(before)
        return self.now

    def saved(self):
        """The pictures of which it was said that they were saved."""
        mark = "saved "
        lines = self.messages.read_text().splitlines()
        return [pathlib.Path(line.removeprefix(mark)) for line in lines if line.startswith(mark)]

    def save(self):
        """Presses s and waits for the picture; all that was pressed before has been dealt with then. A key without a
        meaning takes the words about it away again."""
        count = len(self.saved())
        self.display.press("s")
        wait_until(lambda: len(self.saved()) > count, "no picture is saved")
        told = self.settled(None)
        self.display.press("f")
        self.settled(told)
        return self.saved()[-1].name

    def drag(self, start, end, button=1):
        def turn():
            self.display.drag(start, end, button)
            self.save()
        return self.changed_by(turn)

    def press(self, key):
        return self.changed_by(lambda: self.display.press(key))

    def expect_back(self, keys, picture):
        """Keys after which the picture is one that was there before, to the bit."""
        for key in keys:
            self.display.press(key)
        wait_until(lambda: self.picture() == picture, f"{keys} does not bring the picture back")
        self.now = picture

    def expect_title(self, subject, scene):
        title = f"shoal - {subject} - {scene}"
        wait_until(lambda: self.display.titles() == [title], f"the title is {self.display.titles()}, not {title}")

    def quit(self):
        self.display.press("q")
        out, _ = self.process.communicate(timeout=60)
        self.test.assertEqual((self.process.returncode, out), (0, ""), self.messages.read_text())


class View(ShoalTest):
    @classmethod
    def setUpClass(cls):
        cls.display = x_display.Display(*SCREEN)
        cls.addClassCleanup(cls.display.close)

    def open(self, *arguments):
        made_lights.write_library(self.folder)
        return Window(self, self.display, *arguments)

    def open_panoramas(self, *arguments):
        return self.open(*(f"{name}.hdr" for name in PANORAMAS), "--degree", "4", *arguments)

    def test_scenes(self):
        window = self.open_panoramas()
        window.expect_title("dusk", "lobes")
        seen = {}
        for number, scene in enumerate(SCENES, 1):
            seen[scene] = window.press(str(number))
            self.assertRegex(self.display.titles()[0], f"^shoal - .* - {scene}$")
        self.assertEqual(len(set(seen.values())), len(SCENES), "two scenes are the same picture")
        for number, scene in enumerate(SCENES, 1):
            window.expect_back(str(number), seen[scene])
        window.quit()

    def test_next_and_previous(self):
        window = self.open_panoramas()
        first = window.now
        second = window.press("n")
        window.expect_title("harbour", "lobes")
        third = window.press("n")
        window.expect_title("studio", "lobes")
        self.assertEqual(len({first, second, third}), 3)
        window.expect_back("p", second)
        window.expect_back("p", first)
        window.expect_back("p", third)  # before the first comes the last
        window.expect_back("n", first)
        window.quit()

    def test_pages_of_a_contact_sheet(self):
        window = self.open_panoramas("--grid", "2x1", "--scene", "contact")
        first = window.now
        window.press("n")
        window.expect_back("n", first)
        # From a panorama to the page that has it.
        window.press("2")
        window.press("p")
        window.expect_title("studio", "lobes")
        last = window.press("7")
        self.assertNotEqual(last, first)
        window.expect_back("p", first)
        # And from a page to its first panorama.
        window.press("n")
        window.press("3")
        window.expect_title("studio", "sphere")
        window.expect_back("7", last)
        window.press("n")
        window.press("3")
        window.expect_title("dusk", "sphere")
        window.quit()

    def test_a_page_alone_leaves_the_panorama(self):
        window = self.open_panoramas()
        second = window.press("n")
        sheet = window.press("7")
        window.expect_back("n", sheet)
        window.expect_back("2", second)
        window.quit()

    def test_the_ends_of_the_degrees_are_told(self):
        """By a card, which the next key takes away."""
        window = self.open_panoramas()
        for key, steps in (("+", 0), ("-", 4)):
            for _ in range(steps):
                window.press(key)
            last = window.now
            window.press(key)
            window.expect_back("f", last)
        for key in "++++":  # the way back is as long
            window.press(key)
        window.quit()

    def test_the_ends_of_the_basis_are_told(self):
        window = self.open("light.csv", "--scene", "basis", "--degree", "13")  # more than + leads to
        last = window.now
        window.press("+")
        window.expect_back("f", last)
        window.press("-")
        window.quit()

    def test_settings_there_and_back(self):
        window = self.open_panoramas("--scene", "sphere")
        start = window.now
        for key, back in (("-", "+"), ("w", "w"), ("e", "E"), ("E", "e"), ("h", "h"), ("n", "p")):
            window.press(key)
            window.expect_back(back, start)
        self.assertNotEqual(window.press("e"), window.press("E"))
        degree = window.press("4")
        channels = {degree, *(window.press("c") for _ in range(3))}
        self.assertEqual(len(channels), 4)
        window.expect_back("c", degree)
        window.quit()

    def test_mouse(self):
        window = self.open_panoramas()
        start = window.now
        left, right = (150, 180), (250, 150)
        for button in (1, 2, 3):  # turns, moves, comes nearer
            window.drag(left, right, button)
            window.expect_back("r", start)
        turned = window.drag(left, right)
        window.press("n")  # which leaves the view turned
        window.expect_back("p", turned)
        window.expect_back("r", start)
        # Words do not turn.
        self.display.drag((600, 50), (500, 100))
        window.press("h")
        window.expect_back("h", start)
        window.quit()

    def test_keys_of_vtk_do_nothing(self):
        window = self.open_panoramas()
        start = window.now
        for key in "fjtalui":  # flies, joystick, trackball, actor, light follows, user event
            self.display.press(key)
        window.press("h")
        window.expect_back("h", start)
        window.press("3")  # a scene, not stereo
        window.expect_title("dusk", "sphere")
        window.expect_back("2", start)
        window.quit()

    def test_saved_pictures_are_those_that_render_makes(self):
        window = self.open_panoramas()
        window.press("n")
        files = [window.save()]
        window.press("h")
        files.append(window.save())  # without the help
        window.changed_by(lambda: self.display.resize(500, 300))
        files.append(window.save())
        window.press("4")
        files.append(window.save())
        self.assertEqual(files, ["harbour.lobes.png", "harbour.lobes-2.png", "harbour.lobes-3.png",
                                 "harbour.degrees.png"])
        window.quit()
        self.assertEqual(window.saved(), [self.folder.resolve() / name for name in files])
        for name, scene, size in zip(files, ("lobes", "lobes", "lobes", "degrees"),
                                     (f"{WIDTH}x{HEIGHT}", f"{WIDTH}x{HEIGHT}", "500x300", "500x300")):
            self.expect(0, "render", "harbour.hdr", "--degree", "4", "--scene", scene, "--size", size, "-o", "wish.png")
            self.assertEqual((self.folder / name).read_bytes(), (self.folder / "wish.png").read_bytes(), name)

    def test_a_picture_that_cannot_be_saved_is_told(self):
        name = 300 * "long"  # no file system takes so much
        made_lights.write_table(self.folder / "long.csv", {name: made_lights.light_from_above()})
        window = Window(self, self.display, "long.csv")
        start = window.now
        window.press("s")
        window.expect_back("f", start)
        window.quit()
        self.assertRegex(window.messages.read_text(), r"error: /.*: cannot be .*: File name too long \(.*\)")
        self.assertEqual(list(self.folder.glob("*.png")), [])

    def test_the_window_over_degrees(self):
        """w is the Hann window of the degree that is shown: the picture is that of coefficients windowed here."""
        window = self.open("light.csv")
        window.press("-")
        window.press("w")
        saved = self.folder / window.save()
        window.quit()
        degree = made_lights.DEGREE - 1
        windowed = {(l, m): [0.5 * (1.0 + math.cos(math.pi * l / (degree + 1))) * c for c in rgb]
                    for (l, m), rgb in made_lights.light_from_above().items()}
        made_lights.write_table(self.folder / "windowed.csv", {"light at +z": windowed}, degree, "Hann window")
        self.expect(0, "render", "windowed.csv", "--size", f"{WIDTH}x{HEIGHT}", "-o", "wish.png")
        self.assertEqual(saved.read_bytes(), (self.folder / "wish.png").read_bytes())

    def test_two_panoramas_compared(self):
        """--with, which is gone through, too, though --panorama leaves it out."""
        window = self.open("light.csv", "--panorama", "light*", "--with", "sky*", "--scene", "compare")
        window.expect_title("light at +z", "compare")
        saved = self.folder / window.save()
        window.press("n")
        window.expect_title("sky over ground", "compare")
        window.quit()
        self.expect(0, "render", "light.csv", "--panorama", "light*", "--with", "sky*", "--scene", "compare",
                    "--size", f"{WIDTH}x{HEIGHT}", "-o", "wish.png")
        self.assertEqual(saved.read_bytes(), (self.folder / "wish.png").read_bytes())

    def test_a_scene_that_cannot_be_shown_says_why(self):
        window = self.open("light.csv")
        window.expect_title("light at +z", "lobes")
        start = window.now
        window.press("6")  # there are no pixels to compare with
        window.expect_title("light at +z", "compare")
        window.expect_back("2", start)
        window.quit()


class NoDisplay(ShoalTest):
    def test_one_sentence(self):
        made_lights.write_library(self.folder)
        for environment, reason in (({}, "DISPLAY is not set"), ({"DISPLAY": ":987"}, ":987 does not answer")):
            done = self.expect(1, "view", "light.csv", env=plain_environment(**environment))
            self.assertEqual(done.out, "")
            self.assertEqual(len(done.err.splitlines()), 1)
            self.assertRegex(done.err, "^error: ")
            self.assertIn(reason, done.err)
            self.assertIn("`shoal render`", done.err)

    def test_help_lists_the_keys(self):
        done = self.expect(0, "view", "--help")
        for key in ("n  p", "1 to 7", "+  -", "E  e", "quit"):
            self.assertIn(key, done.out)


if __name__ == "__main__":
    viz = pathlib.Path(support.BINARY or "/nonexistent").parent / "../../viz/app/shoal-viz"
    reason = "" if os.access(viz, os.X_OK) else "shoal-viz was not built"
    reason = reason or x_display.missing()
    if reason:
        print(f"skipped: {reason}")
        raise SystemExit(support.SKIPPED)
    unittest.main()
