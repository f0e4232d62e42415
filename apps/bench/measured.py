"""Runs the commands that wrote the tables of docs/measured again, and puts what they print in place of what is there.

    measured.py [PAGE [TEXT]]   (a page without .md; of its commands those with this text in them)

    <!-- written by: signorini_bench --again # A second solve -->
    ...
    <!-- end -->

A command is followed by # and the beginning of a heading where only that section of its output belongs there. Programs
are those of build/release, build/peers and, for tests, build/release-assert, and the scripts of this folder, of python
and, by their paths, of the source tree. What is not built is left out. Of a test stands here what it shows with SHOW=1,
as a code block; where it shows nothing, since it wants meshes that are not here (SIGNORINI_MESHES), the old text stays.
What takes the place of a code block is one.
"""
import os
import pathlib
import re
import shlex
import subprocess
import sys

source = pathlib.Path(__file__).resolve().parents[2]
folders = [source / folder for folder in (
    "build/release/bin", "build/peers/bin", "build/release-assert/bin", "apps/bench", "python", ".")]
of_gtest = re.compile(r"^(\[.*|Running main\(\).*|Note: Google Test.*)?\n", re.M)
begin, end = r"<!-- written by: (?P<command>[^#\n]*?)(?: # (?P<section>[^\n]*?))? -->\n", "<!-- end -->"
marked = re.compile(f"({begin})(?P<old>.*?)({end})", re.S)
printed, left_out = {}, []


def output_of(command):
    """What the command prints, None where its program is not built. A command that several tables need runs once."""
    if command not in printed:
        name, *arguments = shlex.split(command)
        program = next((folder / name for folder in folders if (folder / name).exists()), None)
        if not program:
            left_out.append(f"since the program is not built: {command}")
            return None
        print(f"{command} ...", file=sys.stderr, flush=True)
        # Else threads of OpenBLAS count as time of the program.
        environment = os.environ | {"OMP_NUM_THREADS": "1", "SHOW": "1"}
        runner = [sys.executable] if name.endswith(".py") else []
        ended = subprocess.run([*runner, program, *arguments], cwd=source, env=environment, stdout=subprocess.PIPE,
                               text=True)
        if ended.returncode:
            sys.exit(f"measured: {command} ended with {ended.returncode}; pages before this one are renewed")
        printed[command] = of_gtest.sub("", ended.stdout) if name.startswith("test_") else ended.stdout
        if not printed[command]:
            left_out.append(f"since it shows nothing here: {command}")
    return printed[command]


def section_of(text, title):
    """What stands below the heading that begins with the title, up to the next heading of its level or above."""
    found = re.search(rf"^(#+) {re.escape(title)}.*\n", text, re.M)
    if not found:
        sys.exit(f"measured: no heading of the output begins with '{title}'")
    rest = text[found.end():]
    end = re.search(rf"^#{{1,{len(found[1])}}} ", rest, re.M)
    return rest[:end.start()] if end else rest


def renewed(match, wanted):
    command, section = match["command"], match["section"]
    if wanted not in f"{command} # {section}":
        return match[0]
    text = output_of(command)
    if not text:
        return match[0]
    text = (section_of(text, section) if section else text).strip("\n")
    if command.startswith("test_") or match["old"].lstrip("\n").startswith("```"):
        text = f"```\n{text}\n```"
    return f"{match[1]}\n{text}\n\n{match[5]}"


def main(page="", wanted=""):
    pages = sorted((source / "docs/measured").glob(f"{page or '*'}.md"))
    if not pages:
        sys.exit(f"measured: there is no docs/measured/{page}.md")
    for file in pages:
        if file.name == "README.md":
            continue
        old = file.read_text()
        new = marked.sub(lambda match: renewed(match, wanted), old)
        if new != old:
            file.write_text(new)
            print(f"docs/measured/{file.name} is renewed")
    for command in dict.fromkeys(left_out):
        print(f"left out, {command}", file=sys.stderr)


main(*sys.argv[1:])
