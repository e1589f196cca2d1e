"""Polygon meshes in OBJ text, for the rivals of `cargo xtask compare`; `mesh.py FILE.obj` says what a file holds.

Positions are `(V, 3)`, faces are lists of vertex indices from 0, UVs come one per face corner as `(C, 2)` in the
order of the faces. Numpy only.
"""

import json
import sys

import numpy as np


class Mesh:
    """Positions, faces, and per face corner the index of its UV (or none)."""

    def __init__(self, positions, faces, uvs=None, corner_uv=None):
        self.positions = positions
        self.faces = faces
        self.uvs = uvs
        self.corner_uv = corner_uv

    @property
    def counts(self):
        return np.array([len(face) for face in self.faces], dtype=np.int64)

    @property
    def corner_vertex(self):
        return np.array([v for face in self.faces for v in face], dtype=np.int64)


def read(path):
    """The `v`, `vt` and `f` lines of an OBJ file; everything else is left alone."""
    positions, uvs, faces, corner_uv = [], [], [], []
    with open(path, "rb") as file:
        text = file.read().decode("utf-8", "replace").replace("\\\n", " ").replace("\\\r\n", " ")
    for line in text.splitlines():
        words = line.split("#", 1)[0].split()
        if not words:
            continue
        if words[0] == "v":
            positions.append([float(word) for word in words[1:4]])
        elif words[0] == "vt":
            uvs.append([float(word) for word in words[1:3]])
        elif words[0] == "f":
            corners = [word.split("/") for word in words[1:]]
            faces.append([_index(corner[0], len(positions)) for corner in corners])
            for corner in corners:
                has_uv = len(corner) > 1 and corner[1]
                corner_uv.append(_index(corner[1], len(uvs)) if has_uv else -1)
    positions = np.array(positions, dtype=float).reshape(-1, 3)
    uvs = np.array(uvs, dtype=float).reshape(-1, 2)
    return Mesh(positions, faces, uvs, np.array(corner_uv, dtype=np.int64))


def _index(word, count):
    index = int(word)
    return index - 1 if index > 0 else count + index


def not_a_disk(mesh):
    """Why a mesh is not a disk, perhaps with holes (one component, boundary loops, no handle), or `None` when it is."""
    if not mesh.faces:
        return "no faces"
    halfedges = {}
    for face in mesh.faces:
        if len(set(face)) != len(face) or len(face) < 3:
            return "a face that repeats a vertex"
        for a, b in zip(face, face[1:] + face[:1]):
            if (a, b) in halfedges:
                return "not an oriented manifold"
            halfedges[a, b] = True
    boundary = {a: b for a, b in halfedges if (b, a) not in halfedges}
    if len(boundary) != sum((b, a) not in halfedges for a, b in halfedges):
        return "boundary loops that touch"
    used = sorted({v for face in mesh.faces for v in face})
    if _components(used, halfedges) != 1:
        return f"{_components(used, halfedges)} components"
    loops = _components(sorted(boundary), boundary.items())
    if loops == 0:
        return "closed"
    edges = sum(a < b or (b, a) not in halfedges for a, b in halfedges)
    euler = len(used) - edges + len(mesh.faces)
    return None if euler == 2 - loops else f"a handle (Euler characteristic {euler}, {loops} boundary loops)"


def _components(vertices, edges):
    parent = {v: v for v in vertices}

    def root(v):
        while parent[v] != v:
            parent[v] = parent[parent[v]]
            v = parent[v]
        return v

    for a, b in edges:
        parent[root(a)] = root(b)
    return sum(parent[v] == v for v in vertices)


class Triangles:
    """The triangles of a mesh, each face a fan about its first corner, with the way back.

    `corner[t, k]` is the face corner that corner `k` of triangle `t` is, `vertex[t, k]` its vertex, `face[t]` the face.
    """

    def __init__(self, mesh):
        triangles, face_of, first = [], [], 0
        for number, face in enumerate(mesh.faces):
            for k in range(first + 1, first + len(face) - 1):
                triangles.append([first, k, k + 1])
                face_of.append(number)
            first += len(face)
        self.corner = np.array(triangles, dtype=np.int64).reshape(-1, 3)
        self.face = np.array(face_of, dtype=np.int64)
        self.vertex = mesh.corner_vertex[self.corner]


def write_vertex_uvs(path, source, mesh, uv):
    """Writes one UV per vertex: no face can be torn."""
    write(path, source, [[(v, uv[v]) for v in face] for face in mesh.faces])


def write_corner_uvs(path, source, mesh, uv):
    """Writes one UV per face corner."""
    corners = iter(uv)
    write(path, source, [[(v, next(corners)) for v in face] for face in mesh.faces])


def write_triangle_uvs(path, source, mesh, triangles, uv):
    """Writes one UV per triangle corner, `uv` of shape (T, 3, 2).

    A face whose triangles agree on the UVs of the corners they share is written as it is. One whose triangles do
    not is torn: OBJ cannot say so in one face, so its triangles are written.
    """
    pieces = [[] for _ in mesh.faces]
    for triangle, face in enumerate(triangles.face):
        pieces[face].append(triangle)
    written, first = [], 0
    for face, members in zip(mesh.faces, pieces):
        known = {}
        for t in members:
            for corner, point in zip(triangles.corner[t], uv[t]):
                known.setdefault(int(corner) - first, set()).add(tuple(point))
        if all(len(points) == 1 for points in known.values()) and len(known) == len(face):
            written.append([(v, next(iter(known[k]))) for k, v in enumerate(face)])
        else:
            written.extend([list(zip(map(int, triangles.vertex[t]), uv[t])) for t in members])
        first += len(face)
    write(path, source, written)


def write(path, source, faces):
    """The input text with new `vt` and `f` lines; a face is a list of (vertex, uv)."""
    with open(source, "rb") as file:
        text = file.read().decode("utf-8", "replace").replace("\\\n", " ").replace("\\\r\n", " ")
    kept = [line for line in text.splitlines() if line.split()[:1] not in (["f"], ["vt"], ["vn"])]
    numbers, points, lines = {}, [], []
    for face in faces:
        words = []
        for vertex, point in face:
            point = (float(point[0]), float(point[1]))
            number = numbers.setdefault(point, len(numbers) + 1)
            if number > len(points):
                points.append(f"vt {point[0]!r} {point[1]!r}")
            words.append(f"{vertex + 1}/{number}")
        lines.append("f " + " ".join(words))
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join([*kept, *points, *lines]) + "\n")


def peak_memory_bytes():
    """The largest resident set of this process so far, where the system tells."""
    try:
        with open("/proc/self/status", encoding="ascii") as file:
            return next(int(line.split()[1]) * 1024 for line in file if line.startswith("VmHWM:"))
    except (OSError, StopIteration):
        return None


if __name__ == "__main__":
    surface = read(sys.argv[1])
    quads = int((surface.counts == 4).sum())
    what = {"vertices": len(surface.positions), "faces": len(surface.faces), "quads": quads}
    print(json.dumps({**what, "not_a_disk": not_a_disk(surface)}))
