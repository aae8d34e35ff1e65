"""The handout's room, closed and of many triangles."""
import pathlib

MODEL = pathlib.Path("crates/model/assets/cornell_box.obj")
# The light of the handout, z up.
LIGHT = "0.01909,0.0101,1.7764"
# The left wall, the back wall, the front wall and the ceiling. As in the model, y is up.
MISSING = """
o missing
usemtl floor
v -1.01 0 0.99
v 1 0 0.99
v 1 0 -1.04
v -0.99 0 -1.04
v -1.01 1.99 0.99
v 1 1.99 0.99
v 1 1.99 -1.04
v -0.99 1.99 -1.04
vn 1 0 0
vn 0 0 1
vn 0 0 -1
vn 0 -1 0
f 49//13 53//13 56//13 52//13
f 52//14 56//14 55//14 51//14
f 49//15 50//15 54//15 53//15
f 53//16 54//16 55//16 56//16
"""


def write(path, edge):
    """Writes the room and its materials. Gives how many triangles it has.

    Each facet is divided into `edge` by `edge` parts, which share their corners.
    """
    corners, lines, written = [], [], 0
    for line in (MODEL.read_text() + MISSING).splitlines():
        keyword, *words = line.split() or ["#"]
        if keyword == "v":
            corners.append([float(word) for word in words])
        elif keyword == "f":
            a, b, c, d = (corners[int(word.split("/")[0]) - 1] for word in words)
            for row in range(edge + 1):
                for column in range(edge + 1):
                    u, v = row / edge, column / edge
                    parts = (1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v
                    point = (sum(map(float.__mul__, parts, xs)) for xs in zip(a, b, c, d))
                    lines.append("v " + " ".join(f"{x:.7f}" for x in point))
            normal = words[0].split("/")[2]
            for row in range(edge):
                for column in range(edge):
                    first = written + row * (edge + 1) + column + 1
                    places = first, first + edge + 1, first + edge + 2, first + 1
                    lines.append("f " + " ".join(f"{place}//{normal}" for place in places))
            written += (edge + 1) ** 2
        else:
            lines.append(line)
    path.write_text("\n".join(lines) + "\n")
    # The name that the model gives.
    materials = MODEL.with_suffix(".mtl")
    path.with_name(materials.name).write_text(materials.read_text())
    return 2 * sum(line.startswith("f ") for line in lines)
