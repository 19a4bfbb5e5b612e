"""meshio reads .msh 2.2, .ply, .stl and .obj; numbers have the bits that we wrote."""

import meshio
import numpy as np

from report import Checks

checks = Checks()

for sample, path in checks.of_kind("msh"):
    if sample["version"] != "2.2":
        continue
    mesh = meshio.read(path)
    checks.claim(sample, f"{len(mesh.points)} nodes", len(mesh.points) == sample["nodes"])
    elements = sum(len(block.data) for block in mesh.cells)
    checks.claim(sample, f"{elements} elements", elements == sample["elements"])
    checks.claim(sample, f"groups {list(mesh.field_data)}", "surface" in mesh.field_data)
    for node, *point in sample["points"]:
        same = bool((mesh.points[int(node)] == np.array(point)).all())
        checks.claim(sample, f"node {node} is {mesh.points[int(node)]}, not {point}", same)

for sample, path in checks.of_kind("triangles"):
    if sample["format"] == "glb":
        continue
    mesh = meshio.read(path)
    triangles = sum(len(block.data) for block in mesh.cells if block.type == "triangle")
    checks.claim(sample, f"{triangles} triangles", triangles == sample["triangles"])
    exact = sample["format"] in ("ply", "obj")
    kind = np.float64 if exact else np.float32
    corner = np.array(sample["first_corner"], dtype=kind)
    block = next(block for block in mesh.cells if block.type == "triangle")
    found = mesh.points[block.data[0][0]]
    checks.claim(sample, f"the first corner is {found}, not {corner}", bool((found == corner).all()))

checks.finish("meshio " + meshio.__version__)
