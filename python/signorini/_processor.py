"""For which processors a library was compiled. Used when the wheel is built, too: the standard library alone."""
from __future__ import annotations

import re
from pathlib import Path

_used_by_compilers = re.compile(r"avx|fma|f16c|bmi|abm|popcnt|movbe|adx|sse|ssse|aes|pclmul|vpclmul|gfni|sha_ni|amx")


def instructions() -> set[str]:
    """Those of this machine's processor that compilers use; empty where it does not say."""
    try:
        text = Path("/proc/cpuinfo").read_text()
    except OSError:
        return set()
    found = re.search(r"^flags\s*:(.*)$", text, re.M)
    return {flag for flag in found.group(1).split() if _used_by_compilers.match(flag)} if found else set()


def needed_by(library: Path) -> list[str]:
    """By a library in a build tree: all of this machine, where it was compiled for this machine."""
    cache = library.parent.parent / "CMakeCache.txt"
    native = cache.is_file() and re.search(r"^SIGNORINI_NATIVE:BOOL=(ON|1|TRUE|YES)$", cache.read_text(), re.M)
    return sorted(instructions()) if native else []
