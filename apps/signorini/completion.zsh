#compdef signorini
# Completion of zsh for signorini. What may follow is asked of the program itself, `signorini words`.
_signorini() {
  local program=${words[1]} command=${words[2]} before=${words[CURRENT - 1]} word=${words[CURRENT]}
  local -a known
  # What is below another command has both words.
  if [[ $command == plugin ]] && ((CURRENT > 3)); then command="plugin ${words[3]}"; fi
  if ((CURRENT == 2)); then
    known=(${(f)"$($program words 2>/dev/null)"})
  elif [[ $before == --kind ]]; then
    known=(${(f)"$($program words "$command --kind" 2>/dev/null)"})
  elif [[ $before == --set && $command != plugin* ]]; then
    known=(${(f)"$($program words set 2>/dev/null)"})
    compadd -S '' -a known
    return
  elif [[ $word == -* || $command == (list|help|plugin) ]]; then
    known=(${(f)"$($program words $command 2>/dev/null)"})
  else
    case $command in
      solve | check) _files -g '*.toml' ;;
      'plugin check') _files -g '*.so' ;;
      *) _files ;;
    esac
    return
  fi
  compadd -a known
}
_signorini "$@"
