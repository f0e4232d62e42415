"""Tables of docs/measured name commands that there are, and ./dev measured replaces what these printed, nothing else.

    pages.py SOURCE   (the source tree)
"""
import fnmatch
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

source = pathlib.Path(sys.argv[1]).resolve()
scripts = [*(source / "apps/bench").glob("*.py"), *(source / "python").glob("*.py")]
code = {file.name: file.read_text() for file in scripts} | {
    "signorini_bench": "", "signorini_peers": "", "apps/cases/run.py": (source / "apps/cases/run.py").read_text()}
for file in sorted((source / "apps/bench").rglob("*.cpp")):
    code["signorini_peers" if "peers" in file.parts else "signorini_bench"] += file.read_text()
tests = [".".join(names) for file in (source / "tests").rglob("*.cpp")
         for names in re.findall(r"^TEST(?:_F|_P)?\((\w+), (\w+)\)", file.read_text(), re.M)]
wrong = []


def prints_heading(text, section):
    """Whether a heading in the sources may begin so: as it stands, around what is filled in, or as a text that is."""
    headings = [re.split(r"\{[^}]*\}", heading) for heading in re.findall(r"##+ (.*?)(?:\\n|\")", text)]
    pieces = [piece.strip(" ,") for heading in headings for piece in heading]
    return f'"{section}' in text or any(section in p or (len(p) > 3 and p in section) for p in pieces)


def check_test(place, arguments):
    """The tests that a filter names stand in the sources."""
    for one in arguments[0].removeprefix("--gtest_filter=").split(":"):
        if not fnmatch.filter(tests, one):
            wrong.append(f"{place}: there is no test {one}")


def check(place, command, section):
    """The program, its flags and the heading stand in the sources."""
    name, *arguments = command.split()
    if name.startswith("test_"):
        check_test(place, arguments)
        return
    if name not in code:
        wrong.append(f"{place}: {name} is no program of benchmarks, no test and no script")
        return
    if name in ("solves.py", "stability.py") and f"def {arguments[0]}(" not in code[name]:
        wrong.append(f"{place}: {name} has no {arguments[0]}")
    for flag in arguments:
        if flag.startswith("--") and f'"{flag}"' not in code[name]:
            wrong.append(f"{place}: {name} has no {flag}")
    if section and section not in arguments and not prints_heading(code[name], section):
        wrong.append(f"{place}: {name} prints no heading that begins with '{section}'")


for page in sorted((source / "docs/measured").glob("*.md")):
    text = re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.M | re.S)
    marks = re.findall(r"<!-- (written by: (.*?)(?: # (.*?))?|end) -->", text)
    for k, (mark, command, section) in enumerate(marks):
        if (mark == "end") != (k % 2 == 1):
            wrong.append(f"{page.name}: '{mark}' is where the other mark belongs")
        elif mark != "end":
            check(page.name, command, section)
    if len(marks) % 2:
        wrong.append(f"{page.name}: the last table has no end")
if wrong:
    sys.exit("\n".join(wrong))

before = """Prose, with 3 figures.

<!-- written by: signorini_bench --again # Second -->

| old |

<!-- end -->

<!-- written by: signorini_bench --again -->

```
old
```

<!-- end -->

<!-- written by: signorini_peers --ball -->

| kept, since the program is not there |

<!-- end -->
"""
printed = "## First\n\n| 1 |\n\n## Second solve\n\n| 2 |\n\n### Below\n\n| 3 |\n\n## Third\n"
after = before.replace("| old |", "| 2 |\n\n### Below\n\n| 3 |").replace(
    "```\nold\n```", f"```\n{printed}```")
with tempfile.TemporaryDirectory() as made:
    tree = pathlib.Path(made)
    for folder in ("apps/bench", "docs/measured", "build/release/bin"):
        (tree / folder).mkdir(parents=True)
    shutil.copy(source / "apps/bench/measured.py", tree / "apps/bench")
    (tree / "docs/measured/page.md").write_text(before)
    program = tree / "build/release/bin/signorini_bench"
    program.write_text(f"#!/bin/sh\ntest \"$1\" = --again || exit 1\ncat <<'END'\n{printed}END\n")
    program.chmod(0o755)
    subprocess.run(["/usr/bin/python3", tree / "apps/bench/measured.py", "page"], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    found = (tree / "docs/measured/page.md").read_text()
    if found != after:
        sys.exit(f"the page has become\n{found}")
