"""`shoal quality`, and quality.csv."""

import csv
import io
import json

import support
from support import ShoalTest, write_constant_hdr, write_hdr


def rows_of(text):
    return list(csv.DictReader(io.StringIO(text)))


class Quality(ShoalTest):
    def test_a_constant_picture(self):
        """Grey of radiance 1 is its own mean; nothing rings, nothing is dominant, and its colour is D65."""
        write_constant_hdr(self.folder / "a.hdr", (128, 128, 128), 129)
        row, = rows_of(self.expect(0, "quality", "a.hdr").out)
        self.assertEqual((row["panorama"], row["degree"], row["error_degree"]), ("a.hdr", "2", "32"))
        for name, value, delta in (("rms_error", 0, 1e-6), ("max_error", 0, 1e-5), ("minimum_irradiance", 1, 1e-5),
                                   ("negative_fraction", 0, 0), ("contrast", 0, 1e-5), ("mean_g", 1, 1e-6),
                                   ("directionality", 0, 1e-5), ("fill_temperature", 6504, 5)):
            self.assertAlmostEqual(float(row[name]), value, delta=delta, msg=name)
        shares = [float(share) for share in row["energy_shares"].split()]
        self.assertAlmostEqual(shares[0], 1, delta=1e-6)
        self.assertEqual(row["window_gains"], "1 1 1")
        self.assertEqual(row["nonfinite_pixels"], "0")

    def test_json_says_the_same(self):
        write_hdr(self.folder / "a.hdr", 1)
        write_hdr(self.folder / "b.hdr", 2)
        rows = rows_of(self.expect(0, "quality", "-j", "2", "--window", "auto", "a.hdr", "b.hdr").out)
        page = json.loads(self.expect(0, "quality", "-j", "1", "--window", "auto", "--format", "json",
                                      "a.hdr", "b.hdr").out)
        self.assertEqual(page["schema"], "shoal/quality")
        self.assertEqual([record["panorama"] for record in page["records"]], ["a.hdr", "b.hdr"])
        for row, record in zip(rows, page["records"]):
            self.assertEqual(list(row), list(record))
            for name in ("rms_error", "contrast", "mean_r", "dominant_x"):
                self.assertEqual(float(row[name]), record[name])
            self.assertEqual([float(gain) for gain in row["window_gains"].split()], record["window_gains"])

    def test_brute_force_agrees(self):
        """Both take a texel for one radiance over its area. Apart: degrees above 64, and the quadrature over
        the directions, below 1 % for a picture of random pixels."""
        write_hdr(self.folder / "a.hdr", 3)
        fast, = rows_of(self.expect(0, "quality", "--error-degree", "64", "a.hdr").out)
        slow_run = self.expect(0, "quality", "--error-degree", "64", "--brute-force", "--rows", "65", "a.hdr")
        slow, = rows_of(slow_run.out)
        self.assertAlmostEqual(float(slow["rms_error"]) / float(fast["rms_error"]), 1, delta=0.01)
        self.assertEqual(slow["error_degree"], "129")
        self.assertEqual(slow["mean_r"], fast["mean_r"])
        self.assertIn("100 %", slow_run.err)

    def test_mistakes(self):
        write_hdr(self.folder / "a.hdr", 1)
        self.assertIn("lanczos", self.expect(2, "quality", "--window", "lanczo", "a.hdr").err)
        self.expect(2, "quality", "--error-degree", "65", "a.hdr")
        self.assertIn("--error-degree", self.expect(2, "quality", "--degree", "4", "--error-degree", "4", "a.hdr").err)
        self.assertIn("or auto", self.expect(2, "quality", "--window", "foo", "a.hdr").err)
        for wrong in ("hann:", "hann:x", "hann:-1", "hann:4x", "none:4"):
            self.assertIn("hann:4", self.expect(2, "quality", "--window", wrong, "a.hdr").err)
        self.assertIn("missing.hdr", self.expect(1, "quality", "missing.hdr", "a.hdr").err)

    def test_the_table_of_a_run(self):
        write_hdr(self.folder / "lib/a.hdr", 1)
        self.write("m.yaml", "shoal: 1\ntables: [quality]\ndefaults: {quality: 20}\npanoramas: [{files: lib/*.hdr}]\n")
        self.expect(0, "run", "m.yaml")
        row, = rows_of((self.folder / "out/quality.csv").read_text())
        self.assertEqual(row["variant"], "plain")
        alone, = rows_of(self.expect(0, "quality", "--error-degree", "20", "lib/a.hdr").out)
        del row["variant"], row["panorama"], alone["panorama"]
        self.assertEqual(row, alone)


if __name__ == "__main__":
    support.main()
