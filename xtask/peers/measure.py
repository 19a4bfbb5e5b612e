"""Other programs on the work that smoothpatch does: one JSON object a line on standard output.

Every object has `work`, `tool`, `seconds` (CPU time), `primitives`, `bytes` and, where there is one,
`error` (largest distance over the diagonal) and `extrapolated` (true where the figure follows from
coarser runs because the mesh would not fit in memory).
"""

import json
import time

import gmsh
import numpy as np
import pyfqmr
import skimage.measure
import vtk
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray

ACCURACIES = [1e-3, 1e-5, 1e-7]
FLAT_BYTES = 18  # 3 single-precision coordinates for half a vertex, 3 indices of 4 bytes


def report(work, tool, seconds, primitives, size, error=None, extrapolated=False):
    line = dict(work=work, tool=tool, seconds=seconds, primitives=int(primitives), bytes=int(size))
    if error is not None:
        line.update(error=float(error), extrapolated=extrapolated)
    print(json.dumps(line), flush=True)


def sphere_distance(p):
    return np.abs(np.linalg.norm(p, axis=-1) - 1.0)


def torus_distance(p):
    ring = np.hypot(p[..., 0], p[..., 1]) - 2.0
    return np.abs(np.hypot(ring, p[..., 2]) - 1.0)


SURFACES = {
    "sphere": (sphere_distance, lambda x, y, z: x * x + y * y + z * z - 1.0, (1, 1, 1)),
    "torus": (
        torus_distance,
        lambda x, y, z: (x * x + y * y + z * z + 3.0) ** 2 - 16.0 * (x * x + y * y),
        (3, 3, 1),
    ),
}


def march(field, half, cells):
    """Vertices and triangles of a marched grid with about `cells` cells along the longest side."""
    step = 2.2 * max(half) / cells
    axes = [np.arange(-1.1 * h, 1.1 * h + step, step) for h in half]
    values = field(*np.meshgrid(*axes, indexing="ij", sparse=True))
    vertices, faces, _, _ = skimage.measure.marching_cubes(values, 0.0)
    return vertices * step + [axis[0] for axis in axes], faces


def marching_cubes(name):
    distance, field, half = SURFACES[name]
    diagonal = 2.0 * np.linalg.norm(half)
    runs = []
    for cells in (24, 48, 96, 192):
        start = time.process_time()
        vertices, faces = march(field, half, cells)
        seconds = time.process_time() - start
        corners = vertices[faces]
        places = [corners[:, 0], corners.mean(axis=1), corners[:, :2].mean(axis=1)]
        error = max(distance(p).max() for p in places) / diagonal
        runs.append((error, seconds, len(faces)))
    for accuracy in ACCURACIES:
        met = next((run for run in runs if run[0] <= accuracy), None)
        if met:
            error, seconds, count = met
        else:
            # errors fall with the number of triangles, times grow with that of the cells
            error, seconds, count = runs[-1]
            factor = error / accuracy
            error, seconds, count = accuracy, seconds * factor**1.5, count * factor
        report(f"{name} {accuracy:.0e}", "scikit-image marching cubes", seconds, count,
               FLAT_BYTES * count, error, met is None)


def curved_mesh(name, size):
    """Seconds, triangles, nodes and samples of the degree-7 mesh of the exact surface."""
    gmsh.model.add("peer")
    start = time.process_time()
    if name == "sphere":
        gmsh.model.occ.addSphere(0, 0, 0, 1)
    else:
        gmsh.model.occ.addTorus(0, 0, 0, 2, 1)
    gmsh.model.occ.synchronize()
    gmsh.option.setNumber("Mesh.MeshSizeMin", size)
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.model.mesh.generate(2)
    gmsh.model.mesh.setOrder(7)
    seconds = time.process_time() - start
    kinds, tags, _ = gmsh.model.mesh.getElements(2)
    lattice = [(i / 12, j / 12) for i in range(13) for j in range(13 - i)]
    local = [x for u, v in lattice for x in (u, v, 0.0)]
    points = [np.array(gmsh.model.mesh.getJacobians(kind, local)[2]) for kind in kinds]
    nodes = len(gmsh.model.mesh.getNodes()[0])
    gmsh.model.remove()
    return seconds, sum(map(len, tags)), nodes, np.concatenate(points).reshape(-1, 3)


