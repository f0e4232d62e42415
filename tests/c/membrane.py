# A membrane on a square that a load presses onto a floor: python3 membrane.py libsignorini_c.so.2
import sys
from ctypes import CDLL, POINTER, Structure, byref, c_char_p, c_double, c_int, c_int32, c_void_p

library = CDLL(sys.argv[1])
library.signorini_message.restype = c_char_p
library.signorini_solve.argtypes = [c_void_p] + 4 * [POINTER(c_double)] + [c_double] + 2 * [POINTER(c_double)] + [c_void_p]
library.signorini_destroy.argtypes = [c_void_p]


class Summary(Structure):  # signorini_summary
    _fields_ = [("iterations", c_int), ("levels", c_int), ("residual", c_double), ("algebraic_error", c_double),
                ("energy", c_double), ("rate", c_double), ("rounding_error", c_double),
                ("limited_by_rounding", c_int32)]


def call(function, *arguments):
    if function(*arguments) != 0:
        sys.exit(library.signorini_message().decode())


side = 200
n = side * side
row, column, value = [0], [], []
for i in range(n):  # the five-point stencil on the inner nodes of a grid, row by row
    x, y = i % side, i // side
    neighbours = [i - 1] * (x > 0) + [i + 1] * (x + 1 < side) + [i - side] * (y > 0) + [i + side] * (y + 1 < side)
    column += [i] + neighbours
    value += [4] + [-1] * len(neighbours)
    row.append(len(column))

solver = c_void_p()
call(library.signorini_create, n, (c_int32 * (n + 1))(*row), (c_int32 * len(column))(*column),
     (c_double * len(value))(*value), 1, byref(solver))
Vector = c_double * n
load, x, force, start = Vector(*[-1 / n] * n), Vector(), Vector(), None
for step in range(1, 4):  # the floor sinks; each step starts from the one before
    floor = -0.02 * step
    summary = Summary()
    call(library.signorini_solve, solver, load, Vector(*[floor] * n), None, start, 1e-8, x, force, byref(summary))
    print(f"floor {floor:g} carries {sum(force):.4f}: {summary.iterations} cycles on {summary.levels} levels")
    start = x
library.signorini_destroy(solver)
