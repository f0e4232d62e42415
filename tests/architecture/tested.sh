#!/usr/bin/env bash
# Every module of core/fem and of driver has a test that includes it: else nobody says what it promises by itself.
# Headers of constants alone promise nothing.
#   tested.sh check ROOT      lists the modules under ROOT without a test, fails if there are any
#   tested.sh selftest ROOT   the check sees what is missing, and nothing else
set -euo pipefail

# Headers of FOLDERS below the present folder that declare more than constants: a function or a type.
modules() {
  find "$@" -name '*.hpp' | sort | while IFS= read -r header; do
    sed 's|//.*||' "$header" | grep -qE '\(|\b(struct|class|enum|using)\b' && printf '%s\n' "$header"
  done
}

untested() (
  cd "$1"
  modules core/fem driver |
    grep -vxFf <(grep -rhoE '^#include "[^"]+"' --include='*_test.cpp' tests | sed 's/.*"\(.*\)"/\1/' | sort -u) |
    sed 's|$| has no test that includes it|'
)

check() {
  local found
  found=$(untested "$1") || true
  [ -z "$found" ] && return
  printf '%s\n' "$found"
  return 1
}

# try KIND HEADER INCLUDED: a tree with a test that includes something must be found wrong; KIND good: must not.
try() {
  local tree found=good
  tree=$(mktemp -d "$scratch/XXXX")
  mkdir -p "$tree/core/fem/pairs" "$tree/driver" "$tree/tests/core/fem"
  printf '%s\n' "$2" >"$tree/core/fem/pairs/a.hpp"
  printf '#include "%s"\n' "$3" >"$tree/tests/core/fem/some_test.cpp"
  check "$tree" >/dev/null || found=wrong
  [ "$found" = "$1" ] || { echo "expected $1, found $found: '$2', test of $3"; failed=1; }
}

selftest() {
  failed=0
  try good 'int f();' core/fem/pairs/a.hpp
  try wrong 'int f();' core/fem/a.hpp
  try wrong 'struct A {' core/fem/pairs/a.h
  try good 'inline constexpr int most = 3;  // (rings)' core/fem/a.hpp
  return "$failed"
}

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$1" "$2"
