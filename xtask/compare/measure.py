"""Measures UV maps, independently of the Rust code: `measure.py [--original MESH.obj] FILE.obj…`, one JSON line a file.

Numpy only, and nothing of `qparam`. Definitions (T: polygons in space, U: in the plane):

* Corner triangle: previous, this, next corner. A quad has four, which cover it twice: no diagonal is preferred.
* Point: a vertex with its UV. Faces joined by an edge whose two points agree form an island; an island of
  negative total area is mirrored first. U is scaled once so that the sum of its |areas| is the area of T.
* `angle_error`: Eq. 13, sum over corners of (θ/φ − 1)²; φ the interior angle in (0, 2π), at least 1e-9.
* `area_error`: Eq. 14, sum over corner triangles of (A(T)/A(U) − 1)²; A(U) signed, |A(U)| at least 1e-12 of its mean.
* `symmetric_dirichlet`: mean of (s1² + s2² + s1⁻² + s2⁻²)/4 over corner triangles that are not flipped, by area in T.
* `flipped_corners`: A(U) ≤ 0, by exact arithmetic where rounding could decide. `flipped_faces`: faces with any.
* `folded_faces`: quads of which neither diagonal gives two positive triangles; other faces of no positive area.
* `boundary_crossings`: pairs of boundary edges of one island that meet though they share no point; exact as well.
* `torn_quads` (with `--original`): quads of the original that are not faces of the file any more.

Everything is computed twice, in double and in extended precision. `rounding` gives the relative difference: how much of
a figure the 53 bits of a double determine. Where the platform has no longer type, it is 0.
"""

import argparse
import json
import sys
from fractions import Fraction

import numpy as np

import mesh as obj

SMALLEST_ANGLE = 1e-9
SMALLEST_AREA = 1e-12
MEASURES = ["angle_error", "area_error", "symmetric_dirichlet"]


def measure(surface, original=None):
    """Every measure of a mesh whose corners all have UVs. Raises `ValueError` when there are none."""
    if not surface.faces or (surface.corner_uv < 0).any():
        raise ValueError("not every face corner has a UV")
    if not np.isfinite(surface.uvs).all():
        raise ValueError(f"{(~np.isfinite(surface.uvs)).any(axis=1).sum()} UVs are not finite")
    corners = Corners(surface)
    islands, boundary = find_islands(corners)
    sign = orientation(corners.uv[corners.previous], corners.uv, corners.uv[corners.next])
    face_area = np.bincount(corners.face, shoelace(corners), minlength=corners.faces)
    mirrored = np.bincount(islands, face_area) < 0
    turn = np.where(mirrored[islands], -1, 1)[corners.face]
    flipped = sign * turn <= 0
    result = {"faces": corners.faces, "islands": int(islands.max()) + 1, "mirrored_islands": int(mirrored.sum())}
    double = distortion(corners, turn, flipped, np.float64)
    extended = distortion(corners, turn, flipped, np.longdouble)
    result.update({name: float(double[name]) if np.isfinite(double[name]) else None for name in MEASURES})
    result["flipped_corners"] = int(flipped.sum())
    result["flipped_faces"] = len(np.unique(corners.face[flipped]))
    result["folded_faces"] = folded(corners, flipped, face_area * np.where(mirrored, -1, 1)[islands])
    result["boundary_crossings"] = crossings(corners, boundary, islands[corners.face[boundary]])
    if original is not None:
        faces = {frozenset(face) for face in surface.faces}
        result["torn_quads"] = sum(len(face) == 4 and frozenset(face) not in faces for face in original.faces)
    result["rounding"] = {
        name: float(abs(double[name] - extended[name]) / max(abs(extended[name]), np.finfo(float).tiny))
        for name in MEASURES
        if result[name] is not None
    }
    return result


