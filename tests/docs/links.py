"""Every relative link of the pages, and every page that the sources name, exists; so do headings behind a #.
Every scene has a row in apps/scenes/README.md. A guide, which docs/README.md names for a task or a trouble, has 1500
words at most; what the program has written does not count. Pages of docs/measured have no tables but those that a
command has written.

    links.py SOURCE   (the source tree)
"""
import pathlib
import re
import sys

source = pathlib.Path(sys.argv[1]).resolve()
wrong = []
writers = {"arrows.sh", "pages.py"}  # tests that write pages of their own


def files(*patterns):
    """Of the source tree, without what is built or written."""
    for pattern in patterns:
        for file in sorted(source.rglob(pattern)):
            if file.is_file() and not re.match(r"build|out$|\.", file.relative_to(source).parts[0]):
                yield file


def without_code(text):
    return re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S)


def anchors(page):
    """As GitHub makes them of headings."""
    found = []
    for heading in re.findall(r"^#+ +(.*)$", without_code(page.read_text()), re.M):
        plain = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower()
        name = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
        found.append(name if name not in found else f"{name}-{sum(other.startswith(name) for other in found)}")
    return found


for page in files("*.md"):
    text = re.sub(r"`[^`\n]*`", "", without_code(page.read_text()))
    for link in re.findall(r"\]\(([^)\s]+)\)|src=\"([^\"]+)\"", text):
        target, _, anchor = (link[0] or link[1]).partition("#")
        if re.match(r"\w+:", target):
            continue
        file = (page.parent / target).resolve() if target else page
        if not file.exists():
            wrong.append(f"{page.relative_to(source)}: there is no {target}")
        elif anchor and file.suffix == ".md" and anchor not in anchors(file):
            wrong.append(f"{page.relative_to(source)}: {target} has no heading #{anchor}")

for file in files("*.cpp", "*.hpp", "*.h", "*.py", "*.sh", "*.cmake", "*CMakeLists.txt", "*.toml", "dev"):
    for name in re.findall(r"\bdocs/(?:\w+/)*\w+(?:\.\w+)+\b", file.read_text(errors="replace")):
        if file.name not in writers and not (source / name).exists():
            wrong.append(f"{file.relative_to(source)}: there is no {name}")

scenes = (source / "apps/scenes/README.md").read_text()
wrong += [f"apps/scenes/README.md: no row for {file.name}" for file in files("*.toml")
          if file.parent == source / "apps/scenes" and f"({file.name}): " not in scenes]

tasks = (source / "docs/README.md").read_text().partition("## How it works")[0]
for name in sorted(set(re.findall(r"\]\((\w+\.md)", tasks))):
    text = (source / "docs" / name).read_text()
    if "Do not edit" not in text and len(text.split()) > 1500:
        wrong.append(f"docs/{name} has {len(text.split())} words, and 1500 are the limit")

for page in (source / "docs/measured").glob("*.md"):
    by_hand = without_code(re.sub(r"^<!-- written by: .*?^<!-- end -->$", "", page.read_text(), flags=re.M | re.S))
    if page.name != "README.md" and re.search(r"^\| *---", by_hand, re.M):
        wrong.append(f"docs/measured/{page.name} has a table that no command has written")

if wrong:
    sys.exit("\n".join(wrong))
