# shellcheck shell=bash
# Completion of bash for signorini. What may follow is asked of the program itself, `signorini words`.
_signorini() {
  local program=${COMP_WORDS[0]} command=${COMP_WORDS[1]} word=${COMP_WORDS[COMP_CWORD]} words
  COMPREPLY=()
  # What is below another command has both words.
  [[ $command == plugin ]] && ((COMP_CWORD > 2)) && command="plugin ${COMP_WORDS[2]}"
  if ((COMP_CWORD == 1)); then
    words=$("$program" words 2>/dev/null)
  elif [[ ${COMP_WORDS[COMP_CWORD - 1]} == --kind ]]; then
    words=$("$program" words "$command --kind" 2>/dev/null)
  elif [[ $command != plugin* && ${COMP_WORDS[COMP_CWORD - 1]} == --set ]]; then
    words=$("$program" words set 2>/dev/null)
    compopt -o nospace 2>/dev/null
  elif [[ $word == -* || $command == list || $command == help || $command == plugin ]]; then
    words=$("$program" words "$command" 2>/dev/null)
  else
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -d -- "$word")
    case $command in
      solve | check) mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -X '!*.toml' -- "$word") ;;
      "plugin check") mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -X '!*.so' -- "$word") ;;
      *) mapfile -t COMPREPLY < <(compgen -f -- "$word") ;;
    esac
    return
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}
complete -F _signorini signorini
