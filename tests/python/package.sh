#!/bin/sh
# pip installs ./python offline into a virtual environment with system packages, and pytest runs there: these tests, the
# examples in the package, and those of docs/python.md and docs/python_obstacles.md. Exit status 77: what this needs is
# not installed.
#   package.sh BUILD SOURCE ENVIRONMENT
set -eu
build=$1 source=$2 environment=$3

for needed in ensurepip:python3-venv pip:python3-pip numpy:python3-numpy scipy:python3-scipy pytest:python3-pytest; do
  /usr/bin/python3 -c "import ${needed%%:*}" 2>/dev/null || missing="${missing:-} ${needed#*:}"
done
if [ -n "${missing:-}" ]; then
  echo "skipped, for these Debian packages are missing:$missing (./dev setup installs them)"
  exit 77
fi

export PYTHONDONTWRITEBYTECODE=1
python=$environment/bin/python
[ -x "$python" ] || /usr/bin/python3 -m venv --system-site-packages "$environment"
SIGNORINI_LIBRARY=$build/lib "$python" -m pip install --quiet --no-index --disable-pip-version-check --force-reinstall \
  --no-deps "$source/python"
"$python" -m pip check --disable-pip-version-check | grep signorini && exit 1

unset SIGNORINI_LIBRARY
export SIGNORINI_BUILD="$build" SIGNORINI_PROGRAM="$build/bin/signorini"
cd "$source"
"$python" -m pytest -q -p no:cacheprovider --doctest-modules --doctest-glob='*.md' --pyargs signorini tests/python \
  docs/python.md docs/python_obstacles.md
