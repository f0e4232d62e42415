#!/usr/bin/env bash
# Guards what the compiler cannot: which folder may include which (docs/architecture.md), who may include libraries
# under the GPL, and that no path of somebody's machine is in a file.
#   arrows.sh check ROOT      lists the violations under ROOT, fails if there are any
#   arrows.sh selftest ROOT   the check accepts a good tree and catches every kind of violation
set -euo pipefail

# Folder -> the folders it may include besides itself.
declare -A allowed=(
  [core]=""
  [transfer]="core"
  [smoothers]="core"
  [methods]="core"
  [amg]="core transfer smoothers methods"
  [estimators]="core transfer smoothers"
  [obstacles]="core"
  [driver]="core transfer smoothers methods amg estimators"
)

# "FILE:LINE:HEADER" of every #include below a folder.
includes() {
  grep -rnE '^[[:space:]]*#[[:space:]]*include[[:space:]]*["<]' --include='*.?pp' --include='*.h' --include='*.in' "$1" |
    sed -E 's/:[[:space:]]*#[[:space:]]*include[[:space:]]*["<]([^">]*)[">].*/:\1/'
}

check_arrows() {
  local folder others
  for folder in "${!allowed[@]}"; do
    [ -d "$folder" ] || continue
    # What is named here may not be included; a header beside the file or of a library matches none of these.
    others=$(printf '%s\n' "${!allowed[@]}" apps tests | grep -vxE "$(tr ' ' '|' <<<"$folder ${allowed[$folder]}")" |
      paste -sd'|')
    includes "$folder" | grep -E ":(\.\./.*|($others)/.*)$" | sed "s|$| may not be included in $folder/|" || true
  done
  # An obstacle is a library of its own.
  for folder in obstacles/*/; do
    [ -d "$folder" ] || continue
    includes "$folder" | grep ':obstacles/' | grep -v ":$folder" | sed 's|$| belongs to another obstacle|' || true
  done
}

check_gpl() {
  local header
  while IFS=: read -r file line header; do
    case "$header:$file" in
      CGAL/*:core/geometry/cgal/*) ;;
      CGAL/*) echo "$file:$line:$header (GPL) belongs in core/geometry/cgal/ only" ;;
      *cholmod*:tests/* | *umfpack*:tests/* | Eigen/CholmodSupport:tests/* | Eigen/UmfPackSupport:tests/*) ;;
      Eigen/CholmodSupport:apps/bench/peers/*) ;; # a benchmark of its own that is not installed
      *cholmod*:amg/* | *umfpack*:amg/* | Eigen/CholmodSupport:amg/* | Eigen/UmfPackSupport:amg/*) ;;
      *cholmod*:* | *umfpack*:* | Eigen/CholmodSupport:* | Eigen/UmfPackSupport:*)
        echo "$file:$line:$header (GPL) belongs in amg/ only"
        ;;
    esac
  done < <(for folder in "${!allowed[@]}" apps tests; do [ ! -d "$folder" ] || includes "$folder"; done)
}

check_paths() {
  grep -rnIE '(^|[^A-Za-z0-9_.~-])/(home|root|work|Users)/' . --exclude-dir=.git --exclude=.git --exclude-dir='build*' --exclude-dir=out |
    sed 's/$/ (a path of one machine)/' || true
}

violations() (
  cd "$1"
  { check_arrows; check_gpl; check_paths; } | sort
)

check() {
  local found
  found=$(violations "$1")
  [ -z "$found" ] && return
  printf '%s\n' "$found"
  return 1
}

# try KIND FILE LINE: a tree whose FILE holds LINE must be found wrong; KIND good: must not.
try() {
  local tree
  tree=$(mktemp -d "$scratch/XXXX")
  mkdir -p "$tree/$(dirname "$2")"
  printf '%s\n' "$3" >"$tree/$2"
  if check "$tree" >/dev/null; then
    [ "$1" = good ] || { echo "missed: '$3' in $2"; failed=1; }
  else
    [ "$1" = wrong ] || { echo "false alarm: '$3' in $2"; failed=1; }
  fi
}

selftest() {
  local folder
  failed=0
  scratch=$(mktemp -d)
  trap 'rm -rf "$scratch"' EXIT
  try good core/a.cpp '#include "core/base/types.hpp"'
  try good amg/a.cpp '#include "transfer/a.hpp"'
  try good driver/a.cpp '#include "amg/a.hpp"'
  try good amg/a.cpp '#include "methods/a.hpp"'
  try wrong methods/a.cpp '#include "amg/a.hpp"'
  try good apps/a.cpp '#include "driver/a.hpp"'
  try good apps/a.cpp '#include "obstacles/contact/a.hpp"'
  try good core/geometry/cgal/a.cpp '#include <CGAL/Mesh_3.h>'
  try good apps/bench/peers/a.cpp '#include <Eigen/CholmodSupport>'
  try good core/a.cpp '// frame/wo''rk/home is no path'
  for folder in transfer smoothers methods amg estimators obstacles driver apps tests; do
    try wrong core/a.cpp "#include \"$folder/a.hpp\""
  done
  for folder in core transfer smoothers methods amg estimators driver; do
    try wrong "$folder/a.hpp" '  #  include "obstacles/contact/a.hpp"'
  done
  try wrong amg/a.cpp '#include "driver/a.hpp"'
  try wrong driver/a.cpp '#include "apps/signorini/a.hpp"'
  try wrong transfer/a.cpp '#include <smoothers/a.hpp>'
  try wrong smoothers/a.cpp '#include "transfer/a.hpp"'
  try wrong smoothers/a.cpp '#include "../transfer/a.hpp"'
  try wrong obstacles/contact/a.cpp '#include "obstacles/scalar/a.hpp"'
  try wrong core/a.cpp '#include <CGAL/Mesh_3.h>'
  try wrong apps/a.cpp '#include <cholmod.h>'
  try wrong docs/a.md "see /""home/somebody/notes"
  return "$failed"
}

"$1" "$2"
