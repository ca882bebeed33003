# Completion of stickslip in bash (not zsh, which has no mapfile).  It knows no command, option, scene or claim of its own: the
# program that is being typed says them, by --help, list and list scenes.

# The part of --help about one command.
_stickslip_block() {
  "$1" --help 2>/dev/null | awk -v name="$2" '
    $1 == "stickslip" { on = $2 == name }
    /^$/ { on = 0 }
    on'
}

# The words of --NAME a|b|c, where the help gives a choice.
_stickslip_choice() {
  _stickslip_block "$1" "$2" | tr -s ' \n[]' '    ' | sed 's/ --/\n--/g' |
    sed -n "s/^$3 \\([a-z][a-zA-Z0-9:-]*|[a-zA-Z0-9:|-]*\\).*/\\1/p" | tr '|' '\n' | sed 's/:K$/:/' | sort -u
}

_stickslip_claims() {
  "$1" list 2>/dev/null | awk '{ print $1 }'
}

_stickslip_scenes() {
  "$1" list scenes 2>/dev/null | awk '{ print $1 }'
}

_stickslip() {
  local program=${COMP_WORDS[0]/#\~/$HOME} command=${COMP_WORDS[1]} word previous words=
  COMPREPLY=()
  word=${COMP_LINE:0:COMP_POINT}
  word=${word##*[[:space:]]}
  previous=${COMP_WORDS[COMP_CWORD - 1]}
  # bash takes the word apart at "=" and ":"; an option with its value behind "=" is the option's value
  if [[ $word == --*=* ]]; then
    previous=${word%%=*}
    word=${word#*=}
  fi
  if ((COMP_CWORD == 1)); then
    words="$("$program" --help 2>/dev/null | awk '$1 == "stickslip" && $2 ~ /^[a-z]+$/ { print $2 }' | sort -u) --help --version"
  elif [[ $previous == --only ]]; then
    local before=
    [[ $word == *,* ]] && before=${word%,*},
    words=$(_stickslip_claims "$program" | sed "s/^/$before/")
  elif [[ $previous == --* && -n $(_stickslip_choice "$program" "$command" "$previous") ]]; then
    words=$(_stickslip_choice "$program" "$command" "$previous")
  elif [[ $word == -* ]]; then
    words="$(_stickslip_block "$program" "$command" | grep -o -e '--[a-z][a-z-]*' | sort -u) --help"
  elif [[ $previous == --@(out|paper|overlay|certificate|peers|inputs|csv) || $command == @(check|diff|report) ]]; then
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
    return
  elif [[ $previous == --job ]]; then
    words=$(_stickslip_block "$program" "$command" | sed -n 's/^ *jobs: \([a-z, ]*\);.*/\1/p' | tr ',' ' ')
  elif _stickslip_block "$program" "$command" | grep -q "^  stickslip $command.* \[*SCENE"; then
    words=$(_stickslip_scenes "$program")
    mapfile -t COMPREPLY < <(compgen -f -X '!*.scene' -- "$word"; compgen -d -S / -- "$word")
  elif _stickslip_block "$program" "$command" | grep -q "^  stickslip $command \[*ID"; then
    words=$(_stickslip_claims "$program")
  else
    words=$(_stickslip_block "$program" "$command" | sed -n "s/^  stickslip $command \[\([a-z]*\)[] ].*/\1/p")
  fi
  mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -W "$words" -- "$word")
  # what stands before a ":" is no part of the word that bash replaces
  if [[ $word == *:* && $COMP_WORDBREAKS == *:* ]]; then
    local kept=${word%"${word##*:}"} i
    for i in "${!COMPREPLY[@]}"; do COMPREPLY[i]=${COMPREPLY[i]#"$kept"}; done
  fi
}

complete -F _stickslip stickslip
