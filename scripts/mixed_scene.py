#!/usr/bin/env python3
"""mixed_scene.py FILE: a scene (.npz) with every kind of body that has a kernel; one in three rests.

The same file everywhere: it takes the standard library alone, and no function whose last bit depends
on the machine.
"""

import random
import struct
import sys
import zipfile

BODIES, FRAMES, SIDE, DT = 600, 10, 9.0, 1 / 30
SPHERE, CAPSULE, AABB, BOX, DOP, MESH, HALFSPACE = 0, 1, 2, 3, 4, 6, 8
KINDS = [SPHERE, CAPSULE, AABB, BOX, DOP, MESH]


def npy(dtype, code, shape, values):
    """An array as bytes of an .npy file, version 1.0."""
    header = repr({"descr": dtype, "fortran_order": False, "shape": shape})
    header += " " * (-(len(header) + 11) % 64) + "\n"
    return (b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode()
            + struct.pack(f"<{len(values)}{code}", *values))


def vector(rng, reach):
    return [rng.uniform(-reach, reach) for _ in range(3)]


def params(rng, kind):
    size = [rng.uniform(0.1, 0.6) for _ in range(3)]
    return {
        SPHERE: size[:1],
        CAPSULE: vector(rng, 0.5) + vector(rng, 0.5) + [size[0] / 2],
        AABB: size,
        BOX: size,
        DOP: [rng.choice([6.0, 14.0, 18.0, 26.0])],
        MESH: [float(rng.random() < 0.3), size[0] / 4 if rng.random() < 0.3 else 0.0],
    }[kind]


def main(path):
    rng = random.Random(1)
    kinds = [rng.choice(KINDS) for _ in range(BODIES - 2)] + [HALFSPACE, HALFSPACE]
    shape_params, vertices, vertex_range, triangle_range = [], [], [], []
    for kind in kinds[:-2]:
        shape_params.append(params(rng, kind))
        count = {DOP: 12, MESH: 3}.get(kind, 0)
        vertex_range += [len(vertices), count]
        vertices += [vector(rng, 0.5) for _ in range(count)]
        triangle_range += [sum(triangle_range[1::2]), int(kind == MESH)]
    shape_params += [[0.0, 0.0, 1.0, 0.3], [1.0, 0.0, 1.0, 0.5]]
    vertex_range += [0, 0, 0, 0]
    triangle_range += [0, 0, 0, 0]

    start = [[rng.uniform(0, SIDE) for _ in range(3)] for _ in kinds]
    turned = [[rng.uniform(-1, 1) for _ in range(4)] for _ in kinds]
    pace = [float(rng.random() < 2 / 3) for _ in kinds]
    velocity = [vector(rng, 3 * p) for p in pace]
    spin = [[p * rng.uniform(-0.02, 0.02) for _ in range(4)] for p in pace]
    position, orientation = [], []
    for frame in range(FRAMES):
        for body in range(BODIES):
            position += [x + frame * DT * v for x, v in zip(start[body], velocity[body])]
            orientation += [q + frame * w for q, w in zip(turned[body], spin[body])]

    def flat(rows):
        return [number for row in rows for number in row]

    floats, words = ("<f4", "f"), ("<u4", "I")
    triangles = kinds.count(MESH)
    members = {
        "carom_version": npy("<i4", "i", (1,), [1]),
        "shape_kind": npy("|u1", "B", (BODIES,), kinds),
        "shape_params": npy(*floats, (BODIES, 8), flat((p + [0.0] * 8)[:8] for p in shape_params)),
        "shape_vertex_range": npy(*words, (BODIES, 2), vertex_range),
        "vertices": npy(*floats, (len(vertices), 3), flat(vertices)),
        "shape_triangle_range": npy(*words, (BODIES, 2), triangle_range),
        "triangles": npy(*words, (triangles, 3), [0, 1, 2] * triangles),
        "body_shape": npy(*words, (BODIES,), range(BODIES)),
        "position": npy(*floats, (FRAMES, BODIES, 3), position),
        "orientation": npy(*floats, (FRAMES, BODIES, 4), orientation),
        "linear_velocity": npy(*floats, (FRAMES, BODIES, 3), flat(velocity) * FRAMES),
        "dt": npy("<f8", "d", (1,), [DT]),
    }
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in members.items():
            archive.writestr(zipfile.ZipInfo(name + ".npy"), data)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__.splitlines()[0])
    main(sys.argv[1])
