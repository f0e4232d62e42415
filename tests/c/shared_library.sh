#!/bin/sh
# The installed libsignorini_c.so exports what c/signorini.h declares and nothing else, pkg-config finds it for a C
# compiler, and the examples of docs/black_box_programs.md in C and in Python, by ctypes, print the same.
#   shared_library.sh CMAKE BUILD SOURCE SCRATCH
set -eu
cmake=$1 build=$2 source=$3 scratch=$4
here=$source/tests/c

rm -rf "$scratch"
for component in c dev libraries; do
  "$cmake" --install "$build" --prefix "$scratch/prefix" --component $component >/dev/null
done
PKG_CONFIG_PATH=$(dirname "$(find "$scratch/prefix" -name signorini_c.pc)")
export PKG_CONFIG_PATH
libraries=$(pkg-config --variable=libdir signorini_c)
library=$libraries/libsignorini_c.so.2

nm -D --defined-only --format=just-symbols "$library" | sort >"$scratch/exported"
grep -o 'signorini_[a-z0-9_]*(' "$source/c/signorini.h" | grep -v '^signorini_monitor(' | tr -d '(' | sort -u >"$scratch/declared"
diff "$scratch/exported" "$scratch/declared"
readelf -d "$library" | grep -q 'SONAME.*\[libsignorini_c\.so\.2\]'
# It needs what a matrix needs: nothing of this project, and nothing that reads scenes, meshes or archives.
readelf -d "$library" | sed -n 's/.*NEEDED.*\[\(.*\)\].*/\1/p' >"$scratch/needed"
if grep -E 'signorini|toml|pugixml|muparser|deflate|libz\.|cairo|CGAL|gmp|mpfr|cholmod|umfpack' "$scratch/needed"; then
  echo "libsignorini_c.so needs these"
  exit 1
fi
# What is installed beside the libraries: the licence, what stays compatible, a soname for the core, and no option for
# this machine's processor in the targets.
test -n "$(find "$scratch/prefix" -name LICENSE)"
test -n "$(find "$scratch/prefix" -name abi.md)"
readelf -d "$libraries/libsignorini_core.so" | grep -q 'SONAME.*\[libsignorini_core\.so\.[0-9]*\.[0-9]*\]'
if grep -r 'march=' "$libraries/cmake" "$libraries/pkgconfig"; then exit 1; fi

# shellcheck disable=SC2046
cc "$here/outside/membrane.c" -o "$scratch/membrane" $(pkg-config --cflags --libs signorini_c) -Wl,-rpath,"$libraries"
"$scratch/membrane" >"$scratch/from_c"
PYTHONMALLOC=debug python3 "$here/membrane.py" "$library" >"$scratch/from_python"
diff "$scratch/from_c" "$scratch/from_python"
test "$(grep -c carries "$scratch/from_c")" = 3
python3 - "$here/membrane.py" "$source/docs/black_box_programs.md" "$source/c/signorini.h" <<'EOF'
import re
import sys
example, page, header = (open(name).read() for name in sys.argv[1:])
struct = re.search(r"typedef struct \{([^}]*)\} signorini_summary;", re.sub(r"/\*.*?\*/", "", header, flags=re.S)).group(1)
declared = re.findall(r"(\w+)\s*[,;]", struct)
shown = re.findall(r'\("(\w+)", c_\w+\)', example)
if declared != shown:
    sys.exit(f"Summary in membrane.py has {shown}, signorini_summary {declared}")
sys.exit(0 if example in page else "docs/black_box_programs.md does not show membrane.py as it is tested")
EOF
