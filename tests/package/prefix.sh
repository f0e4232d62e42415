#!/bin/bash
# The installed package: what each component asks for, the names of its headers, versions that are found, pkg-config.
#   prefix.sh CMAKE BUILD SOURCE SCRATCH COMPILER
set -euo pipefail
cmake=$1 build=$2 source=$3 scratch=$4 compiler=$5
prefix=$scratch/prefix

failed=0
wrong() { echo "$*"; failed=1; }

# configure NAME TEXT [OPTIONS]: a project of this text finds the package.
configure() {
  local folder=$scratch/$1
  mkdir -p "$folder"
  printf 'cmake_minimum_required(VERSION 3.25)\n%s\n' "$2" >"$folder/CMakeLists.txt"
  "$cmake" -S "$folder" -B "$folder/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$compiler" "${@:3}" \
    >"$folder/log" 2>&1
}

rm -rf "$scratch"
mkdir -p "$scratch"
for component in dev sdk c libraries plugins; do
  "$cmake" --install "$build" --prefix "$prefix" --component $component >"$scratch/installed"
done

# One folder of headers, which include each other by the same names; none is of a third party that its component does
# not ask for.
test "$(ls "$prefix/include")" = signorini || wrong "include/ has $(ls "$prefix/include")"
new() { find "$prefix/include/signorini" -path '*/old' -prune -o -type f -print; }
new | xargs grep -n '#include "' && wrong "headers include these by names of the source tree"
new | xargs sed -n 's/.*#include <\(signorini[^>]*\)>.*/\1/p' | sort -u | while read -r header; do
  test -f "$prefix/include/$header" || echo "$header is included and not there"
done >"$scratch/missing"
test -s "$scratch/missing" && wrong "$(cat "$scratch/missing")"
grep -rlE '#include <(fmt|nlohmann)/' "$prefix/include/signorini"/{sdk,base,c,matrix} && wrong "these need fmt or nlohmann_json"

# Each component finds nothing but what it needs: others are as good as not installed.
none=(-DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON -DCMAKE_DISABLE_FIND_PACKAGE_fmt=ON -DCMAKE_DISABLE_FIND_PACKAGE_nlohmann_json=ON)
configure c 'project(c LANGUAGES C)
find_package(signorini REQUIRED COMPONENTS c)
if(TARGET signorini::core OR COMMAND signorini_plugin)
  message(FATAL_ERROR "more than c")
endif()' "${none[@]}" || wrong "component c: $(cat "$scratch/c/log")"
configure sdk 'project(sdk LANGUAGES CXX)
find_package(signorini REQUIRED COMPONENTS sdk)
if(TARGET signorini::core OR TARGET signorini::c OR NOT COMMAND signorini_plugin)
  message(FATAL_ERROR "not just the SDK")
endif()' "${none[@]:1}" || wrong "component sdk: $(cat "$scratch/sdk/log")"
configure matrix 'project(matrix LANGUAGES CXX)
find_package(signorini REQUIRED COMPONENTS matrix)' "${none[2]}" || wrong "component matrix: $(cat "$scratch/matrix/log")"
configure driver 'project(driver LANGUAGES CXX)
find_package(signorini REQUIRED COMPONENTS driver)' "${none[2]}" && wrong "component driver does without nlohmann_json"
configure unknown 'project(unknown LANGUAGES CXX)
find_package(signorini REQUIRED COMPONENTS solver)' && wrong "there is a component solver"
tr -s ' \n' ' ' <"$scratch/unknown/log" | grep -q 'no component solver; there are sdk, c,' || wrong "component solver: $(cat "$scratch/unknown/log")"

