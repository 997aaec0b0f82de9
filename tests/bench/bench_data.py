"""The files that are measured, made when they are first asked for and kept in a cache folder."""
import pathlib
import shutil
import struct
import subprocess

# Those of this version of the painter; another version wants other names.
PAINTER = 1


class Library:
    """Made panoramas in a folder."""

    def __init__(self, folder, make_panoramas, sizes):
        self.folder = pathlib.Path(folder)
        self.make_panoramas = make_panoramas
        self.sizes = sizes
        self.folder.mkdir(parents=True, exist_ok=True)

    def picture(self, kind, size, seed=1):
        """The path of a picture: `kind` as make_panoramas names it, `size` a key of the sizes."""
        extent = self.sizes[size]
        suffix = "hdr" if kind == "hdr" else "exr"
        path = self.folder / f"{kind}-{extent}-{seed}-v{PAINTER}.{suffix}"
        if not path.exists():
            subprocess.run([self.make_panoramas, extent, "--seed", str(seed), f"{kind}={path}"], check=True)
        return path

    def batch(self, kind, size, count):
        return [self.picture(kind, size, seed) for seed in range(1, count + 1)]

    def manifest(self, count):
        """A manifest whose pattern yields `count` tiny pictures, in folders of 1000, all different."""
        folder = self.folder / f"library-{count}"
        manifest = folder / "library.yaml"
        if not manifest.exists():
            shutil.rmtree(folder, ignore_errors=True)
            for index in range(count):
                path = folder / "pictures" / f"{index // 1000:03}" / f"{index:06}.hdr"
                if index % 1000 == 0:
                    path.parent.mkdir(parents=True)
                path.write_bytes(tiny_picture(index))
            manifest.write_text('shoal: 1\noutput: out\npanoramas:\n  - files: "pictures/**/*.hdr"\n')
        return manifest

    def disk_use(self):
        """Bytes on the disk, in whole blocks."""
        return sum(path.lstat().st_blocks * 512 for path in self.folder.rglob("*"))


def tiny_picture(index):
    """8x4 flat RGBE texels; the index is in the mantissas of the first two."""
    texels = bytearray()
    for place in range(32):
        texels += bytes([200 - place, 128 + place, 140 + 2 * place, 128])
    texels[1:3] = struct.pack(">H", index % 65536)
    texels[5] = index // 65536
    return b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n" + bytes(texels)