class Corners:
    """The face corners of a mesh as flat arrays."""

    def __init__(self, surface):
        counts = surface.counts
        first = np.cumsum(counts) - counts
        total = int(counts.sum())
        here = np.arange(total)
        self.faces = len(counts)
        self.face = np.repeat(np.arange(self.faces), counts)
        self.degree = counts
        self.local = here - first[self.face]
        self.next = np.where(self.local + 1 == counts[self.face], first[self.face], here + 1)
        self.previous = np.empty(total, np.int64)
        self.previous[self.next] = here
        self.vertex = surface.corner_vertex
        self.position = surface.positions[self.vertex]
        self.uv = surface.uvs[surface.corner_uv] + 0.0  # -0 is 0
        points = np.column_stack([self.vertex.astype(float), self.uv])
        self.point = np.unique(points, axis=0, return_inverse=True)[1].ravel()


def find_islands(corners):
    """The island of each face, and the corners whose edge to the next corner belongs to one face only."""
    edges = {}
    for corner, (a, b) in enumerate(zip(corners.point.tolist(), corners.point[corners.next].tolist())):
        edges.setdefault((min(a, b), max(a, b)), []).append(corner)
    parent = list(range(corners.faces))

    def root(face):
        while parent[face] != face:
            parent[face] = parent[parent[face]]
            face = parent[face]
        return face

    face = corners.face.tolist()
    for first, *others in edges.values():
        for other in others:
            parent[root(face[other])] = root(face[first])
    roots = [root(f) for f in range(corners.faces)]
    islands = np.unique(roots, return_inverse=True)[1].ravel()
    boundary = [members[0] for members in edges.values() if len(members) == 1]
    return islands, np.array(sorted(boundary), dtype=np.int64)


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def shoelace(corners):
    """What each corner adds to the signed area of its face, taken about the face's first corner."""
    origin = corners.uv[np.flatnonzero(corners.local == 0)][corners.face]
    return cross(corners.uv - origin, corners.uv[corners.next] - origin) / 2


def orientation(a, b, c):
    """The exact sign of the turn a, b, c."""
    left, right = (b - a)[:, 0] * (c - a)[:, 1], (b - a)[:, 1] * (c - a)[:, 0]
    value = left - right
    sign = np.sign(value).astype(int)
    # Four roundings, each of half an ulp; a generous bound costs a few fractions more.
    doubtful = np.abs(value) <= 8 * np.finfo(float).eps * (np.abs(left) + np.abs(right)) + 1e-300
    for i in np.flatnonzero(doubtful):
        (ax, ay), (bx, by), (cx, cy) = ([Fraction(float(x)) for x in p[i]] for p in (a, b, c))
        exact = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        sign[i] = (exact > 0) - (exact < 0)
    return sign


