"""OpenCASCADE takes our STEP files as valid closed solids, smooth across every seam."""

import math
import tempfile

import numpy as np
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve2d, BRepAdaptor_Surface
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common, BRepAlgoAPI_Cut
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepGProp import BRepGProp
from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox
from OCP.collections import (
    IndexedDataMap_TopoDS_Shape_List_TopoDS_Shape_TopTools_ShapeMapHasher as ShapesOfShapes,
)
from OCP.gp import gp_Pnt, gp_Vec
from OCP.GProp import GProp_GProps
from OCP.IFSelect import IFSelect_RetDone
from OCP.Message import Message
from OCP.STEPControl import STEPControl_AsIs, STEPControl_Reader, STEPControl_Writer
from OCP.TopAbs import TopAbs_EDGE, TopAbs_FACE, TopAbs_SHELL, TopAbs_SOLID
from OCP.TopExp import TopExp, TopExp_Explorer
from OCP.TopoDS import TopoDS

from report import Checks

# its own messages would stand between ours
for printer in list(Message.DefaultMessenger_s().Printers()):
    Message.DefaultMessenger_s().RemovePrinter(printer)

checks = Checks()
as_edge = getattr(TopoDS, "Edge_s", None) or TopoDS.Edge
as_face = getattr(TopoDS, "Face_s", None) or TopoDS.Face


def read(path):
    reader = STEPControl_Reader()
    if reader.ReadFile(path) != IFSelect_RetDone:
        return None
    reader.TransferRoots()
    return reader.OneShape()


def count(shape, kind):
    explorer, found = TopExp_Explorer(shape, kind), 0
    while explorer.More():
        found += 1
        explorer.Next()
    return found


def is_valid(shape):
    return BRepCheck_Analyzer(shape).IsValid()


def volume(shape):
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, properties)
    return properties.Mass()


def edges_with_faces(shape):
    """Edges of positive length and the faces at each."""
    faces_of = ShapesOfShapes()
    TopExp.MapShapesAndAncestors_s(shape, TopAbs_EDGE, TopAbs_FACE, faces_of)
    for index in range(1, faces_of.Extent() + 1):
        edge = as_edge(faces_of.FindKey(index))
        if not BRep_Tool.Degenerated_s(edge):
            yield edge, [as_face(face) for face in faces_of.FindFromIndex(index)]


def normal(face, edge, t):
    """The outward normal of a face at a point of an edge, and the point."""
    place = BRepAdaptor_Curve2d(edge, face).Value(t)
    point, along_u, along_v = gp_Pnt(), gp_Vec(), gp_Vec()
    BRepAdaptor_Surface(face).D1(place.X(), place.Y(), point, along_u, along_v)
    across = along_u.Crossed(along_v)
    return np.array([across.X(), across.Y(), across.Z()]), point


def seams(edges):
    """The largest angle between normals and the largest gap at inner points of all edges."""
    angle = gap = 0.0
    for edge, faces in edges:
        if len(faces) != 2:
            continue
        first, last = BRep_Tool.Range_s(edge)
        for t in np.linspace(first, last, 7)[1:-1]:
            (a, p), (b, q) = normal(faces[0], edge, t), normal(faces[1], edge, t)
            gap = max(gap, p.Distance(q))
            angle = max(angle, math.atan2(np.linalg.norm(np.cross(a, b)), a @ b))
    return angle, gap


def check_boolean(sample, shape, whole):
    """Cuts off a part with a box; both parts are valid and make up the whole."""
    low, high = sample["box"]
    box = BRepPrimAPI_MakeBox(gp_Pnt(*low), gp_Pnt(*high)).Shape()
    common, rest = BRepAlgoAPI_Common(shape, box).Shape(), BRepAlgoAPI_Cut(shape, box).Shape()
    checks.claim(sample, "both parts of a boolean are valid", is_valid(common) and is_valid(rest))
    parts = volume(common), volume(rest)
    off = abs(sum(parts) - whole) / whole
    checks.claim(sample, f"parts {parts} of a boolean differ by {off:.1e}", min(parts) > 0 and off < 1e-6)


def check_round_trip(sample, shape, whole):
    with tempfile.TemporaryDirectory() as folder:
        path = f"{folder}/again.step"
        writer = STEPControl_Writer()
        writer.Transfer(shape, STEPControl_AsIs)
        writer.Write(path)
        again = read(path)
    off = abs(volume(again) - whole) / whole
    checks.claim(sample, f"valid after a round trip, volume differs by {off:.1e}", is_valid(again) and off < 1e-9)


for sample, path in checks.of_kind("step"):
    shape = read(path)
    checks.claim(sample, "can be read", shape is not None)
    if shape is None:
        continue
    checks.claim(sample, "valid", is_valid(shape))
    found = [count(shape, kind) for kind in (TopAbs_SOLID, TopAbs_SHELL, TopAbs_FACE)]
    expected = [sample["solids"], sample["shells"], sample["faces"]]
    checks.claim(sample, f"solids, shells, faces {found}, not {expected}", found == expected)
    edges = list(edges_with_faces(shape))
    # edges can be shared only by entity, so a closed shell has no edge with one face
    alone = sum(len(faces) != 2 for _, faces in edges)
    checks.claim(sample, f"{alone} open edges", (alone == 0) == (sample["solids"] > 0))
    tolerance = max(BRep_Tool.Tolerance_s(edge) for edge, _ in edges)
    # OpenCASCADE has no smaller one than 1e-7
    checks.claim(sample, f"largest edge tolerance {tolerance:.2e}", tolerance <= 1.000001e-7)
    angle, gap = seams(edges)
    checks.note(sample, f"{len(edges)} edges, seams: angle {angle:.1e} rad, gap {gap:.1e}")
    checks.claim(sample, f"seams open by {gap:.2e}", gap <= 1e-13 * sample["size"])
    if sample["smooth"]:
        checks.claim(sample, f"normals at seams differ by {angle:.2e} rad", angle <= 1e-9)
    if sample["solids"] == 0:
        continue
    whole = volume(shape)
    if "volume" in sample:
        off = abs(whole - sample["volume"])
        checks.note(sample, f"volume differs by {off / sample['volume']:.1e}")
        checks.claim(sample, f"volume {whole} differs by {off:.2e}", off <= sample["volume_tolerance"])
    if sample.get("operations"):
        check_boolean(sample, shape, whole)
        check_round_trip(sample, shape, whole)

checks.finish("OpenCASCADE")
