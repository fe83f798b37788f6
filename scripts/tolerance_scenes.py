#!/usr/bin/env python3
"""Writes the scenes by which docs/accuracy.md measures what a tolerance buys.

  tolerance_scenes.py hulls OUT.npz                 10,000 hulls of 64 corners, tumbling
  tolerance_scenes.py bevelled OUT.npz              10,000 boxes with bevelled edges, as hulls
  tolerance_scenes.py compounds OUT.npz             1,000 compounds of 20 hulls that creep
  tolerance_scenes.py meshes OUT.npz --models DIR   50 scanned models, tumbling
  tolerance_scenes.py terrain OUT.npz --models DIR  2,000 bodies on three scanned models

--frames N: how many frames, 30 by default.

DIR holds OFF files: data/meshes of CGAL's data (Debian: libcgal-demo, data.tar.gz).
"""

import argparse
import array
import math
import pathlib
import random
import struct
import zipfile

FRAMES, DT = 30, 1 / 60
MODELS = ["bull", "knot2", "lion", "blade", "lion-head", "turbine", "camel", "ChineseDragon-10kv",
          "bear_bis", "mannequin-devil", "bear", "fandisk_large", "man", "diplodocus", "armadillo",
          "bunny00", "refined_elephant", "cheese", "b9_mesh"]
GROUND = ["refined_elephant", "bunny00", "armadillo"]
SPHERE, BOX, HULL, MESH, COMPOUND = 0, 3, 5, 6, 7
TYPES = {"f": "<f4", "d": "<f8", "B": "|u1", "I": "<u4", "i": "<i4"}


def read_off(path):
    """The vertices about the middle, scaled to a radius of 1, and the triangles."""
    words = path.read_text().split()
    place = 1 if words[0] == "OFF" else 0
    vertex_count, face_count = int(words[place]), int(words[place + 1])
    place += 3
    numbers = [float(w) for w in words[place:place + 3 * vertex_count]]
    vertices = [tuple(numbers[3 * i:3 * i + 3]) for i in range(vertex_count)]
    place += 3 * vertex_count
    triangles = []
    for _ in range(face_count):
        corners = [int(w) for w in words[place + 1:place + 1 + int(words[place])]]
        place += 1 + len(corners)
        triangles += [(corners[0], corners[k], corners[k + 1]) for k in range(1, len(corners) - 1)]
    middle = [(min(p[c] for p in vertices) + max(p[c] for p in vertices)) / 2 for c in range(3)]
    radius = max(math.dist(p, middle) for p in vertices)
    return [tuple((p[c] - middle[c]) / radius for c in range(3)) for p in vertices], triangles


def product(a, b):
    x, y, z, w = a
    X, Y, Z, W = b
    return [w * X + x * W + y * Z - z * Y, w * Y - x * Z + y * W + z * X,
            w * Z + x * Y - y * X + z * W, w * W - x * X - y * Y - z * Z]


def turned(orientation, spin):
    angle = math.sqrt(sum(x * x for x in spin)) * DT
    if angle == 0:
        return orientation
    factor = math.sin(angle / 2) / angle * DT
    return product([factor * x for x in spin] + [math.cos(angle / 2)], orientation)


class Draw:
    def __init__(self):
        self.random = random.Random(1)

    def unit(self, count):
        numbers = [self.random.gauss(0, 1) for _ in range(count)]
        length = math.sqrt(sum(x * x for x in numbers))
        return [x / length for x in numbers]

    def vector(self, most):
        length = most * self.random.random()
        return [length * x for x in self.unit(3)]

    def hull(self, points, radius):
        return [tuple(radius * x for x in self.unit(3)) for _ in range(points)]

    def place(self, side):
        return [self.random.uniform(0, side) for _ in range(3)]


class Scene:
    def __init__(self, frames):
        self.frame_count = frames
        self.kind, self.params = [], []
        self.vertex_range, self.vertices = [], []
        self.triangle_range, self.triangles = [], []
        self.child_range, self.children = [], []
        self.bodies = []  # shape, motion, position, orientation, velocity, spin

    def add_shape(self, kind, params=(), vertices=(), triangles=(), children=()):
        self.kind.append(kind)
        self.params.append(list(params) + [0] * (8 - len(params)))
        for ranges, items, new in ((self.vertex_range, self.vertices, vertices),
                                   (self.triangle_range, self.triangles, triangles),
                                   (self.child_range, self.children, children)):
            ranges.append((len(items), len(new)))
            items += new
        return len(self.kind) - 1

    def add_body(self, shape, position, draw, speed, spin):
        self.bodies.append((shape, 2, position, draw.unit(4), draw.vector(speed), draw.vector(spin)))

    def write(self, path):
        with zipfile.ZipFile(path, "w") as archive:
            def write(name, code, columns, rows):
                shape = (len(rows), columns) if columns else (len(rows),)
                self.write_array(archive, name, code, shape, rows)

            write("carom_version", "i", 0, [1])
            write("shape_kind", "B", 0, self.kind)
            write("shape_params", "f", 8, self.params)
            write("shape_vertex_range", "I", 2, self.vertex_range)
            write("vertices", "f", 3, self.vertices or [(0, 0, 0)])
            write("shape_triangle_range", "I", 2, self.triangle_range)
            write("triangles", "I", 3, self.triangles or [(0, 0, 0)])
            write("shape_child_range", "I", 2, self.child_range)
            if self.children:
                write("child_shape", "I", 0, [child[0] for child in self.children])
                write("child_position", "f", 3, [child[1] for child in self.children])
                write("child_orientation", "f", 4, [child[2] for child in self.children])
            write("body_shape", "I", 0, [body[0] for body in self.bodies])
            write("body_motion", "B", 0, [body[1] for body in self.bodies])
            write("dt", "d", 0, [DT])
            for name, columns, frames in self.frames():
                shape = (self.frame_count, len(self.bodies), columns)
                self.write_array(archive, name, "f", shape, frames)

    def frames(self):
        positions, orientations = [], []
        now = [(body[2], body[3]) for body in self.bodies]
        for _ in range(self.frame_count):
            positions += [position for position, _ in now]
            orientations += [orientation for _, orientation in now]
            now = [([p + DT * v for p, v in zip(position, body[4])], turned(orientation, body[5]))
                   for (position, orientation), body in zip(now, self.bodies)]
        yield "position", 3, positions
        yield "orientation", 4, orientations
        yield "linear_velocity", 3, [body[4] for body in self.bodies] * self.frame_count
        yield "angular_velocity", 3, [body[5] for body in self.bodies] * self.frame_count

    @staticmethod
    def write_array(archive, name, code, shape, rows):
        flat = rows if rows and not hasattr(rows[0], "__len__") else [x for row in rows for x in row]
        sizes = ", ".join(map(str, shape)) + ("," if len(shape) == 1 else "")
        header = f"{{'descr': '{TYPES[code]}', 'fortran_order': False, 'shape': ({sizes}), }}"
        header = header.ljust((len(header) + 11 + 63) // 64 * 64 - 11) + "\n"
        archive.writestr(name + ".npy", b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) +
                         header.encode() + array.array(code, flat).tobytes())


