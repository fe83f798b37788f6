#!/usr/bin/env python3
"""random_mjcf.py FIRST_SEED COUNT FOLDER: writes random models, one a seed.

For carom_mujoco_models, which compares how Carom and MuJoCo read them: nested bodies and classes,
all forms of orientation, fromto, meshes, bits of contact, excludes.
"""

import pathlib
import random
import sys

SIZES = {"sphere": 1, "capsule": 2, "cylinder": 2, "box": 3, "ellipsoid": 3}


class Model:
    def __init__(self, seed):
        self.random = random.Random(seed)
        self.lines, self.classes, self.meshes, self.bodies = [], [], [], []

    def chance(self, share):
        return self.random.random() < share

    def numbers(self, count, most=1.0):
        return " ".join(f"{self.random.uniform(-most, most):.6g}" for _ in range(count))

    def sizes(self, count):
        return " ".join(f"{self.random.uniform(0.05, 0.5):.5g}" for _ in range(count))

    def orientation(self):
        turn = 180 if self.in_degrees else 3.14
        return self.random.choice([
            f'quat="{self.numbers(4)}"',
            f'axisangle="{self.numbers(3)} {self.random.uniform(-turn, turn):.5g}"',
            f'xyaxes="{self.numbers(6)}"',
            f'zaxis="{self.numbers(3)}"',
            f'euler="{self.numbers(3, turn)}"',
            "",
        ])

    def bits(self):
        if self.chance(0.5):
            return ""
        contype, conaffinity = self.random.choice([0, 1, 2, 3, 5]), self.random.choice([0, 1, 2, 4])
        return f'contype="{contype}" conaffinity="{conaffinity}"'

    def class_of(self, attribute):
        named = self.classes and self.chance(0.3)
        return f'{attribute}="{self.random.choice(self.classes)}"' if named else ""

    def default_geom(self):
        shape = ""
        if self.chance(0.4):
            shape = f'type="{self.random.choice(list(SIZES))}" size="{self.sizes(3)}"'
        return f"<geom {shape} {self.bits()}/>"

    def add_class(self, name, depth):
        self.lines.append(f'<default class="{name}">')
        self.classes.append(name)
        if self.chance(0.8):
            self.lines.append(self.default_geom())
        if self.chance(0.3):
            self.lines.append(f'<mesh scale="{self.numbers(3)}"/>')
        for i in range(self.random.randrange(3) if depth < 2 else 0):
            self.add_class(f"{name}{i}", depth + 1)
        self.lines.append("</default>")

    def add_mesh(self, name):
        mesh = f'<mesh name="{name}" vertex="{self.numbers(3 * 8)}" {self.class_of("class")}'
        if self.chance(0.4):
            mesh += f' scale="{self.sizes(3)}"'
        if self.chance(0.4):
            mesh += f' refpos="{self.numbers(3)}"'
        if self.chance(0.4):
            mesh += f' refquat="{self.numbers(4)}"'
        self.lines.append(mesh + "/>")
        self.meshes.append(name)

    def geom(self, in_world=False):
        place = f'pos="{self.numbers(3)}" {self.orientation()}'
        kind = self.random.random()
        if in_world and kind < 0.2:
            shape = f'type="plane" size="0 0 1" {place}'
        elif self.meshes and kind < 0.4:
            shape = f'type="mesh" mesh="{self.random.choice(self.meshes)}" {place}'
        elif kind < 0.6:
            long_type = self.random.choice(["capsule", "cylinder", "box", "ellipsoid"])
            shape = f'type="{long_type}" size="{self.sizes(1)}" fromto="{self.numbers(6)}"'
        else:
            of_type = self.random.choice(list(SIZES))
            shape = f'type="{of_type}" size="{self.sizes(SIZES[of_type])}" {place}'
        return f'<geom {self.class_of("class")} {shape} {self.bits()}/>'

    def add_body(self, depth):
        name = f"b{len(self.bodies)}"
        self.bodies.append(name)
        is_mocap = depth == 0 and self.chance(0.1)
        self.lines.append(
            f'<body name="{name}" pos="{self.numbers(3, 2)}" {self.orientation()} '
            f'{self.class_of("childclass")} {"mocap=" + chr(34) + "true" + chr(34) if is_mocap else ""}>')
        if not is_mocap and self.chance(0.6):
            self.lines.append('<joint type="hinge" axis="0 0 1"/>')
        self.lines.append('<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>')
        for _ in range(self.random.randrange(4)):
            self.lines.append(self.geom())
        for _ in range(self.random.randrange(3) if depth < 4 else 0):
            self.add_body(depth + 1)
        self.lines.append("</body>")

    def text(self):
        self.in_degrees = self.chance(0.5)
        sequence = "".join(self.random.choice("xyzXYZ") for _ in range(3))
        unit = "degree" if self.in_degrees else "radian"
        self.lines.append(f'<mujoco><compiler angle="{unit}" eulerseq="{sequence}"/>')
        if self.chance(0.3):
            self.lines.append('<option><flag filterparent="disable"/></option>')
        if self.chance(0.7):
            self.lines.append("<default>" + self.default_geom())
            for i in range(self.random.randrange(3)):
                self.add_class(f"c{i}", 0)
            self.lines.append("</default>")
        self.lines.append("<asset>")
        for i in range(self.random.randrange(4)):
            self.add_mesh(f"m{i}")
        self.lines.append("</asset><worldbody>")
        for _ in range(self.random.randrange(4)):
            self.lines.append(self.geom(in_world=True))
        for _ in range(self.random.randrange(1, 5)):
            self.add_body(0)
        self.lines.append("</worldbody><contact>")
        for _ in range(3 if len(self.bodies) > 2 and self.chance(0.5) else 0):
            a, b = self.random.sample(self.bodies, 2)
            self.lines.append(f'<exclude body1="{a}" body2="{b}"/>')
        self.lines.append("</contact></mujoco>")
        return "\n".join(self.lines) + "\n"


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__.splitlines()[0])
    first, count, folder = int(sys.argv[1]), int(sys.argv[2]), pathlib.Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    for seed in range(first, first + count):
        (folder / f"{seed}.xml").write_text(Model(seed).text())


main()
