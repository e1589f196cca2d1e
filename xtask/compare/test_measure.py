"""Self-test of `measure.py` and `mesh.py`: maps whose measures are known on paper."""

import math
import pathlib
import tempfile
import unittest

import numpy as np

import measure
import mesh as obj

# Two unit squares side by side, as one strip of two quads.
POSITIONS = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 0], [2, 1, 0]], float)
FACES = [[0, 1, 4, 3], [1, 2, 5, 4]]


def strip(uvs):
    corner_uv = np.array([v for face in FACES for v in face])
    return obj.Mesh(POSITIONS, FACES, np.array(uvs, float), corner_uv)


def plane(transform):
    return strip(POSITIONS[:, :2] @ np.array(transform, float).T)


class Measures(unittest.TestCase):
    def test_similarities_have_no_error(self):
        turn = [[math.cos(1), -math.sin(1)], [math.sin(1), math.cos(1)]]
        mirror = [[-1, 0], [0, 1]]
        for transform in ([[1, 0], [0, 1]], [[1e6, 0], [0, 1e6]], turn, mirror):
            found = measure.measure(plane(transform))
            self.assertAlmostEqual(found["angle_error"], 0, delta=1e-20)
            self.assertAlmostEqual(found["area_error"], 0, delta=1e-20)
            self.assertAlmostEqual(found["symmetric_dirichlet"], 1)
            self.assertEqual(found["flipped_corners"], 0)
            self.assertEqual(found["islands"], 1)
        self.assertEqual(measure.measure(plane(mirror))["mirrored_islands"], 1)

    def test_stretch_by_known_factors(self):
        # 2 x 1/2: right angles and areas stay, so Eqs. 13 and 14 see nothing; the energy is (4 + 1/4 + 1/4 + 4)/4.
        found = measure.measure(plane([[2, 0], [0, 0.5]]))
        self.assertAlmostEqual(found["angle_error"], 0)
        self.assertAlmostEqual(found["area_error"], 0)
        self.assertAlmostEqual(found["symmetric_dirichlet"], 8.5 / 4)

    def test_shear_by_known_angles(self):
        # Corners of 45 and 135 degrees, two each a quad: (90/45 - 1)^2 = 1, (90/135 - 1)^2 = 1/9.
        found = measure.measure(plane([[1, 1], [0, 1]]))
        self.assertAlmostEqual(found["angle_error"], 2 * (2 * 1 + 2 / 9))
        self.assertAlmostEqual(found["area_error"], 0)

    def test_unequal_areas(self):
        # Widths 1 and 3 of a total of 4, for 1 and 1 of 2: ratios 2 and 2/3, four corner triangles each.
        found = measure.measure(strip([[0, 0], [1, 0], [4, 0], [0, 1], [1, 1], [4, 1]]))
        self.assertAlmostEqual(found["area_error"], 4 * 1 + 4 / 9)

    def test_concave_quad_is_flipped_but_not_folded(self):
        found = measure.measure(strip([[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [1.4, 0.4]]))
        self.assertEqual((found["flipped_corners"], found["flipped_faces"], found["folded_faces"]), (1, 1, 0))

    def test_folded_over_quad(self):
        found = measure.measure(strip([[0, 0], [1, 0], [0.5, 0], [0, 1], [1, 1], [0.5, 1]]))
        self.assertEqual((found["flipped_corners"], found["folded_faces"]), (4, 1))

    def test_corner_of_exactly_no_area_is_flipped(self):
        # Collinear, with coordinates that no double holds: rounding must not decide.
        found = measure.measure(strip([[0, 0], [0.1, 0.1], [0.3, 0.3], [0, 1], [0.1, 1], [0.7, 0.7]]))
        exact = measure.orientation(*(np.array([p]) for p in ([0.1, 0.1], [0.3, 0.3], [0.7, 0.7])))
        self.assertEqual(exact[0], 0)
        self.assertGreaterEqual(found["flipped_corners"], 1)

    def test_boundary_that_crosses_itself(self):
        bow = strip([[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1]])
        self.assertEqual(measure.measure(bow)["boundary_crossings"], 0)
        # Vertex 5 pulled left across the opposite edge 3-0: its two boundary edges meet that edge.
        bow.uvs[5] = [-1, 0.5]
        self.assertEqual(measure.measure(bow)["boundary_crossings"], 2)

    def test_islands_are_told_by_uv(self):
        cut = strip(POSITIONS[:, :2])
        cut.uvs = np.vstack([cut.uvs, cut.uvs[[1, 4]] + [5, 0], cut.uvs[[2, 5]] + [5, 0]])
        cut.corner_uv = np.array([0, 1, 4, 3, 6, 8, 9, 7])
        self.assertEqual(measure.measure(cut)["islands"], 2)
        self.assertAlmostEqual(measure.measure(cut)["area_error"], 0)

    def test_refusals(self):
        for uvs in ([[0, 0]] * 6, [[float("nan"), 0]] * 6):
            with self.assertRaises(ValueError):
                measure.measure(strip(uvs))


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.source = pathlib.Path(folder.name, "in.obj")
        self.target = pathlib.Path(folder.name, "out.obj")
        vertices = "".join(f"v {x} {y} {z}\n" for x, y, z in POSITIONS)
        self.source.write_text(f"# kept\n{vertices}f 1 2 5 4\nf -5 -4/1 -1//2 -2 # tail\n")
        self.mesh = obj.read(self.source)

    def test_reading(self):
        self.assertEqual(self.mesh.faces, FACES)
        self.assertIsNone(obj.not_a_disk(self.mesh))

    def test_meshes_that_are_no_disks(self):
        cube = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
        positions = np.zeros((16, 3))
        other = [[v + 8 for v in face] for face in cube[:1]]
        corners = [(0, 0), (0, 1), (1, 1), (1, 0)]
        torus = [[3 * ((i + a) % 3) + (j + b) % 3 for a, b in corners] for i in range(3) for j in range(3)]
        reason = {
            "closed": cube,
            "a handle (Euler characteristic -1, 1 boundary loops)": torus[1:],
            "2 components": cube[:1] + other,
            "not an oriented manifold": [cube[0], cube[0]],
            "boundary loops that touch": [[0, 1, 2, 3], [0, 4, 5, 6]],
        }
        for expected, faces in reason.items():
            self.assertEqual(obj.not_a_disk(obj.Mesh(positions, faces)), expected)
        self.assertIsNone(obj.not_a_disk(obj.Mesh(positions, cube[1:])))
        self.assertIsNone(obj.not_a_disk(obj.Mesh(positions, cube[2:])), "holes are allowed")

    def test_whole_quads_survive_triangles(self):
        triangles = obj.Triangles(self.mesh)
        uv = POSITIONS[triangles.vertex, :2]
        obj.write_triangle_uvs(self.target, self.source, self.mesh, triangles, uv)
        written = obj.read(self.target)
        self.assertEqual(written.faces, FACES)
        self.assertEqual(measure.measure(written, self.mesh)["torn_quads"], 0)
        self.assertTrue(self.target.read_text().startswith("# kept\nv "))

    def test_torn_quads_are_written_as_triangles_and_counted(self):
        triangles = obj.Triangles(self.mesh)
        uv = POSITIONS[triangles.vertex, :2]
        uv[2] += 10
        obj.write_triangle_uvs(self.target, self.source, self.mesh, triangles, uv)
        written = obj.read(self.target)
        self.assertEqual([len(face) for face in written.faces], [4, 3, 3])
        found = measure.measure(written, self.mesh)
        self.assertEqual((found["torn_quads"], found["islands"]), (1, 2))
        self.assertAlmostEqual(found["area_error"], 0)


if __name__ == "__main__":
    np.seterr(all="ignore")
    unittest.main()
