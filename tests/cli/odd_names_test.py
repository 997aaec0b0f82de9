"""Names as file systems allow them."""

import csv
import io
import json
import os

import support
from support import ShoalTest, write_exr, write_hdr


class Names(ShoalTest):
    def panoramas(self):
        rows = csv.DictReader(io.StringIO(self.table().decode("utf-8", "surrogateescape"), newline=""))
        return list(dict.fromkeys(row["panorama"] for row in rows))

    def run_library(self, names, status=0):
        for seed, name in enumerate(names):
            write_hdr(self.folder / "lib" / name, seed)
        self.write_manifest("tables: [csv, json, npy]\nmaps: [{kind: irradiance, size: [8, 4], format: hdr}]\n")
        return self.expect(status, "run", "m.yaml")

    def test_blanks_unicode_and_punctuation(self):
        names = ["a b.hdr", " lead.hdr", "Küche 光.hdr", "comma, \"quotes\".hdr", "it's.hdr", "100%.hdr", "-dash.hdr",
                 "#hash.hdr", "a=b;c&d.hdr", "{brace}.hdr", "[class].hdr", "back\\slash.hdr", "dots.in.name.hdr"]
        self.run_library(names)
        stems = sorted((name[:-4] for name in names), key=os.fsencode)
        self.assertEqual(self.panoramas(), stems)
        maps = sorted(path.name for path in (self.folder / "out/maps").iterdir())
        self.assertEqual(maps, sorted(stem + ".irradiance.hdr" for stem in stems))
        records = json.loads(self.table("coefficients.json"))["records"]
        self.assertEqual([record["panorama"] for record in records[::2]], stems)
        self.expect(0, "verify", "--recompute", "out")
        self.assertIn(f"{len(names)} up to date", self.expect(0, "run", "m.yaml").err)

    def test_line_ends_are_refused_or_kept_but_never_printed(self):
        """A name with a control character cannot be a name of outputs; what is said of it is one line."""
        write_hdr(self.folder / "lib/two\nlines \x1b[31m.hdr", 1)
        self.write_manifest()
        done = self.shoal("run", "m.yaml")
        self.assertIn(done.status, (0, 2), done)
        self.assertNotIn("\x1b", done.err)
        write_hdr(self.folder / "two\nlines\x1b[31m.hdr", 1)
        rows = list(csv.reader(io.StringIO(self.expect(0, "project", "two\nlines\x1b[31m.hdr").out, newline="")))
        self.assertEqual({row[0] for row in rows[1:]}, {"two\nlines\x1b[31m.hdr"})
        done = self.expect(1, "project", "missing\n\x1b[31m.hdr")
        self.assertEqual(len(done.err.splitlines()), 1)
        self.assertNotIn("\x1b", done.err)

    def test_bytes_that_are_not_utf8(self):
        name = os.fsdecode(b"latin\xe9.hdr")
        done = self.run_library([name])
        self.assertIn("1 panorama done", done.err)
        self.assertEqual(self.panoramas(), [name[:-4]])
        record = json.loads(self.table("coefficients.json"))["records"][0]
        self.assertEqual(bytes.fromhex(record["panorama_hex"]), b"latin\xe9")
        self.assertTrue((self.folder / "out/maps" / (name[:-4] + ".irradiance.hdr")).is_file())
        self.expect(0, "verify", "out")

    def test_one_stem_and_two_extensions(self):
        write_hdr(self.folder / "lib/a.hdr", 1)
        write_exr(self.folder / "lib/a.exr", 2)
        write_hdr(self.folder / "lib/b.hdr", 3)
        self.write_manifest("maps: [{kind: irradiance, size: [8, 4], format: hdr}]\n")
        self.expect(0, "run", "m.yaml")
        self.assertEqual(self.panoramas(), ["a.exr", "a.hdr", "b"])
        self.assertEqual(sorted(path.name for path in (self.folder / "out/maps").iterdir()),
                         ["a.exr.irradiance.hdr", "a.hdr.irradiance.hdr", "b.irradiance.hdr"])

    def test_folders_are_part_of_names(self):
        self.run_library(["a.hdr", "x/a.hdr", "x/y/a.hdr"])
        self.assertEqual(self.panoramas(), ["a", "x/a", "x/y/a"])
        self.assertTrue((self.folder / "out/maps/x/y/a.irradiance.hdr").is_file())

    def test_a_manifest_in_an_odd_folder(self):
        odd = self.folder / "möbel, \"alt\" 光"
        odd.mkdir()
        write_hdr(odd / "lib/a.hdr", 1)
        (odd / "m.yaml").write_text('shoal: 1\noutput: "o ut"\npanoramas: [{files: "lib/*.hdr"}]\n')
        self.expect(0, "run", odd / "m.yaml")
        self.assertTrue((odd / "o ut/coefficients.csv").is_file())


if __name__ == "__main__":
    support.main()