def distortion(corners, turn, flipped, real):
    """Eq. 13, Eq. 14 and the symmetric Dirichlet energy, computed in the type `real`."""
    position, uv, turn = corners.position.astype(real), corners.uv.astype(real), turn.astype(real)
    e, f = position[corners.next] - position, position[corners.previous] - position
    normal = np.cross(e, f)
    space = np.sqrt((normal**2).sum(axis=1)) / 2
    g, h = uv[corners.next] - uv, uv[corners.previous] - uv
    plane = turn * cross(g, h) / 2
    # A face is covered (degree - 2) times by fans; a quad's corner triangles cover it twice, a triangle's three times.
    cover = np.array([0, 0, 0, 3, 2])[np.minimum(corners.degree, 4)].astype(real)
    many = corners.degree > 4
    weight = np.where(many, 1 / np.maximum(corners.degree - 2, 1).astype(real), 1 / np.maximum(cover, 1))[corners.face]
    total_space, total_plane = (weight * space).sum(), (weight * np.abs(plane)).sum()
    if not (total_space > 0 and total_plane > 0):
        raise ValueError("the UVs cover no area" if total_space > 0 else "the faces have no area")
    scale = np.sqrt(total_space / total_plane)
    g, h, plane = g * scale, h * scale, plane * scale**2

    theta = np.arctan2(2 * space, (e * f).sum(axis=1))
    phi = np.arctan2(2 * plane, (g * h).sum(axis=1))
    phi = np.where(phi < 0, phi + 2 * np.arctan2(real(0), real(-1)), phi)
    no_length = ((g**2).sum(axis=1) == 0) | ((h**2).sum(axis=1) == 0)
    phi = np.maximum(np.where(no_length, 0, phi), real(SMALLEST_ANGLE))
    angle_error = ((np.maximum(theta, real(SMALLEST_ANGLE)) / phi - 1) ** 2).sum()

    least = real(SMALLEST_AREA) * np.abs(plane).mean()
    kept = np.where(np.abs(plane) < least, np.where(plane < 0, -least, least), plane)
    area_error = ((space / kept - 1) ** 2).sum()

    use = ~flipped & (space > real(1e-14) * total_space / len(space)) & (plane > 0)
    length = np.sqrt((e**2).sum(axis=1))[use]
    x, y = (e * f).sum(axis=1)[use] / length, 2 * space[use] / length
    first = g[use] / length[:, None]
    second = (h[use] - first * x[:, None]) / y[:, None]
    squares = (first**2).sum(axis=1) + (second**2).sum(axis=1)
    determinant = cross(first, second) * turn[use]
    energy = (squares + squares / determinant**2) / 4
    share = (weight * space)[use]
    symmetric = (share * energy).sum() / share.sum() if use.any() else real("nan")
    return {"angle_error": angle_error, "area_error": area_error, "symmetric_dirichlet": symmetric}


def folded(corners, flipped, face_area):
    even = np.bincount(corners.face, flipped & (corners.local % 2 == 0), minlength=corners.faces) > 0
    odd = np.bincount(corners.face, flipped & (corners.local % 2 == 1), minlength=corners.faces) > 0
    # A quad's corners 0 and 2 are the triangles of one diagonal, 1 and 3 those of the other.
    return int(np.where(corners.degree == 4, even & odd, face_area <= 0).sum())


def crossings(corners, boundary, island):
    """Pairs of boundary edges of one island that meet: a sweep in u, then exact orientations."""
    count = 0
    for number in np.unique(island):
        edge = boundary[island == number]
        a, b = corners.uv[edge], corners.uv[corners.next[edge]]
        ends = np.column_stack([corners.point[edge], corners.point[corners.next[edge]]])
        low, high = np.minimum(a, b), np.maximum(a, b)
        order = np.argsort(low[:, 0], kind="stable")
        a, b, ends, low, high = a[order], b[order], ends[order], low[order], high[order]
        last = np.searchsorted(low[:, 0], high[:, 0], side="right")
        for i in range(len(edge)):
            j = np.arange(i + 1, last[i])
            j = j[(low[j, 1] <= high[i, 1]) & (low[i, 1] <= high[j, 1])]
            j = j[~(ends[j][:, :, None] == ends[i][None, None, :]).any(axis=(1, 2))]
            if len(j):
                count += int(meet(np.broadcast_to(a[i], a[j].shape), np.broadcast_to(b[i], b[j].shape), a[j], b[j]).sum())
    return count


def meet(a, b, c, d):
    """Whether closed segments ab and cd, whose boxes overlap, have a point in common."""
    across = orientation(a, b, c) * orientation(a, b, d) <= 0
    return across & (orientation(c, d, a) * orientation(c, d, b) <= 0)


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--original")
    arguments.add_argument("files", nargs="+")
    arguments = arguments.parse_args()
    original = obj.read(arguments.original) if arguments.original else None
    for path in arguments.files:
        try:
            print(json.dumps(measure(obj.read(path), original)))
        except ValueError as error:
            print(json.dumps({"error": str(error)}))


if __name__ == "__main__":
    np.seterr(all="ignore")
    sys.exit(main())
