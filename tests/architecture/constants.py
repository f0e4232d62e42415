"""Numbers in the sources of the solver that stand for a judgement: literals with a point or an exponent, other than 0, 1, 2
and 0.5. Prints them with their places, and how many there are in each folder.

    constants.py SOURCE [--count]   (the source tree; --count: without the list)
"""
import pathlib
import re
import sys

source = pathlib.Path(sys.argv[1]).resolve()
folders = ["core/solver", "core/fem", "core/base", "driver", "methods", "amg", "smoothers"]
literal = re.compile(r"(?<![\w.])(?:0x[0-9a-f]*p[+-]?\d+|\d+\.\d*(?:e[+-]?\d+)?|\d+e[+-]?\d+|\.\d+)(?![\w.])", re.I)
plain = {0.0, 1.0, 2.0, 0.5}


def without_texts(line):
    """Comments and strings say numbers, and are none."""
    return re.sub(r"//.*", "", re.sub(r'"(?:[^"\\]|\\.)*"', '""', line))


def value(text):
    return float.fromhex(text) if text.lower().startswith("0x") else float(text)


counts = {}
for folder in folders:
    found = []
    for file in sorted((source / folder).rglob("*.[ch]pp")):
        text = re.sub(r"/\*.*?\*/", lambda m: "\n" * m[0].count("\n"), file.read_text(), flags=re.S)
        for number, line in enumerate(text.splitlines(), 1):
            found += [(file.relative_to(source), number, text, line.strip())
                      for text in literal.findall(without_texts(line)) if value(text) not in plain]
    counts[folder] = (len(found), sum(value(text) < 1e-9 for _, _, text, _ in found))
    if "--count" not in sys.argv:
        for file, number, text, line in found:
            print(f"{file}:{number}: {text}: {line}")
for folder, (all_of, tiny) in counts.items():
    print(f"{folder}: {all_of}, {tiny} of them below 1e-9")
print(f"all: {sum(c[0] for c in counts.values())}, {sum(c[1] for c in counts.values())} of them below 1e-9")
