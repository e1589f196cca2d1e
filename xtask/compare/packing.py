"""xatlas's packing of islands that are there already: `packing.py RESOLUTION MARGIN IN.obj`.

Prints one JSON object a line: `by`, `islands`, `seconds` (wall time), and what part of the smallest square and of the smallest
rectangle around its layout the islands cover. The shares are measured afresh from the UVs that xatlas hands back.
"""

import json
import sys
import time

import numpy as np
import xatlas

import mesh as obj

WAYS = {
    "xatlas": {},
    "xatlas, not turned": {"rotate_charts": False, "rotate_charts_to_axis": False},
    "xatlas, brute force": {"bruteForce": True},
}


def main():
    resolution, margin = int(sys.argv[1]), int(sys.argv[2])
    surface = obj.read(sys.argv[3])
    corners = surface.corner_uv[obj.Triangles(surface).corner]
    for by, wishes in WAYS.items():
        options = xatlas.PackOptions()
        options.resolution, options.padding, options.bilinear = resolution, margin, False
        for name, wish in wishes.items():
            setattr(options, name, wish)
        atlas = xatlas.Atlas()
        atlas.add_uv_mesh(surface.uvs.astype(np.float32), corners.astype(np.uint32))
        start = time.perf_counter()
        atlas.generate(pack_options=options)
        seconds = time.perf_counter() - start
        if atlas.atlas_count != 1:
            sys.exit(f"{by}: {atlas.atlas_count} images instead of one")
        _, indices, uv = atlas.get_mesh(0)
        size = np.array([atlas.width, atlas.height], dtype=float)
        triangles = (uv.astype(float) * size)[indices]
        a, b = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
        area = 0.5 * np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum()
        figures = {"of_square": area / size.max() ** 2, "of_rectangle": area / size.prod()}
        print(json.dumps({"by": by, "islands": atlas.chart_count, "seconds": seconds, **figures}))


main()
