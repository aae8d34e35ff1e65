"""A mesh of a million triangles, rays at it, and Embree's closest hits one ray at a time."""

import time

import numpy as np
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh


def mesh_and_rays(triangles, rays):
    """A bumpy sphere of about `triangles` triangles, and `rays` rays from around it into it."""
    edge = int((triangles / 2) ** 0.5)
    theta, phi = np.meshgrid(
        np.linspace(0.01, np.pi - 0.01, edge + 1), np.linspace(0, 2 * np.pi, edge + 1), indexing="ij"
    )
    radius = 1 + 0.05 * np.sin(40 * theta) * np.sin(40 * phi)
    sphere = [np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)]
    points = (radius[..., None] * np.stack(sphere, axis=-1)).reshape(-1, 3).astype(np.float32)
    row, column = np.meshgrid(np.arange(edge), np.arange(edge), indexing="ij")
    a = (row * (edge + 1) + column).ravel()
    quads = np.stack([a, a + 1, a + edge + 2, a, a + edge + 2, a + edge + 1], axis=-1)
    corners = points[quads.reshape(-1, 3)]
    random = np.random.default_rng(148)
    origins = random.normal(size=(rays, 3))
    origins *= 3 / np.linalg.norm(origins, axis=1, keepdims=True)
    directions = random.uniform(-0.8, 0.8, size=(rays, 3)) - origins
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    return corners, origins.astype(np.float32), directions.astype(np.float32)


class Embree:
    """Embree with the mesh; `build_seconds` is the processor time of the build."""

    def __init__(self, corners):
        start = time.process_time()
        self.scene = rtcore_scene.EmbreeScene()
        self.mesh = TriangleMesh(self.scene, corners)
        self.scene.run(np.zeros((1, 3), np.float32), np.ones((1, 3), np.float32))
        self.build_seconds = time.process_time() - start

    def closest(self, origins, directions):
        """Seconds of processor time a ray, and the triangles hit or -1."""
        start = time.process_time()
        hits = self.scene.run(origins, directions)
        return (time.process_time() - start) / len(origins), hits