# Versions and ranges: this one, and those of the same minor version from a lower patch.
version=$(sed -n 's/^set(PACKAGE_VERSION \(.*\))/\1/p' "$(find "$prefix" -name signoriniConfigVersion.cmake)")
minor=${version%.*}
next=${minor%.*}.$((${minor#*.} + 1))
accepts() { configure "version_$1" "project(version LANGUAGES NONE)
find_package(signorini $1 REQUIRED COMPONENTS c)"; }
for range in "$minor" "$version" "$minor...$next" "0.1...<$next" "$minor...$version"; do
  accepts "$range" || wrong "$version is not found as $range"
done
for range in "$next" "$version.1" "${minor%.*}.$((${minor#*.} - 1))" "$next...9" "0.1...<$minor"; do
  accepts "$range" && wrong "$version is found as $range"
done

# Without components headers have the names that they had before, too.
cat >"$scratch/old.cpp" <<'TEXT'
#include "amg/black_box.hpp"
#include "c/signorini.h"
#include "conformance/check.hpp"
#include "core/sdk/box_obstacle.hpp"
#include "core/sdk/plugin.hpp"
#include "driver/driver.hpp"
TEXT
if ! { configure old 'project(old LANGUAGES CXX)
find_package(signorini REQUIRED)
add_library(old OBJECT ../old.cpp)
target_compile_options(old PRIVATE -fsyntax-only)
target_link_libraries(old PRIVATE signorini::driver signorini::c signorini::conformance)' &&
  "$cmake" --build "$scratch/old/build" >"$scratch/old/log" 2>&1; }; then
  wrong "old names: $(cat "$scratch/old/log")"
fi

# pkg-config: the examples of the pages. Libraries are found where they are, and a plugin needs no more than the SDK.
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name signorini_c.pc)")
export PKG_CONFIG_PATH
folder=$(pkg-config --variable=libdir signorini_sdk)
build_with() { # build_with PACKAGE SOURCE OUTPUT [OPTIONS]
  # shellcheck disable=SC2046
  "$compiler" -O1 $(pkg-config --cflags "$1") "${@:4}" "$source/tests/$2" -o "$scratch/$3" $(pkg-config --libs "$1") \
    -Wl,-rpath,"$folder" || wrong "pkg-config $1"
}
build_with signorini_sdk obstacles/outside/slot.cpp libsignorini_obstacle_slot.so -shared -fPIC -Wl,-z,defs
readelf -d "$scratch/libsignorini_obstacle_slot.so" | sed -n 's/.*NEEDED.*\[\(.*\)\].*/\1/p' >"$scratch/needed"
grep -q '^libsignorini_sdk\.so\.[0-9]*$' "$scratch/needed" || wrong "a plugin needs $(cat "$scratch/needed")"
grep -vE '^lib(signorini_sdk|stdc\+\+|m|c|gcc_s)\.so' "$scratch/needed" && wrong "a plugin needs these"
readelf -d "$folder"/libsignorini_sdk.so | sed -n 's/.*NEEDED.*\[\(.*\)\].*/\1/p' | grep -vE '^lib(stdc\+\+|m|c|gcc_s)\.so' &&
  wrong "the SDK needs these"
build_with signorini_matrix amg/outside/string.cpp string
"$scratch/string" >"$scratch/printed" || wrong "string ends with $?"
build_with signorini_driver driver/outside/press.cpp press
"$scratch/press" >>"$scratch/printed" || wrong "press ends with $?"
test "$(grep -c 'cycles on\|plane at' "$scratch/printed")" = 6 || wrong "$(cat "$scratch/printed")"

# docs/embedding.md: its CMake finds the package, its commands build, and the libraries and headers that it names are
# there.
page=$source/docs/embedding.md
# shellcheck disable=SC2016
shown() { sed -n '/^```'"$1"'/,/^```/{/^```/!p}' "$page"; }  # the lines of the blocks of this kind
mkdir -p "$scratch/page"
cp "$source"/tests/{c/outside/membrane.c,amg/outside/string.cpp,obstacles/outside/slot.cpp} "$scratch/page"
shown sh | grep 'pkg-config' | sed 's/ -O3 / -O1 /' >"$scratch/page/commands"  # what is built is not what is measured
test "$(wc -l <"$scratch/page/commands")" = 3 || wrong "docs/embedding.md has not three commands: $(cat "$scratch/page/commands")"
(cd "$scratch/page" && bash -eu commands) || wrong "docs/embedding.md, Without CMake"
LD_LIBRARY_PATH=$folder "$scratch/page/a.out" >"$scratch/printed" || wrong "the program of docs/embedding.md ends with $?"
shown cpp >"$scratch/page.cpp"
configure page_cmake "project(page_cmake LANGUAGES CXX)
add_library(my_program OBJECT ../page.cpp)
$(shown cmake)" || wrong "docs/embedding.md, find_package: $(cat "$scratch/page_cmake/log")"
"$cmake" --build "$scratch/page_cmake/build" >"$scratch/page_cmake/log" 2>&1 ||
  wrong "docs/embedding.md, #include: $(cat "$scratch/page_cmake/log")"
named() { # named WHAT PATTERN FOLDER: what a row of a table of the page names is in the folder
  sed -n "s/$2/\\1/p" "$page" >"$scratch/named"
  test -s "$scratch/named" || wrong "docs/embedding.md names no $1"
  while read -r name; do
    test -e "$3/$name" || wrong "docs/embedding.md names $name, and there is none"
  done <"$scratch/named"
}
# shellcheck disable=SC2016
named libraries '^| `\(lib[^`]*\.so[^`]*\)` .*' "$folder"
# shellcheck disable=SC2016
named headers '^| `.*`<\(signorini[^>]*\)>`.*' "$prefix/include"
exit "$failed"
