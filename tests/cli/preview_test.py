"""shoal preview: small pictures, a line of JSON each, and one bad file that stops no other."""

import json
import os

from support import ShoalTest, main, rgbe_bytes, write_constant_hdr, write_exr, write_hdr


class Previews(ShoalTest):
    def make_files(self):
        write_hdr(self.folder / "a.hdr", 1, 64, 32)
        write_exr(self.folder / "b.exr", 2, 100, 50)
        write_hdr(self.folder / "c.hdr", 3, 32, 16)
        return ["a.hdr", "b.exr", "c.hdr"]

    def pictures(self, folder):
        return {path.name: path.read_bytes() for path in sorted((self.folder / folder).iterdir())}

    def test_a_line_each_in_the_order_given(self):
        files = self.make_files()
        done = self.expect(0, "preview", "--width", "40", "-o", "small", *files)
        lines = [json.loads(line) for line in done.out.splitlines()]
        self.assertEqual(done.err, "")
        self.assertEqual([line["input"] for line in lines], files)
        self.assertEqual([line["output"] for line in lines], [f"small/{i:06}.exr" for i in (1, 2, 3)])
        # No wider than the panorama itself.
        self.assertEqual([(line["width"], line["height"]) for line in lines], [(40, 20), (40, 20), (32, 16)])
        self.assertEqual(sorted(self.pictures("small")), ["000001.exr", "000002.exr", "000003.exr"])

    def test_the_same_bytes_for_any_number_of_threads(self):
        files = self.make_files() * 4
        told = set()
        for threads in (1, 2, 7):
            done = self.expect(0, "preview", "-j", str(threads), "--width", "20", "-o", "small", *files)
            told.add((done.out, tuple(self.pictures("small").items())))
        self.assertEqual(len(told), 1)

    def test_a_preview_holds_the_light(self):
        write_constant_hdr(self.folder / "grey.hdr", (128, 64, 192), 130, 64, 32)
        self.expect(0, "preview", "--width", "10", "-o", "small", "grey.hdr")
        whole = self.expect(0, "project", "--degree", "0", "grey.hdr").out.splitlines()[1].split(",")[4:]
        small = self.expect(0, "project", "--degree", "0", "small/000001.exr").out.splitlines()[1].split(",")[4:]
        for a, b in zip(map(float, whole), map(float, small)):
            self.assertAlmostEqual(a / b, 1, delta=3e-6)

    def test_formats(self):
        self.make_files()
        for name, mark in (("exr", b"\x76\x2f\x31\x01"), ("exr-half", b"\x76\x2f\x31\x01"), ("hdr", b"#?RADIANCE")):
            self.expect(0, "preview", "--width", "16", "--format", name, "-o", name, "a.hdr")
            (picture,) = self.pictures(name).values()
            self.assertTrue(picture.startswith(mark), name)
        self.assertIn("--format", self.expect(2, "preview", "--format", "gif", "-o", "x", "a.hdr").err)

    def test_a_bad_file_stops_no_other(self):
        self.make_files()
        self.write("bad.hdr", "no picture")
        (self.folder / "cut.hdr").write_bytes(rgbe_bytes(64, 32, b"\x80\x80\x80\x80" * 100))
        done = self.expect(1, "preview", "-o", "small", "a.hdr", "bad.hdr", "nowhere.exr", "cut.hdr", "c.hdr")
        lines = [json.loads(line) for line in done.out.splitlines()]
        self.assertEqual([("error" in line) for line in lines], [False, True, True, True, False])
        self.assertEqual(sorted(self.pictures("small")), ["000001.exr", "000005.exr"])
        self.assertEqual(done.err.count("failed: "), 3)
        for name, line in zip(("bad.hdr", "nowhere.exr", "cut.hdr"), lines[1:4]):
            self.assertIn(name, line["error"])
            self.assertIn(f"failed: {name}", done.err)

    def test_an_output_folder_that_cannot_be_made(self):
        self.make_files()
        self.write("small", "a file")
        done = self.expect(1, "preview", "-o", "small", "a.hdr")
        self.assertIn("failed: small: cannot be made", done.err)

    def test_usage(self):
        self.make_files()
        self.assertIn("--output", self.expect(2, "preview", "a.hdr").err)
        self.expect(2, "preview", "-o", "x")
        self.expect(2, "preview", "--width", "0", "-o", "x", "a.hdr")
        self.assertFalse((self.folder / "x").exists())

    def test_names_that_are_odd(self):
        name = b"-\xff\".hdr"
        write_hdr(self.folder / os.fsdecode(name), 1)
        done = self.expect(0, "preview", "-o", "small", "--", os.fsdecode(name))
        self.assertEqual(json.loads(done.out)["input"], "-�\".hdr")


if __name__ == "__main__":
    main()