def curved_elements(name):
    distance, _, half = SURFACES[name]
    diagonal = 2.0 * np.linalg.norm(half)
    size = 2.0 * min(half)
    for accuracy in ACCURACIES:
        for _ in range(24):
            seconds, count, nodes, points = curved_mesh(name, size)
            error = distance(points).max() / diagonal
            if error <= accuracy:
                report(f"{name} {accuracy:.0e}", "gmsh degree 7, exact CAD surface", seconds, count,
                       24 * nodes + 144 * count, error)
                break
            size *= 0.85


def polydata(vertices, faces):
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(vertices), deep=True))
    cells = vtk.vtkCellArray()
    offsets = np.arange(0, 3 * len(faces) + 1, 3, dtype=np.int64)
    flat = np.ascontiguousarray(faces, dtype=np.int64).ravel()
    cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True),
                  numpy_to_vtkIdTypeArray(flat, deep=True))
    mesh = vtk.vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetPolys(cells)
    return mesh


def deccube(x, y, z):
    def ring(u, v, w):
        return (u * u + v * v - 0.64) ** 2 + (w * w - 1.0) ** 2

    return ring(x, y, z) * ring(y, z, x) * ring(z, x, y) - 0.02


def decimation():
    vertices, faces = march(deccube, (1.5, 1.5, 1.5), 480)
    work = f"decorated cube, {len(faces)} triangles to 5 %"
    start = time.process_time()
    simplifier = pyfqmr.Simplify()
    simplifier.setMesh(vertices, faces)
    simplifier.simplify_mesh(target_count=len(faces) // 20, preserve_border=True)
    left = len(simplifier.getMesh()[1])
    report(work, "pyfqmr", time.process_time() - start, left, FLAT_BYTES * left)
    mesh = polydata(vertices, faces)
    start = time.process_time()
    decimate = vtk.vtkQuadricDecimation()
    decimate.SetInputData(mesh)
    decimate.SetTargetReduction(0.95)
    decimate.Update()
    left = decimate.GetOutput().GetNumberOfPolys()
    report(work, "vtkQuadricDecimation", time.process_time() - start, left, FLAT_BYTES * left)


def subdivision():
    n, m = 512, 256
    u, v = np.meshgrid(np.arange(n) * 2 * np.pi / n, np.arange(m) * 2 * np.pi / m, indexing="ij")
    ring = 2 + np.cos(v)
    vertices = np.stack([ring * np.cos(u), ring * np.sin(u), np.sin(v)], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(n), np.arange(m), indexing="ij")
    a, b = i * m + j, (i + 1) % n * m + j
    c, d = (i + 1) % n * m + (j + 1) % m, i * m + (j + 1) % m
    faces = np.concatenate([np.stack(t, axis=-1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])
    mesh = polydata(vertices, faces)
    start = time.process_time()
    loop = vtk.vtkLoopSubdivisionFilter()
    loop.SetInputData(mesh)
    loop.SetNumberOfSubdivisions(1)
    loop.Update()
    made = loop.GetOutput().GetNumberOfPolys()
    report(f"smooth mesh from {len(faces)} triangles", "vtkLoopSubdivisionFilter",
           time.process_time() - start, made, FLAT_BYTES * made)


def main():
    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("General.NumThreads", 1)
    for name in SURFACES:
        marching_cubes(name)
        curved_elements(name)
    gmsh.finalize()
    decimation()
    subdivision()


if __name__ == "__main__":
    main()
