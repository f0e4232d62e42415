#!/usr/bin/env bash
# Completes words in bash, zsh and fish, as far as these are installed: completion.sh SOURCE PROGRAM
set -euo pipefail
source=$1 program=$2 folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cd "$folder"
touch punch.toml other.txt libsignorini_obstacle_a.so
ln -s "$program" signorini
PATH=$folder:$PATH

complete_bash() {
  bash -c '
    source "$0/apps/signorini/completion.sh"
    COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
    _signorini
    ((${#COMPREPLY[@]} == 0)) || printf "%s\n" "${COMPREPLY[@]}"' "$source" signorini "$@"
}

# The functions of zsh that offer words print them.
complete_zsh() {
  zsh -fc '
    compadd() { while [[ $1 == -S ]]; do shift 2; done; print -l -- ${(PM)2:#$word*}; }
    _files() { local f; for f in ${~2:-*}(N); do [[ $f == $word* ]] && print -- $f; done; true; }
    words=("${@[2,-1]}") CURRENT=$(($# - 1)) word=$words[-1]
    source "$1/apps/signorini/completion.zsh"' zsh "$source" signorini "$@"
}

complete_fish() {
  fish --no-config -c "source $source/apps/signorini/completion.fish; complete -C 'signorini $*'"
}

# expect WORDS OFFERED: of the last word, in each shell
expect() {
  local shell words
  read -ra words <<<"$1"
  for shell in bash zsh fish; do
    command -v "$shell" >/dev/null || continue
    offered=$("complete_$shell" "${words[@]}" | cut -f1 | paste -sd' ')
    [ "$offered" = "$2" ] || { printf '%s: "%s" is completed by "%s", not by "%s"\n' "$shell" "$1" "$offered" "$2" && exit 1; }
  done
}

expect "so" "solve"
expect "solve pu" "punch.toml"
expect "solve punch.toml --q" "--quiet"
expect "solve punch.toml --set solver.tol" "solver.tolerance="
expect "list smoo" "smoothers"
expect "help obstacle.sphere.r" "obstacle.sphere.radius"
expect "plu" "plugin"
expect "plugin ch" "check"
expect "plugin check --js" "--json"
expect "plugin check lib" "libsignorini_obstacle_a.so"
expect "plugin new wall --kind fri" "friction"
