"""Prints what VTK finds in FILE.vtu: the numbers of points and cells, then every array, one line each."""
import sys
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
reader.Update()
grid = reader.GetOutput()
print("points", grid.GetNumberOfPoints())
print("cells", grid.GetNumberOfCells())


def show(kind, array):
    values = [repr(array.GetComponent(i, c)) for i in range(array.GetNumberOfTuples())
              for c in range(array.GetNumberOfComponents())]
    print(kind, array.GetName(), array.GetNumberOfComponents(), *values)


show("coordinates", grid.GetPoints().GetData())
for c in range(grid.GetNumberOfCells()):
    ids = grid.GetCell(c).GetPointIds()
    print("cell", grid.GetCellType(c), *[ids.GetId(i) for i in range(ids.GetNumberOfIds())])
for kind, data in (("point", grid.GetPointData()), ("element", grid.GetCellData())):
    for k in range(data.GetNumberOfArrays()):
        show(kind, data.GetArray(k))
