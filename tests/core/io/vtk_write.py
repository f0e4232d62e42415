"""Lets VTK write a unit square of two triangles, its lower side in group 4, into FOLDER in every way it knows."""
import itertools
import sys
from vtkmodules.vtkCommonCore import vtkIntArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

points = vtkPoints()
for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)):
    points.InsertNextPoint(x, y, 0)
grid = vtkUnstructuredGrid()
grid.SetPoints(points)
groups = vtkIntArray()
groups.SetName("CellEntityIds")
for kind, cell, group in ((3, (0, 1), 4), (5, (0, 1, 2), 1), (5, (0, 2, 3), 1)):
    grid.InsertNextCell(kind, len(cell), cell)
    groups.InsertNextValue(group)
grid.GetCellData().AddArray(groups)

choices = itertools.product((0, 1, 2), (False, True), (False, True), (32, 64), (0, 1))
for mode, compressed, encoded, header, order in choices:
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetDataMode(mode)  # ascii, binary, appended
    writer.SetEncodeAppendedData(encoded)
    if compressed:
        writer.SetCompressorTypeToZLib()
    else:
        writer.SetCompressorTypeToNone()
    writer.SetHeaderType(header)
    writer.SetByteOrder(order)
    writer.SetFileName(f"{sys.argv[1]}/mode{mode}_{compressed}_{encoded}_{header}_{order}.vtu")
    writer.Write()
