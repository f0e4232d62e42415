#!/usr/bin/env bash
# Guards what the compiler cannot: which folder may include which (the table in docs/architecture.md), who may include
# libraries under the GPL, and that no path of somebody's machine is in a file.
#   arrows.sh check ROOT      lists the violations under ROOT, fails if there are any
#   arrows.sh selftest ROOT   the check accepts a good tree and catches every kind of violation
set -euo pipefail

# "FOLDER: FOLDER..." for each row of the table "Folders and arrows" on a page: who may include whom.
table() {
  awk -F'|' '/^## / { on = $0 == "## Folders and arrows" }
    on && /^\| `/ {
      gsub(/[`,]/, " ", $2); gsub(/\/NAME|\/ /, " ", $2); gsub(/[`,]/, " ", $(NF - 1))
      rows = split($2, row, " "); others = split($(NF - 1), other, " ")
      for (i = 1; i <= rows; ++i) {
        printf "%s:", row[i]
        for (k = 1; k <= others; ++k) printf " %s%s", row[i] ~ /^core\// ? "core/" : "", other[k]
        print ""
      }
    }' "$1"
}

# "FILE:LINE:HEADER" of every #include below a folder.
includes() {
  grep -rnE '^[[:space:]]*#[[:space:]]*include[[:space:]]*["<]' --include='*.?pp' --include='*.h' --include='*.in' "$1" |
    sed -E 's/:[[:space:]]*#[[:space:]]*include[[:space:]]*["<]([^">]*)[">].*/:\1/'
}

all_includes() {
  local folder
  for folder in */; do
    case "$folder" in
      build*/ | out/) ;;
      *) includes "${folder%/}" || true ;;
    esac
  done
}

# compare TABLE INCLUDES [whole]: the includes that no row allows; where these are all of a project, also the arrows
# from folders of core and amg that no file has, and the cycles among them. From elsewhere a folder with all below it may
# be named as one: "core", "amg".
compare() {
  awk -F: -v whole="${3:-}" '
    # The row that a path belongs to: that of its innermost folder.
    function owner(path) {
      while (!(path in row) && sub(/\/[^\/]*$/, "", path)) {}
      return path in row ? path : ""
    }
    function allows(from, to) {
      return from == to || (from, to) in arrow || (from, "everything") in arrow || (from, top_of(to)) in arrow
    }
    function top_of(path) { sub(/\/.*/, "", path); return path }
    function inner(folder) { return folder ~ /^(core|amg|driver)\// || folder == "amg" }
    FNR == NR {
      row[$1]
      count = split($2, other, " ")
      for (i = 1; i <= count; ++i) arrow[$1, other[i]]
      next
    }
    {
      from = owner($1); to = owner($3); top = top_of($3)
      used[from, to]; used[from, top]
      if ($3 ~ /^\.\.\//) print $0 " leaves its folder"
      else if (from == "") print $0 " is in a folder without a row in docs/architecture.md"
      else if (to == "" && top == "core") print $0 " has no row in docs/architecture.md"
      else if (to != "" && !allows(from, to)) print $0 " may not be included in " from "/"
    }
    END {
      if (!whole) exit
      for (pair in arrow) {
        split(pair, end, SUBSEP)
        if (!inner(end[1])) continue
        if (!(pair in used)) print "docs/architecture.md: " end[1] " includes nothing of " end[2]
        reach[pair]
      }
      for (via in row) for (from in row) for (to in row)
        if ((from, via) in reach && (via, to) in reach) reach[from, to]
      for (folder in row)
        if ((folder, folder) in reach) print "docs/architecture.md: " folder " includes itself through others"
    }' "$1" "$2"
}

# check_arrows [whole]
check_arrows() {
  local folder
  compare "$arrows" <(all_includes) "$@"
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
  done < <(all_includes)
}

check_paths() {
  grep -rnIE '(^|[^A-Za-z0-9_.~-])/(home|root|work|Users)/' . --exclude-dir=.git --exclude=.git --exclude-dir='build*' --exclude-dir=out |
    sed 's/$/ (a path of one machine)/' || true
}

violations() (
  cd "$1"
  { check_arrows "${@:2}"; check_gpl; check_paths; } | sort
)

# check ROOT [whole]
check() {
  local found
  found=$(violations "$@")
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

# try_table KIND ROWS FILE LINE: includes against a table that is to have just these arrows.
try_table() {
  local tree found
  tree=$(mktemp -d "$scratch/XXXX")
  # shellcheck disable=SC2016
  { printf '## Folders and arrows\n'; printf '%s\n' "$2"; printf '## Another table\n| `core/z` | | a |\n'; } >"$tree/page"
  table "$tree/page" >"$tree/arrows"
  printf '%s:1:%s\n' "${@:3}" >"$tree/includes"
  found=$(compare "$tree/arrows" "$tree/includes" whole)
  if [ -z "$found" ]; then
    [ "$1" = good ] || { echo "missed: $2"; failed=1; }
  else
    [ "$1" = wrong ] || { echo "false alarm: $2: $found"; failed=1; }
  fi
}

selftest() {
  local folder
  failed=0
  try good core/fem/model/a.cpp '#include "core/base/types.hpp"'
  try good core/geometry/cgal/a.cpp '#include "core/geometry/a.hpp"'
  try good transfer/a.cpp '#include "core/fem/model/a.hpp"'
  try good amg/a.cpp '#include "transfer/a.hpp"'
  try good amg/a.cpp '#include "amg/linear/a.hpp"'
  try good amg/black_box/a.cpp '#include "amg/coarsening/a.hpp"'
  try good driver/a.cpp '#include "amg/black_box/a.hpp"'
  try good c/a.cpp '#include "amg/a.hpp"'
  try good driver/a.cpp '#include "amg/a.hpp"'
  try good apps/a.cpp '#include "driver/a.hpp"'
  try good apps/a.cpp '#include "obstacles/contact/a.hpp"'
  try good core/geometry/cgal/a.cpp '#include <CGAL/Mesh_3.h>'
  try good apps/bench/peers/a.cpp '#include <Eigen/CholmodSupport>'
  try good core/fem/model/a.cpp '// frame/wo''rk/home is no path'
  for folder in transfer smoothers amg c estimators obstacles driver apps tests; do
    try wrong core/base/a.cpp "#include \"$folder/a.hpp\""
  done
  for folder in core transfer smoothers amg estimators driver; do
    try wrong "$folder/a.hpp" '  #  include "obstacles/contact/a.hpp"'
  done
  try wrong core/base/a.cpp '#include "core/fem/model/a.hpp"'
  try wrong core/algebra/a.hpp '#include "core/solver/a.hpp"'
  try wrong core/geometry/cgal/a.cpp '#include "core/fem/model/a.hpp"'
  try wrong core/elsewhere/a.cpp '#include <vector>'
  try wrong elsewhere/a.cpp '#include <vector>'
  try wrong amg/a.cpp '#include "core/elsewhere/a.hpp"'
  try wrong amg/a.cpp '#include "driver/a.hpp"'
  try wrong amg/coarsening/a.cpp '#include "amg/linear/a.hpp"'
  try wrong amg/linear/a.cpp '#include "amg/a.hpp"'
  try wrong amg/coarse/a.cpp '#include "amg/black_box/a.hpp"'
  try wrong amg/a.cpp '#include "c/a.h"'
  try wrong driver/a.cpp '#include "apps/signorini/a.hpp"'
  try wrong transfer/a.cpp '#include <smoothers/a.hpp>'
  try wrong smoothers/a.cpp '#include "transfer/a.hpp"'
  try wrong smoothers/a.cpp '#include "../transfer/a.hpp"'
  try wrong obstacles/contact/a.cpp '#include "obstacles/scalar/a.hpp"'
  try wrong core/fem/model/a.cpp '#include <CGAL/Mesh_3.h>'
  try wrong apps/a.cpp '#include <cholmod.h>'
  try wrong docs/a.md "see /""home/somebody/notes"
  # shellcheck disable=SC2016
  local a='| `core/a` | words | |' b='| `core/b`, `c/` | words | a |' both='| `core/a` | words | b |'
  try_table good "$a"$'\n'"$b" core/b/f.hpp core/a/g.hpp
  try_table wrong "$a" core/a/f.hpp core/b/g.hpp
  try_table wrong "$a"$'\n'"$b" core/b/f.hpp core/b/g.hpp
  try_table wrong "$both"$'\n'"$b" core/b/f.hpp core/a/g.hpp core/a/f.hpp core/b/g.hpp
  # shellcheck disable=SC2016  # Markdown's backticks, not commands
  local c='| `amg/c` | words | amg/d |' d='| `amg/d` | words | amg/c |'
  # shellcheck disable=SC2016
  try_table good "$c"$'\n''| `amg/d` | words | |' amg/c/f.hpp amg/d/g.hpp
  try_table wrong "$c"$'\n'"$d" amg/c/f.hpp amg/d/g.hpp amg/d/f.hpp amg/c/g.hpp
  return "$failed"
}

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
arrows=$scratch/arrows
table "$2/docs/architecture.md" >"$arrows"
"$1" "$2" whole
