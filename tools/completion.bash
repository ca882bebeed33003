# Completion of stickslip in bash.  It knows no command, option, scene, claim or parameter of its own: the program that is being
# typed says them, by help --table, list, list scenes and list --scene-keys.  Run as a command, with the words of a command line as
# arguments, it prints what the last of them may become, a line each: so do completion.zsh and completion.fish ask.

# Fields $4 (from 1) of the rows of help --table whose first two fields are $2 and $3; "*" is any.
_stickslip_rows() {
  "$1" help --table 2>/dev/null | awk -F '\t' -v name="$2" -v what="$3" -v field="$4" '
    (name == "*" || $1 == name) && (what == "*" || $2 == what) { print $field }' | sort
}

# The words that an option takes: its value a|b|c, or the text "VALUE is a, b or c."
_stickslip_choice() {
  _stickslip_rows "$1" "$2" "$3" 3 | grep '|' | tr '|' '\n' | sed 's/:K$/:/' | grep '^[a-z]'
  _stickslip_rows "$1" "$2" "$3" 4 | sed -n 's/^[A-Z]* is \([^.]*\)\..*/\1/p' | sed 's/,\| or / /g' | tr -s ' ' '\n'
}

_stickslip_claims() {
  "$1" list 2>/dev/null | awk '{ print $1 }'
}

_stickslip_scenes() {
  "$1" list scenes 2>/dev/null | awk '{ print $1 }'
}

# Names of parameters, and of other lines of a scene: those before "=" alone for another option than --set.
_stickslip_parameters() {
  "$1" list --scene-keys 2>/dev/null | if [[ $2 == --set ]]; then sed 's/ *[=:].*/=/'; else sed -n 's/ *=.*\[low, high\].*/=/p'; fi
}

_stickslip() {
  local program=${COMP_WORDS[0]/#\~/$HOME} command=${COMP_WORDS[1]} word previous operands words=
  COMPREPLY=()
  word=${COMP_LINE:0:COMP_POINT}
  word=${word##*[[:space:]]}
  previous=${COMP_WORDS[COMP_CWORD - 1]}
  # bash takes the word apart at "=" and ":"; an option with its value behind "=" is the option's value
  if [[ $word == --*=* ]]; then
    previous=${word%%=*}
    word=${word#*=}
  fi
  operands=$(_stickslip_rows "$program" "$command" usage 3)
  if ((COMP_CWORD == 1)); then
    words="$(_stickslip_rows "$program" "*" usage 1) help --help --version"
  elif [[ $command == help ]] && ((COMP_CWORD == 2)); then
    words=$(_stickslip_rows "$program" "*" usage 1)
  elif [[ $previous == --only ]]; then
    local before=
    [[ $word == *,* ]] && before=${word%,*},
    words=$(_stickslip_claims "$program" | sed "s/^/$before/")
  elif [[ $previous == --* && -n $(_stickslip_choice "$program" "$command" "$previous") ]]; then
    words=$(_stickslip_choice "$program" "$command" "$previous")
  elif [[ $(_stickslip_rows "$program" "$command" "$previous" 3) == NAME=* && $word != *=* ]]; then
    words=$(_stickslip_parameters "$program" "$previous")
    compopt -o nospace 2>/dev/null
  elif [[ $word == -* ]]; then
    words=$(_stickslip_rows "$program" "$command" "*" 2 | grep '^--')
  elif [[ $previous == --* && $(_stickslip_rows "$program" "$command" "$previous" 3) == @(FILE|DIR) ||
    $operands == @(FILE...|DIR|A.json B.json) ]]; then
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
    return
  elif [[ $operands == *SCENE* ]]; then
    words=$(_stickslip_scenes "$program")
    mapfile -t COMPREPLY < <(compgen -f -X '!*.scene' -- "$word"; compgen -d -S / -- "$word")
  elif [[ $operands == @(ID|\[ID...\]) ]]; then
    words=$(_stickslip_claims "$program")
  elif [[ $operands =~ ^\[([a-z]+)\]$ ]]; then
    words=${BASH_REMATCH[1]}
  fi
  mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -W "$words" -- "$word")
  # what stands before a ":" is no part of the word that bash replaces
  if [[ $word == *:* && $COMP_WORDBREAKS == *:* ]]; then
    local kept=${word%"${word##*:}"} i
    for i in "${!COMPREPLY[@]}"; do COMPREPLY[i]=${COMPREPLY[i]#"$kept"}; done
  fi
}

if [[ ${BASH_SOURCE[0]} == "$0" ]]; then
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMP_LINE="$*" COMP_WORDBREAKS=
  COMP_POINT=${#COMP_LINE}
  _stickslip
  ((${#COMPREPLY[@]} == 0)) || printf '%s\n' "${COMPREPLY[@]}"
else
  complete -F _stickslip stickslip
fi
