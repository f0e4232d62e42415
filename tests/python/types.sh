#!/bin/sh
# mypy --strict has nothing to say of the package. Exit status 77: it, or what it reads, is not installed.
#   types.sh SOURCE CACHE
set -eu
if ! /usr/bin/python3 -c "import mypy, numpy" 2>/dev/null; then
  echo "skipped, for Debian packages are missing: mypy python3-numpy (./dev setup installs them)"
  exit 77
fi
cd "$1/python"
/usr/bin/python3 -m mypy --strict --cache-dir "$2" signorini wheel_backend.py bench.py notebook.py
