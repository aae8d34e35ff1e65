"""The photon loop of the handout in Mitsuba: the same scene, rejection, roulette and cosine bounce.

What Mitsuba chooses for itself: its random numbers (PCG32) and the tangent frame. It only counts what
it would store, so it writes less than ours does.
"""

import os

import drjit as dr
import mitsuba as mi

mi.set_variant("llvm_ad_rgb")

MODEL = os.path.join(os.path.dirname(__file__), "../../../model/assets/cornell_box.obj")
# Model axes, y up.
LIGHT = (0.01909, 1.77640, -0.0101)
OFFSET = 1e-5


def load():
    """The scene, and for every triangle its normal and its probability of reflection."""
    vertices, normals, triangles, normal_of, reflection = [], [], [], [], []
    material = ""
    for line in open(MODEL):
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            vertices.append([float(word) for word in words[1:4]])
        elif words[0] == "vn":
            normals.append([float(word) for word in words[1:4]])
        elif words[0] == "usemtl":
            material = words[1]
        elif words[0] == "f":
            corners = [[int(part) - 1 if part else 0 for part in word.split("/")] for word in words[1:]]
            for second, third in zip(corners[1:], corners[2:]):
                triangles.append([corners[0][0], second[0], third[0]])
                normal_of.append(normals[corners[0][2]])
                reflection.append(0.45 if is_green(material) else 0.725)
    mesh = mi.Mesh("box", len(vertices), len(triangles))
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = [c for vertex in vertices for c in vertex]
    parameters["faces"] = [corner for triangle in triangles for corner in triangle]
    parameters.update()
    scene = mi.load_dict({"type": "scene", "box": mesh})
    flat = mi.Float([c for normal in normal_of for c in normal])
    return scene, flat, mi.Float(reflection)


def is_green(material):
    """Whether the material library gives `material` the right wall's diffuse response."""
    name = None
    for line in open(MODEL.replace(".obj", ".mtl")):
        words = line.split()
        if words[:1] == ["newmtl"]:
            name = words[1]
        if words[:1] == ["Kd"] and name == material:
            return abs(float(words[2]) - 0.45) < 1e-6
    return False


@dr.syntax
def trace(scene, normals, reflection, count, seed):
    """Traces `count` photons and gives how many would be stored."""
    rng = mi.PCG32(size=count, initstate=seed)
    direction = dr.zeros(mi.Vector3f, count)
    searching = dr.full(mi.Bool, True, count)
    while searching:
        direction = mi.Vector3f(
            2 * rng.next_float32() - 1, 2 * rng.next_float32() - 1, 2 * rng.next_float32() - 1
        )
        square = dr.squared_norm(direction)
        searching = (square > 1) | (square == 0)
    ray = mi.Ray3f(mi.Point3f(*LIGHT), dr.normalize(direction))
    active = dr.full(mi.Bool, True, count)
    bounce = dr.zeros(mi.UInt32, count)
    stored = dr.zeros(mi.UInt32, count)
    while active:
        hit = scene.ray_intersect_preliminary(ray, coherent=False, active=active)
        active &= hit.is_valid()
        stored += dr.select(active & (bounce > 0), 1, 0)
        probability = dr.gather(mi.Float, reflection, hit.prim_index, active)
        active &= rng.next_float32() < probability
        normal = dr.gather(mi.Normal3f, normals, hit.prim_index, active)
        local = mi.warp.square_to_cosine_hemisphere(
            mi.Point2f(rng.next_float32(), rng.next_float32())
        )
        point = ray.o + hit.t * ray.d
        ray.o = point + OFFSET * normal
        ray.d = mi.Frame3f(normal).to_world(local)
        bounce += 1
        active &= bounce <= 1000
    return dr.sum(stored)
