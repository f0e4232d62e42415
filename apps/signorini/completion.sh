# shellcheck shell=bash
# Completion of bash for signorini. What may follow is asked of the program itself, `signorini words`.
_signorini() {
  local program=${COMP_WORDS[0]} command=${COMP_WORDS[1]} word=${COMP_WORDS[COMP_CWORD]} words
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    words=$("$program" words 2>/dev/null)
  elif [[ ${COMP_WORDS[COMP_CWORD - 1]} == --set ]]; then
    words=$("$program" words set 2>/dev/null)
    compopt -o nospace 2>/dev/null
  elif [[ $word == -* || $command == list || $command == help ]]; then
    words=$("$program" words "$command" 2>/dev/null)
  else
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -d -- "$word")
    case $command in
      solve | check) mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -X '!*.toml' -- "$word") ;;
      *) mapfile -t COMPREPLY < <(compgen -f -- "$word") ;;
    esac
    return
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}
complete -F _signorini signorini
