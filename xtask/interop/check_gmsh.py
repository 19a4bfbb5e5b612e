"""gmsh reads our curved meshes with positive Jacobians, and fills our STEP solids with tetrahedra."""

import gmsh
import numpy as np

from report import Checks

checks = Checks()
gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)

for sample, path in checks.of_kind("msh"):
    gmsh.open(path)
    types, tags, _ = gmsh.model.mesh.getElements(2)
    count = sum(len(of_type) for of_type in tags)
    checks.claim(sample, f"{count} elements", count == sample["elements"])
    for kind, of_type in zip(types, tags):
        order = gmsh.model.mesh.getElementProperties(kind)[2]
        checks.claim(sample, f"order {order}", order == sample["order"])
        worst = min(gmsh.model.mesh.getElementQualities(of_type, "minDetJac"))
        scaled = min(gmsh.model.mesh.getElementQualities(of_type, "minSJ"))
        name = gmsh.model.mesh.getElementProperties(kind)[0]
        checks.note(sample, f"{name}: smallest Jacobian {worst:.2e}, scaled {scaled:.2f}")
        if sample["regular"]:
            checks.claim(sample, f"smallest Jacobian {worst}, scaled {scaled}", worst > 0 and scaled > 0)
    nodes, coordinates, _ = gmsh.model.mesh.getNodes()
    place = dict(zip(nodes, np.array(coordinates).reshape(-1, 3)))
    checks.claim(sample, f"{len(nodes)} nodes", len(nodes) == sample["nodes"])
    for node, *point in sample["points"]:
        found = place[int(node) + 1]
        checks.claim(sample, f"node {node} is {found}, not {point}", bool((found == point).all()))
    groups = [gmsh.model.getPhysicalName(*group) for group in gmsh.model.getPhysicalGroups()]
    checks.claim(sample, f"groups {groups}", groups == ["surface"])
    if "area" in sample:
        area = 0.0
        for kind in types:
            rule, weights = gmsh.model.mesh.getIntegrationPoints(kind, "Gauss10")
            _, determinants, _ = gmsh.model.mesh.getJacobians(kind, rule)
            area += float((np.array(determinants).reshape(-1, len(weights)) * weights).sum())
        off = abs(area - sample["area"]) / sample["area"]
        checks.claim(sample, f"area differs by {off:.2e}", off <= sample["area_tolerance"])
    gmsh.clear()

for sample, path in checks.of_kind("step"):
    if not sample.get("tetrahedra"):
        continue
    gmsh.model.occ.importShapes(path)
    gmsh.model.occ.synchronize()
    size = sample["size"]
    gmsh.option.setNumber("Mesh.MeshSizeMin", size * sample["mesh_size"])
    gmsh.option.setNumber("Mesh.MeshSizeMax", size * sample["mesh_size"])
    # the parallel algorithm: the older one leaves flat tetrahedra at the boundary, which cannot curve
    gmsh.option.setNumber("Mesh.Algorithm3D", 10)
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(2)
    gmsh.model.mesh.optimize("HighOrder")
    types, tags, _ = gmsh.model.mesh.getElements(3)
    checks.claim(sample, f"types {types}: 11 is a tetrahedron of order 2", list(types) == [11])
    worst = min(gmsh.model.mesh.getElementQualities(tags[0], "minDetJac"))
    scaled = min(gmsh.model.mesh.getElementQualities(tags[0], "minSJ"))
    checks.note(sample, f"{len(tags[0])} tetrahedra, smallest scaled Jacobian {scaled:.2f}")
    checks.claim(sample, f"smallest Jacobian {worst}, scaled {scaled}", worst > 0 and scaled > 0)
    gmsh.clear()

gmsh.finalize()
checks.finish("gmsh " + gmsh.__version__)
