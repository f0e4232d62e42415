#!/bin/bash
# The Debian packages: lintian finds no error, dpkg installs them into an empty root, and what lies there is all that the
# examples of the pages need. Exit status 77: this system has no dpkg.
#   debian.sh CMAKE BUILD SOURCE SCRATCH COMPILER GPL
set -euo pipefail
cmake=$1 build=$2 source=$3 scratch=$4 compiler=$5 gpl=$6
command -v dpkg-shlibdeps >/dev/null || { echo "skipped, for there is no dpkg-shlibdeps"; exit 77; }

failed=0
wrong() { echo "$*"; failed=1; }

rm -rf "$scratch"
mkdir -p "$scratch"
if ! "$(dirname "$cmake")/cpack" --config "$build/CPackConfig.cmake" -G DEB -B "$scratch/packages" \
  -D CPACK_DEBIAN_COMPRESSION_TYPE=none >"$scratch/cpack.log" 2>&1; then
  cat "$scratch/cpack.log"
  exit 1
fi
cd "$scratch/packages"
names=$(for file in *.deb; do dpkg-deb -f "$file" Package; done | sed 's/[0-9.]*$//' | sort | tr '\n' ' ')
expected="libsignorini libsignorini-c libsignorini-dev libsignorini-sdk signorini $([ "$gpl" = 0 ] || echo "signorini-gpl ")signorini-plugins "
test "$names" = "$expected" || wrong "the packages are $names"
if command -v lintian >/dev/null; then
  # Uncompressed for speed here alone.
  lintian --allow-root --tag-display-limit 0 ./*.deb 2>/dev/null | grep '^E: ' | grep -v data.tar >"$scratch/lintian" || true
  test -s "$scratch/lintian" && wrong "$(cat "$scratch/lintian")"
else
  echo "lintian is not installed"
fi

# Who depends on what: the GPL, and what reads scenes, is in its own packages.
for file in *.deb; do
  package=$(dpkg-deb -f "$file" Package)
  needed=$(dpkg-deb -f "$file" Depends)
  forbidden='^$'
  case $package in
    libsignorini-c*) forbidden='signorini|toml|pugixml|muparser|deflate|zlib|cairo|gmp|cholmod' ;;
    libsignorini-sdk*) forbidden='signorini|fmt|toml|pugixml|muparser|deflate|zlib|cairo|gmp|cholmod' ;;
    signorini-gpl) ;;
    *) forbidden='cholmod|umfpack|gmp|mpfr|signorini-gpl' ;;
  esac
  if grep -iE "$forbidden" <<<"$needed"; then wrong "$package depends on these"; fi
  grep -q "usr/share/doc/$package/copyright" <<<"$(dpkg-deb -c "$file")" || wrong "$file has no copyright"
done

# A root with nothing in it; what the packages depend on is that of this system.
root=$scratch/root
mkdir -p "$root/var/lib/dpkg/updates" "$root/var/lib/dpkg/info"
: >"$root/var/lib/dpkg/status"
: >"$root/var/lib/dpkg/available"
if ! dpkg --root="$root" --log=/dev/null --force-depends --force-not-root --force-bad-path --install ./*.deb >"$scratch/dpkg.log" 2>&1; then
  cat "$scratch/dpkg.log"
  exit 1
fi
installed=$(dpkg-query --admindir="$root/var/lib/dpkg" -W -f '${db:Status-Status}\n' | sort | uniq -c)
grep -qE '^ *[67] installed$' <<<"$installed" || wrong "dpkg says: $installed"

folder=$(dirname "$(find "$root/usr/lib" -name 'libsignorini_core.so.*' | head -n 1)")
if find "$folder" -name 'lib*.so*' -type f -exec readelf -d {} + | grep -E 'R(UN)?PATH'; then wrong "libraries name folders of this machine"; fi
export LD_LIBRARY_PATH=$folder
program=$root/usr/bin/signorini
"$program" list libraries >"$scratch/libraries" || wrong "list libraries ends with $?"
"$program" solve "$source/apps/scenes/obstacle_radial_2d.toml" --out "$scratch/results" >"$scratch/solve" 2>&1 || wrong "$(cat "$scratch/solve")"
# Without the package under the GPL.
if [ "$gpl" != 0 ]; then
  dpkg --root="$root" --log=/dev/null --force-depends --force-not-root --force-bad-path --remove signorini-gpl >"$scratch/dpkg.log" 2>&1 || wrong "$(cat "$scratch/dpkg.log")"
  find "$folder" -name 'libsignorini_plane.so' | grep . && wrong "is still there"
  "$program" solve "$source/apps/scenes/obstacle_radial_2d.toml" --out "$scratch/results" >"$scratch/solve" 2>&1 || wrong "without GPL: $(cat "$scratch/solve")"
fi
# The examples in C, and a plugin, which the program lists.
example() { # example FOLDER
  if ! { "$cmake" -S "$source/tests/$1/outside" -B "$scratch/$1" -DCMAKE_PREFIX_PATH="$root/usr" \
    -DCMAKE_CXX_COMPILER="$compiler" && "$cmake" --build "$scratch/$1"; } >"$scratch/log" 2>&1; then
    wrong "$1: $(cat "$scratch/log")"
  fi
}
example c
test "$("$scratch/c/membrane" | grep -c carries)" = 3 || wrong "membrane"
example obstacles
SIGNORINI_PLUGIN_PATH=$scratch/obstacles "$program" list obstacles >"$scratch/list" || wrong "list obstacles ends with $?"
grep -q 'slot' "$scratch/list" || wrong "the plugin is not listed: $(cat "$scratch/list")"
grep -q 'contact' "$scratch/list" || wrong "no plugin is found where it is installed: $(cat "$scratch/list")"
exit "$failed"