def make_hulls(draw, scene, _):
    shapes = [scene.add_shape(HULL, vertices=draw.hull(64, 0.5)) for _ in range(16)]
    side = (10000 * 0.52 / 0.3) ** (1 / 3)
    for i in range(10000):
        scene.add_body(shapes[i % 16], draw.place(side), draw, 0.5, 1)


def bevelled_corners(half, bevel):
    corners = []
    for axis in range(3):
        face = [x - (0 if k == axis else bevel) for k, x in enumerate(half)]
        corners += [tuple(x if i >> k & 1 else -x for k, x in enumerate(face)) for i in range(8)]
    return corners


def make_bevelled(draw, scene, _):
    shapes = []
    for _ in range(16):
        half = [draw.random.uniform(0.15, 0.4) for _ in range(3)]
        shapes.append(scene.add_shape(HULL, vertices=bevelled_corners(half, 0.004)))
    side = (10000 * 0.52 / 0.58) ** (1 / 3)
    for i in range(10000):
        scene.add_body(shapes[i % 16], draw.place(side), draw, 0.5, 1)


def make_compounds(draw, scene, _):
    hulls = [scene.add_shape(HULL, vertices=draw.hull(draw.random.randint(12, 40), 0.25))
             for _ in range(24)]
    compounds = []
    for _ in range(8):
        children = [(draw.random.choice(hulls), draw.vector(0.4), draw.unit(4)) for _ in range(20)]
        compounds.append(scene.add_shape(COMPOUND, children=children))
    side = (1000 * 0.88 / 0.5) ** (1 / 3)
    for i in range(1000):
        scene.add_body(compounds[i % 8], draw.place(side), draw, 0.05, 0.1)


def make_meshes(draw, scene, models):
    for name in MODELS:
        vertices, triangles = read_off(models / (name + ".off"))
        scene.add_shape(MESH, vertices=vertices, triangles=triangles)
    for i in range(50):
        scene.add_body(i % len(MODELS), draw.place(6.5), draw, 0.5, 1)


def make_terrain(draw, scene, models):
    vertices, triangles = [], []
    for i, name in enumerate(GROUND):
        own, corners = read_off(models / (name + ".off"))
        first = len(vertices)
        vertices += [(15 * x + 22 * i, 15 * y, 15 * z) for x, y, z in own]
        triangles += [(first + a, first + b, first + c) for a, b, c in corners]
    ground = scene.add_shape(MESH, vertices=vertices, triangles=triangles)
    scene.bodies.append((ground, 0, [0, 0, 0], [0, 0, 0, 1], [0, 0, 0], [0, 0, 0]))
    shapes = [scene.add_shape(SPHERE, [0.25]), scene.add_shape(BOX, [0.3, 0.2, 0.25])]
    shapes += [scene.add_shape(HULL, vertices=draw.hull(16, 0.35)) for _ in range(6)]
    for _ in range(2000):
        a, b, c = (vertices[v] for v in draw.random.choice(triangles))
        u, v = [b[k] - a[k] for k in range(3)], [c[k] - a[k] for k in range(3)]
        normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        length = math.sqrt(sum(x * x for x in normal)) or 1
        height = draw.random.uniform(0.2, 0.4)
        place = [a[k] + height * normal[k] / length for k in range(3)]
        scene.add_body(draw.random.choice(shapes), place, draw, 0.05, 0.1)


def main():
    makers = {"hulls": make_hulls, "bevelled": make_bevelled, "compounds": make_compounds,
              "meshes": make_meshes, "terrain": make_terrain}
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", choices=makers)
    parser.add_argument("out")
    parser.add_argument("--frames", type=int, default=FRAMES)
    parser.add_argument("--models", type=pathlib.Path, default=pathlib.Path("."))
    options = parser.parse_args()
    scene = Scene(options.frames)
    makers[options.scene](Draw(), scene, options.models)
    scene.write(options.out)


if __name__ == "__main__":
    main()
