#!/usr/bin/env python3
"""stack_scene.py FILE [drums | crates | both] [TILT]: a scene (.npz) of 10,000 bodies of 1 m in stacks
of five on a half-space, ten frames in which they turn a little; TILT: radians by which each leans at
most, 1e-3.

The same file everywhere, as of mixed_scene.py.
"""

import math
import random
import sys
import zipfile

from mixed_scene import npy

ROWS, COLUMNS, HIGH, FRAMES, DT = 100, 20, 5, 10, 1 / 60
CYLINDER, BOX, HALFSPACE = 9, 3, 8
DRUM, CRATE, PLANE = 0, 1, 2  # shapes
SHAPES = [(CYLINDER, [0.5, 0.5]), (BOX, [0.45, 0.45, 0.5]), (HALFSPACE, [0.0, 0.0, 1.0, 0.0])]
SHAPE_OF_LEVEL = {"drums": [DRUM], "crates": [CRATE], "both": [DRUM, CRATE]}


def draw_bodies(tilt):
    """Places, and the three parts of a rotation vector: about x, y and z."""
    rng = random.Random(3)
    for i in range(ROWS * COLUMNS):
        for level in range(HIGH):
            x, y = i // COLUMNS * 1.3, i % COLUMNS * 1.3
            z = 0.5 + level - 0.002 * (level + 1)
            yield ([x + rng.uniform(-0.02, 0.02), y + rng.uniform(-0.02, 0.02), z],
                   [tilt * rng.uniform(-1, 1), tilt * rng.uniform(-1, 1), rng.uniform(0, 3)])


def quaternion(x, y, z):
    q = [x / 2, y / 2, math.sin(z / 2), math.cos(z / 2)]
    size = math.sqrt(sum(v * v for v in q))
    return [v / size for v in q]


def main(path, name="both", tilt="1e-3"):
    bodies = list(draw_bodies(float(tilt)))
    count = len(bodies) + 1
    position, orientation = [], []
    for frame in range(FRAMES):
        for (x, y, z), (around_x, around_y, around_z) in bodies:
            position += [x + 1e-4 * frame, y, z]
            orientation += quaternion(around_x, around_y, around_z + 1e-3 * frame)
        position += [0.0, 0.0, 0.0]
        orientation += [0.0, 0.0, 0.0, 1.0]
    levels = SHAPE_OF_LEVEL[name]
    floats, words = ("<f4", "f"), ("<u4", "I")
    params = [number for _, given in SHAPES for number in (given + [0.0] * 8)[:8]]
    members = {
        "carom_version": npy("<i4", "i", (1,), [1]),
        "shape_kind": npy("|u1", "B", (len(SHAPES),), [kind for kind, _ in SHAPES]),
        "shape_params": npy(*floats, (len(SHAPES), 8), params),
        "body_shape": npy(*words, (count,), [levels[i % HIGH % len(levels)]
                                             for i in range(count - 1)] + [PLANE]),
        "position": npy(*floats, (FRAMES, count, 3), position),
        "orientation": npy(*floats, (FRAMES, count, 4), orientation),
        "dt": npy("<f8", "d", (1,), [DT]),
    }
    with zipfile.ZipFile(path, "w") as archive:
        for member, data in members.items():
            archive.writestr(zipfile.ZipInfo(member + ".npy"), data)


if __name__ == "__main__":
    if not 2 <= len(sys.argv) <= 4 or (len(sys.argv) > 2 and sys.argv[2] not in SHAPE_OF_LEVEL):
        sys.exit(__doc__.splitlines()[0])
    main(*sys.argv[1:])
