"""`shoal project`: the table on standard output."""

import json
import math
import shutil
import struct

import support
from support import ShoalTest, write_constant_hdr, write_hdr

HEADER = "panorama,quantity,l,m,r,g,b"


def rows_of(text):
    lines = text.split("\n")
    assert lines[-1] == "" and lines[0] == HEADER, text[:200]
    return [line.split(",") for line in lines[1:-1]]


def bits(value):
    return struct.pack("<d", value)


class Table(ShoalTest):
    def test_header_and_order_of_rows(self):
        write_hdr(self.folder / "a.hdr", 1)
        rows = rows_of(self.expect(0, "project", "--degree", "4", "a.hdr").out)
        self.assertEqual([(int(row[2]), int(row[3])) for row in rows],
                         [(l, m) for l in range(5) for m in range(-l, l + 1)])
        self.assertEqual({(row[0], row[1]) for row in rows}, {("a.hdr", "radiance")})

    def test_numbers_are_written_so_that_they_read_back(self):
        """%.17g tells every double; the text must be what C writes for the number that it reads as."""
        write_hdr(self.folder / "a.hdr", 1)
        for row in rows_of(self.expect(0, "project", "--degree", "10", "a.hdr").out):
            for number in row[4:]:
                self.assertEqual(number, "%.17g" % float(number))

    def test_a_constant_picture(self):
        """L_00 = sqrt(4 pi) x value, all others 0: to 1e-7 by the kernels. Irradiance: pi x radiance,
        so sqrt(4 pi) x pi x value."""
        write_constant_hdr(self.folder / "a.hdr", (128, 64, 192), 129)
        out = self.expect(0, "project", "--quantity", "radiance", "--quantity", "irradiance", "--quantity",
                          "irradiance-over-pi", "a.hdr").out
        rows = rows_of(out)
        self.assertEqual(len(rows), 27)
        for row, value in ((0, 1.0), (9, math.pi), (18, 1.0)):
            for channel, share in enumerate((1.0, 0.5, 1.5)):
                expected = math.sqrt(4 * math.pi) * value * share
                self.assertAlmostEqual(float(rows[row][4 + channel]) / expected, 1.0, delta=1e-7)
        for row in rows[1:9] + rows[10:18] + rows[19:]:
            for number in row[4:]:
                self.assertLess(abs(float(number)), 1e-6)

    def test_the_path_stands_as_it_was_given(self):
        write_hdr(self.folder / "sub/a.hdr", 1)
        paths = ["sub/a.hdr", "./sub/../sub/a.hdr", str(self.folder / "sub/a.hdr")]
        rows = rows_of(self.expect(0, "project", *paths).out)
        self.assertEqual([row[0] for row in rows[::9]], paths)
        self.assertEqual(len({tuple(row[4:]) for row in rows}), 9)

    def test_order_of_files_for_every_thread_count(self):
        """Files of very different sizes, so that later ones are done first."""
        names = []
        for index in range(24):
            names.append(f"p{index}.hdr")
            write_hdr(self.folder / names[-1], index, *((256, 128) if index % 5 == 0 else (8, 4)))
        tables = {threads: self.expect(0, "project", "-j", threads, *names).out for threads in "127"}
        self.assertEqual([row[0] for row in rows_of(tables["1"])[::9]], names)
        self.assertEqual(tables["2"], tables["1"])
        self.assertEqual(tables["7"], tables["1"])

    def test_a_bad_file_among_good_ones(self):
        for index in range(4):
            write_hdr(self.folder / f"p{index}.hdr", index)
        self.write("bad.hdr", "#?RADIANCE\nno picture")
        done = self.expect(1, "project", "p0.hdr", "bad.hdr", "p1.hdr", "missing.hdr", "p2.hdr", "p3.hdr")
        self.assertEqual([row[0] for row in rows_of(done.out)[::9]], ["p0.hdr", "p1.hdr", "p2.hdr", "p3.hdr"])
        lines = done.err.splitlines()
        self.assertEqual(len(lines), 2, done)
        self.assertRegex(lines[0], r"^failed: bad\.hdr")
        self.assertRegex(lines[1], r"^failed: missing\.hdr")

    def test_json(self):
        write_hdr(self.folder / "a.hdr", 1)
        write_hdr(self.folder / 'odd "name", ü.hdr', 2)
        arguments = ("--degree", "3", "--quantity", "irradiance", "--quantity", "radiance", "a.hdr", 'odd "name", ü.hdr')
        table = json.loads(self.expect(0, "project", "--format", "json", *arguments).out)
        self.assertEqual((table["schema"], table["version"]), ("shoal/coefficients", 1))
        self.assertEqual([(record["panorama"], record["quantity"]) for record in table["records"]],
                         [(name, quantity) for name in ("a.hdr", 'odd "name", ü.hdr')
                          for quantity in ("irradiance", "radiance")])
        csv_rows = rows_of(self.expect(0, "project", *arguments[:-1]).out)
        for record, first in zip(table["records"], (0, 16)):
            self.assertEqual(record["degree"], 3)
            for numbers, row in zip(record["coefficients"], csv_rows[first:first + 16]):
                self.assertEqual([bits(float(n)) for n in numbers], [bits(float(n)) for n in row[4:]])

    def test_json_of_nothing_but_failures_is_json(self):
        done = self.expect(1, "project", "--format", "json", "missing.hdr")
        self.assertEqual(json.loads(done.out)["records"], [])

    def test_frames(self):
        """The panorama's centre, native -x, on +z; its right, native -y, on -x; its top on +y."""
        write_hdr(self.folder / "a.hdr", 1)
        native = rows_of(self.expect(0, "project", "a.hdr").out)
        for frame in (("--frame", "+z,-x,+y"), ("--frame=+z,-x,+y",), ("--frame", "openexr")):
            turned = rows_of(self.expect(0, "project", *frame, "a.hdr").out)
            for channel in (4, 5, 6):
                y, z, x = (float(native[i][channel]) for i in (1, 2, 3))
                self.assertEqual([float(turned[i][channel]) for i in (1, 2, 3)], [z, -x, y])

    def test_a_frame_that_begins_with_a_minus(self):
        write_hdr(self.folder / "a.hdr", 1)
        native = self.expect(0, "project", "a.hdr").out
        for frame in (("--frame", "-x,-y,+z"), ("--frame=-x,-y,+z",)):
            self.assertEqual(self.expect(0, "project", *frame, "a.hdr").out, native)

    def test_options_that_repeat_take_one_value_each(self):
        write_hdr(self.folder / "a.hdr", 1)
        self.expect(0, "project", "--quantity", "irradiance", "a.hdr")
        self.expect(0, "project", "--format", "csv", "a.hdr")
        twice = self.expect(0, "project", "--quantity", "irradiance", "--quantity", "irradiance", "a.hdr")
        self.assertEqual(len(rows_of(twice.out)), 9)

    def test_the_reference_agrees(self):
        """The promise: within 1e-6 of the integral of |I Y_lm|, here below |I| x sqrt(4 pi) x 3."""
        write_hdr(self.folder / "a.hdr", 1, 64, 32)
        fast = rows_of(self.expect(0, "project", "--degree", "6", "a.hdr").out)
        slow = rows_of(self.expect(0, "project", "--degree", "6", "--reference", "a.hdr").out)
        for a, b in zip(fast, slow):
            for channel in (4, 5, 6):
                bound = 1e-6 * 3 * float(slow[0][channel])
                self.assertLessEqual(abs(float(a[channel]) - float(b[channel])), bound)

    def test_nothing_is_written(self):
        write_hdr(self.folder / "a.hdr", 1)
        self.expect(0, "project", "a.hdr")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["a.hdr"])

    def test_the_format_is_told_by_the_content(self):
        write_hdr(self.folder / "a.hdr", 1)
        shutil.copy(self.folder / "a.hdr", self.folder / "a.exr")
        rows = rows_of(self.expect(0, "project", "a.hdr", "a.exr").out)
        self.assertEqual([row[1:] for row in rows[:9]], [row[1:] for row in rows[9:]])


if __name__ == "__main__":
    support.main()
