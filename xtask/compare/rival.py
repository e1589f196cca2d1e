"""One rival on one mesh: `rival.py METHOD IN.obj OUT.obj REPORT.json`; `rival.py --list` prints the methods.

Each method triangulates as users of that tool do, is timed around the solve alone, and maps its UVs back to the
corners of the quads. The report has `solve_seconds` (wall), `solve_cpu_seconds` and `peak_memory_bytes`.
"""

import json
import math
import sys
import time

import numpy as np

import mesh as obj


class Clock:
    """Wall and processor time of a `with` block."""

    def __enter__(self):
        self.wall, self.cpu = time.perf_counter(), time.process_time()
        return self

    def __exit__(self, *_):
        self.wall = time.perf_counter() - self.wall
        self.cpu = time.process_time() - self.cpu


def igl_input(surface):
    """Triangles as fans, the boundary loop, and that loop on the circle by arc length."""
    import igl

    triangles = obj.Triangles(surface).vertex  # what `igl.polygons_to_triangles` gives
    loop = igl.boundary_loop(triangles)
    circle = igl.map_vertices_to_circle(np.asfortranarray(surface.positions), loop.astype(np.int32))
    return igl, triangles, loop, np.ascontiguousarray(circle)


def igl_lscm(source, surface, target):
    igl, triangles, loop, _ = igl_input(surface)
    pins = np.array([loop[0], loop[len(loop) // 2]])
    with Clock() as clock:
        uv, _ = igl.lscm(surface.positions, triangles, pins, np.array([[0.0, 0.0], [1.0, 0.0]]))
    obj.write_vertex_uvs(target, source, surface, uv)
    return clock


def igl_harmonic(source, surface, target):
    igl, triangles, loop, circle = igl_input(surface)
    with Clock() as clock:
        uv = igl.harmonic(surface.positions, triangles, loop, circle, 1)
    obj.write_vertex_uvs(target, source, surface, uv)
    return clock


def igl_arap(iterations):
    def run(source, surface, target):
        igl, triangles, loop, circle = igl_input(surface)
        with Clock() as clock:
            start = igl.harmonic(surface.positions, triangles, loop, circle, 1)
            data = igl.ARAPData()
            data.max_iter = iterations
            # One pin takes the translation out: the wheel refuses to factorize without.
            pin = loop[:1]
            igl.arap_precomputation(surface.positions, triangles, 2, pin.astype(np.int32), data)
            uv = igl.arap_solve(start[pin], data, start)
        obj.write_vertex_uvs(target, source, surface, uv)
        return clock

    return run


def igl_slim(iterations):
    def run(source, surface, target):
        igl, triangles, loop, circle = igl_input(surface)
        with Clock() as clock:
            start = igl.harmonic(surface.positions, triangles, loop, circle, 1)
            if igl.flipped_triangles(start, triangles).size:
                # As libigl's own SLIM example does: SLIM needs a start without flips.
                start = tutte(len(surface.positions), triangles, loop, circle)
            data = igl.slim_precompute(
                np.asfortranarray(surface.positions),
                np.asfortranarray(triangles.astype(np.int32)),
                np.asfortranarray(start),
                igl.MappingEnergyType.SYMMETRIC_DIRICHLET,
                np.zeros(0, np.int32),
                np.zeros((0, 2), order="F"),
                0.0,
            )
            uv = igl.slim_solve(data, iterations)
        obj.write_vertex_uvs(target, source, surface, uv[:, :2])
        return clock

    return run


def tutte(count, triangles, loop, circle):
    """Tutte 1963, uniform weights."""
    from scipy.sparse import coo_matrix, diags
    from scipy.sparse.linalg import spsolve

    a, b = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    graph = coo_matrix((np.ones(2 * len(a)), (np.r_[a, b], np.r_[b, a])), shape=(count, count)).tocsr()
    graph.data[:] = 1.0
    laplacian = diags(np.asarray(graph.sum(axis=1)).ravel()) - graph
    uv = np.zeros((count, 2))
    uv[loop] = circle
    inside = np.setdiff1d(np.unique(triangles), loop)
    uv[inside] = spsolve(laplacian[inside][:, inside].tocsc(), -(laplacian[inside][:, loop] @ circle))
    return uv


def in_blender(operate):
    """A method that runs `operate(bpy.ops.uv)` on the whole mesh, in edit mode, in an empty scene."""

    def run(source, surface, target):
        import bpy

        bpy.ops.wm.read_factory_settings(use_empty=True)
        data = bpy.data.meshes.new("mesh")
        data.from_pydata(surface.positions.tolist(), [], surface.faces)
        layer = data.uv_layers.new(name="uv").name
        thing = bpy.data.objects.new("mesh", data)
        bpy.context.scene.collection.objects.link(thing)
        bpy.context.view_layer.objects.active = thing
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        with Clock() as clock:
            operate(bpy.ops.uv)
        bpy.ops.object.mode_set(mode="OBJECT")
        uv = np.empty(2 * len(data.loops), np.float32)
        data.uv_layers[layer].uv.foreach_get("vector", uv)
        obj.write_corner_uvs(target, source, surface, uv.reshape(-1, 2))
        return clock

    return run


def blender(method, **options):
    return in_blender(lambda uv: uv.unwrap(method=method, correct_aspect=False, margin=0.0, **options))


def blender_smart():
    """Smart UV project: charts by direction of faces, each projected. Not a contestant of the league, which gives everybody a disk."""
    return in_blender(lambda uv: uv.smart_project(angle_limit=math.radians(66), island_margin=0.001))


def xatlas(source, surface, target):
    import xatlas

    triangles = obj.Triangles(surface)
    positions = surface.positions.astype(np.float32)
    with Clock() as clock:
        _, indices, uv = xatlas.parametrize(positions, triangles.vertex.astype(np.uint32))
    obj.write_triangle_uvs(target, source, surface, triangles, uv[indices.astype(np.int64)])
    return clock


def uvunwrap(source, surface, target):
    import uvunwrap

    triangles = obj.Triangles(surface)
    with Clock() as clock:
        mesh = uvunwrap.Mesh(
            surface.positions.tolist(), triangles.vertex.tolist(), polygons=triangles.face.tolist()
        )
        output = uvunwrap.generate([mesh]).meshes[0]
    uv = np.array(output.corner_uvs).reshape(-1, 3, 2)
    obj.write_triangle_uvs(target, source, surface, triangles, uv)
    return clock


METHODS = {
    "libigl-lscm": igl_lscm,
    "libigl-harmonic": igl_harmonic,
    "libigl-arap": igl_arap(50),
    "libigl-slim": igl_slim(20),
    "blender-abf": blender("ANGLE_BASED"),
    "blender-lscm": blender("CONFORMAL"),
    "blender-minimum-stretch-10": blender("MINIMUM_STRETCH", iterations=10),
    "blender-minimum-stretch-50": blender("MINIMUM_STRETCH", iterations=50),
    "xatlas": xatlas,
    "uvunwrap": uvunwrap,
}


def main():
    if sys.argv[1:] == ["--list"]:
        print("\n".join(METHODS))
        return
    method, source, target, report = sys.argv[1:]
    clock = {**METHODS, "blender-smart": blender_smart()}[method](source, obj.read(source), target)
    figures = {"solve_seconds": clock.wall, "solve_cpu_seconds": clock.cpu}
    with open(report, "w", encoding="utf-8") as file:
        json.dump({**figures, "peak_memory_bytes": obj.peak_memory_bytes()}, file)


main()
