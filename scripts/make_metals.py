#!/usr/bin/env python3
"""Computes src/bsdf/metals.def, the indices of refraction of named conductors, from measured curves.

    scripts/make_metals.py FOLDER > src/bsdf/metals.def

FOLDER holds NAME.eta.spd and NAME.k.spd for every material: lines of wavelength in nm and value; '#' begins a comment.
The three numbers of a curve are what a renderer that works in RGB makes of it: weighed with the CIE 1931 2-degree
observer, scaled so that luminance is the mean weighed with y, converted to linear sRGB, cut off at 0. A curve is linear
between its wavelengths and 0 outside of them, as in Mitsuba: the comments give the range, for some end too early.
"""
import pathlib
import re
import sys

CIE_TABLES = pathlib.Path(__file__).resolve().parent.parent / "src/color/cie_tables.h"

HEADER = """\
// Written by scripts/make_metals.py from measured curves: index of refraction eta + i k of conductors as linear sRGB.
// Before each: what its files say it is and where it is from, and the wavelengths in nm that it spans; all of them add
// "data from www.luxpop.com database".
// clang-format off
"""


def read_observer():
    """[(wavelength, (x, y, z))], from the table that src/color integrates with."""
    text = CIE_TABLES.read_text()
    first = float(re.search(r"kCieFirstWavelength = ([\d.]+)", text)[1])
    step = float(re.search(r"kCieStep = ([\d.]+)", text)[1])
    rows = re.findall(r"\{([-+.\de]+), ([-+.\de]+), ([-+.\de]+), [-+.\de]+\}", text)
    return [(first + i * step, tuple(map(float, row))) for i, row in enumerate(rows)]


def inverse(m):
    """Of a 3x3 matrix."""
    def minor(i, j):
        rows = [[m[r][c] for c in range(3) if c != j] for r in range(3) if r != i]
        return rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0]
    determinant = sum((-1) ** j * m[0][j] * minor(0, j) for j in range(3))
    return [[(-1) ** (i + j) * minor(j, i) / determinant for j in range(3)] for i in range(3)]


def times(m, v):
    return [sum(a * b for a, b in zip(row, v)) for row in m]


def srgb_from_xyz():
    """From the chromaticities of IEC 61966-2-1: primaries and white (D65)."""
    def xyz(x, y):
        return [x / y, 1, (1 - x - y) / y]
    columns = [xyz(0.64, 0.33), xyz(0.30, 0.60), xyz(0.15, 0.06)]
    primaries = [[column[i] for column in columns] for i in range(3)]
    scale = times(inverse(primaries), xyz(0.3127, 0.3290))
    return inverse([[a * s for a, s in zip(row, scale)] for row in primaries])


def interpolate(samples, x):
    """Value of a piecewise linear curve of (position, value) inside its range."""
    for (x0, v0), (x1, v1) in zip(samples, samples[1:]):
        if x0 <= x <= x1:
            return v0 + (v1 - v0) * (x - x0) / (x1 - x0)
    raise ValueError(f"{x} lies outside of the curve")


def integrate(curve, observer):
    """X, Y, Z of a curve, not normalised; Simpson's rule is exact between the knots of both tables."""
    low, high = max(curve[0][0], observer[0][0]), min(curve[-1][0], observer[-1][0])
    knots = sorted({low, high} | {w for w, _ in curve + observer if low < w < high})
    sums = [0.0, 0.0, 0.0]
    for a, b in zip(knots, knots[1:]):
        for w, weight in ((a, 1), ((a + b) / 2, 4), (b, 1)):
            value = interpolate(curve, w) * weight * (b - a) / 6
            for k in range(3):
                sums[k] += value * interpolate([(v, row[k]) for v, row in observer_around(observer, w)], w)
    return sums


def observer_around(observer, wavelength):
    step = observer[1][0] - observer[0][0]
    i = min(int((wavelength - observer[0][0]) / step), len(observer) - 2)
    return observer[i:i + 2]


def read_curve(path):
    """[(wavelength, value)] in ascending order, and what the comments say."""
    curve, comments = [], []
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        line = line.strip()
        if line.startswith("#"):
            comments.append(line.lstrip("#; \t").strip())
        elif line:
            wavelength, value = map(float, line.split())
            curve.append((wavelength, value))
    if len(curve) < 2 or any(a[0] >= b[0] for a, b in zip(curve, curve[1:])):
        sys.exit(f"{path}: expected at least two lines of ascending wavelengths")
    return curve, comments


def describe(comments):
    """The comments in one line, without headings and rules."""
    noise = r"(Lambda|-+$|Concatenation of|taken from|Academic Press|data from www.luxpop.com database)"
    text = "; ".join(c.rstrip(",") for c in comments if c and not re.match(noise, c))
    text = re.sub("Optical constants for ", "", text)
    text = re.sub(r"'(Handbook.*)', Ed. by Edward D. Palik", r"Palik (ed.), \1", text)
    return ", ".join([text] + re.findall(r"Academic Press, Inc., (\d+)", " ".join(comments)))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n\n")[1])
    folder = pathlib.Path(sys.argv[1])
    observer, matrix = read_observer(), srgb_from_xyz()
    white = integrate([(observer[0][0], 1.0), (observer[-1][0], 1.0)], observer)

    def rgb(curve):
        color = times(matrix, [v / white[1] for v in integrate(curve, observer)])
        return "{" + ", ".join(f"{max(0.0, v):.6g}" for v in color) + "}"

    print(HEADER, end="")
    for path in sorted(folder.glob("*.eta.spd"), key=lambda p: (p.name.lower(), p.name)):
        name = path.name.removesuffix(".eta.spd")
        eta, comments = read_curve(path)
        k, _ = read_curve(folder / f"{name}.k.spd")
        low, high = max(eta[0][0], k[0][0]), min(eta[-1][0], k[-1][0])
        print(f'// {describe(comments)}; {low:.0f} to {high:.0f}\n{{"{name}", {rgb(eta)}, {rgb(k)}}},')


main()
