"""Light that tests make: panoramas of a few soft lights, and tables of light in closed form.

Directions are those of the native frame: theta from the picture's top row, phi from its left column to the
right, (x, y, z) = (sin theta cos phi, sin theta sin phi, cos theta).
"""

import math
import pathlib
import sys

HEADER = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n"


def rgbe(colour):
    """Greg Ward's shared exponent: mantissas of 8 bits, the largest from 128 to 255."""
    largest = max(colour)
    if largest < 1e-32:
        return bytes(4)
    exponent = math.frexp(largest)[1]
    return bytes([*(int(math.ldexp(c, 8 - exponent)) for c in colour), exponent + 128])


def sky_with_lights(lights, sky=(0.35, 0.45, 0.6), ground=(0.14, 0.12, 0.1)):
    """Radiance in a direction: sky over ground, softly parted, and lights (direction, colour, sharpness)."""
    lights = [(tuple(c / math.hypot(*direction) for c in direction), colour, sharpness)
              for direction, colour, sharpness in lights]

    def radiance(d):
        part = 1.0 / (1.0 + math.exp(-12.0 * d[2]))
        colour = [part * s + (1.0 - part) * g for s, g in zip(sky, ground)]
        for direction, light, sharpness in lights:
            lobe = math.exp(sharpness * (sum(a * b for a, b in zip(d, direction)) - 1.0))
            colour = [c + lobe * e for c, e in zip(colour, light)]
        return colour
    return radiance


def write_panorama(path, radiance, width=128):
    """An equirect Radiance picture, not packed."""
    height = width // 2
    texels = bytearray()
    for row in range(height):
        theta = math.pi * (row + 0.5) / height
        for column in range(width):
            phi = 2.0 * math.pi * (column + 0.5) / width
            texels += rgbe(radiance((math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi),
                                     math.cos(theta))))
    path.write_bytes(HEADER.format(height, width).encode() + texels)


DEGREE = 4


def light_from_above(colour=(1.0, 0.9, 0.7)):
    """A light at +z and nothing else, to degree 4: L_lm = colour Y_lm(0, 0, 1), zero but for m = 0, where
    it is sqrt((2 l + 1) / (4 pi))."""
    return {(l, 0): [c * math.sqrt((2 * l + 1) / (4 * math.pi)) for c in colour] for l in range(DEGREE + 1)}


def sky_over_ground(sky=(0.6, 0.8, 1.2), ground=(0.3, 0.2, 0.1)):
    """The mean of both plus half their difference times z: degree 0 and 1 are all of it, and Y_00 =
    1 / sqrt(4 pi), Y_10 = sqrt(3 / (4 pi)) z give the coefficients."""
    return {(0, 0): [0.5 * (s + g) * math.sqrt(4 * math.pi) for s, g in zip(sky, ground)],
            (1, 0): [0.5 * (s - g) * math.sqrt(4 * math.pi / 3) for s, g in zip(sky, ground)]}


def write_table(path, panoramas, degree=DEGREE, variant=""):
    """Radiance of panoramas, {name: {(l, m): [r, g, b]}}, as a table of shoal."""
    rows = ["panorama,variant,quantity,l,m,r,g,b"]
    for name, coefficients in panoramas.items():
        for l in range(degree + 1):
            for m in range(-l, l + 1):
                rgb = coefficients.get((l, m), [0.0, 0.0, 0.0])
                rows.append(f"{name},{variant},radiance,{l},{m}," + ",".join(f"{c:.17g}" for c in rgb))
    path.write_text("\n".join(rows) + "\n")


def write_library(folder):
    """light.csv: a light from above, and sky over ground. And panoramas: harbour.hdr, studio.hdr, dusk.hdr."""
    folder.mkdir(parents=True, exist_ok=True)
    write_table(folder / "light.csv", {"light at +z": light_from_above(), "sky over ground": sky_over_ground()})
    for name, radiance in (
            ("dusk", sky_with_lights([((-0.8, 0.5, 0.1), (4.0, 1.6, 0.5), 18.0)], (0.1, 0.12, 0.3), (0.04, 0.03, 0.05))),
            ("harbour", sky_with_lights([((-0.7, -0.5, 0.6), (9.0, 8.0, 6.0), 40.0),
                                         ((0.9, 0.2, 0.1), (0.3, 0.6, 1.4), 10.0)])),
            ("studio", sky_with_lights([((0.2, -0.9, 0.4), (6.0, 6.0, 6.0), 30.0),
                                        ((-0.9, 0.3, 0.3), (2.5, 1.0, 0.6), 20.0),
                                        ((0.5, 0.8, -0.2), (0.4, 0.8, 2.5), 20.0)],
                                       (0.12, 0.12, 0.12), (0.1, 0.1, 0.1)))):
        write_panorama(folder / f"{name}.hdr", radiance)


if __name__ == "__main__":
    write_library(pathlib.Path(sys.argv[1]))
