"""VTK evaluates the cells of our .vtu files where we do, and finds no gaps in any format."""

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from report import Checks

checks = Checks()


def read(reader, path):
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def open_edges(surface):
    """Edges without a second triangle after equal points are merged."""
    merge = vtk.vtkCleanPolyData()
    merge.SetInputData(surface)
    merge.ToleranceIsAbsoluteOn()
    merge.SetAbsoluteTolerance(0.0)
    edges = vtk.vtkFeatureEdges()
    edges.SetInputConnection(merge.GetOutputPort())
    edges.BoundaryEdgesOn()
    edges.NonManifoldEdgesOn()
    edges.FeatureEdgesOff()
    edges.ManifoldEdgesOff()
    edges.Update()
    return edges.GetOutput().GetNumberOfCells()


def tessellated(grid, level):
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(grid)
    surface.SetNonlinearSubdivisionLevel(level)
    surface.Update()
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputConnection(surface.GetOutputPort())
    triangles.Update()
    return triangles.GetOutput()


def volume(surface):
    mass = vtk.vtkMassProperties()
    mass.SetInputData(surface)
    mass.Update()
    return mass.GetVolume()


def largest_difference(grid, points):
    """Between our points and those of VTK at the same parameters."""
    worst = 0.0
    for cell_id, r, s, x, y, z in points:
        cell = grid.GetCell(int(cell_id))
        found = [0.0] * 3
        weights = [0.0] * cell.GetNumberOfPoints()
        cell.EvaluateLocation(vtk.reference(0), [r, s, 0.0], found, weights)
        worst = max(worst, max(abs(a - b) for a, b in zip(found, (x, y, z))))
    return worst


for sample, path in checks.of_kind("vtu"):
    grid = read(vtk.vtkXMLUnstructuredGridReader(), path)
    checks.claim(sample, f"{grid.GetNumberOfCells()} cells", grid.GetNumberOfCells() == sample["cells"])
    kinds = {grid.GetCellType(cell) for cell in range(grid.GetNumberOfCells())}
    checks.claim(sample, f"cell types {kinds}", kinds == set(sample["cell_types"]))
    worst = largest_difference(grid, sample["points"]) / sample["size"]
    checks.note(sample, f"largest difference of points {worst:.1e} of the size")
    checks.claim(sample, f"points differ by {worst:.2e}", worst <= sample["point_tolerance"])
    for level in (0, 2):
        edges = open_edges(tessellated(grid, level))
        checks.claim(sample, f"level {level}: {edges} open edges", edges == 0)

for sample, path in checks.of_kind("pvtu"):
    grid = read(vtk.vtkXMLPUnstructuredGridReader(), path)
    checks.claim(sample, f"{grid.GetNumberOfCells()} cells", grid.GetNumberOfCells() == sample["cells"])
    edges = open_edges(tessellated(grid, 2))
    checks.claim(sample, f"{edges} open edges", edges == 0)
    names = {grid.GetCellData().GetArrayName(k) for k in range(grid.GetCellData().GetNumberOfArrays())}
    checks.claim(sample, f"cell data {names}", names == set(sample["cell_data"]))


def glb(path):
    reader = vtk.vtkGLTFReader()
    reader.SetFileName(path)
    reader.Update()
    surface = vtk.vtkCompositeDataGeometryFilter()
    surface.SetInputConnection(reader.GetOutputPort())
    surface.Update()
    return surface.GetOutput()


READERS = {
    "ply": lambda path: read(vtk.vtkPLYReader(), path),
    "stl": lambda path: read(vtk.vtkSTLReader(), path),
    "obj": lambda path: read(vtk.vtkOBJReader(), path),
    "glb": glb,
}
for sample, path in checks.of_kind("triangles"):
    surface = READERS[sample["format"]](path)
    count = surface.GetNumberOfPolys()
    checks.claim(sample, f"{count} triangles", count == sample["triangles"])
    edges = open_edges(surface)
    checks.claim(sample, f"{edges} open edges", edges == 0)
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    checks.claim(sample, "points are finite", bool(np.isfinite(points).all()))
    if "volume" in sample:
        found = volume(surface)
        off = abs(found - sample["volume"]) / sample["volume"]
        checks.note(sample, f"volume differs by {off:.1e}")
        checks.claim(sample, f"volume differs by {off:.2e}", off <= sample["volume_tolerance"])

checks.finish("VTK " + vtk.vtkVersion.GetVTKVersion())
