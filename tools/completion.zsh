#compdef stickslip
# Completion of stickslip in zsh, by what completion.bash says.
_stickslip() {
  local -a offered
  offered=(${(f)"$(bash @COMPDIR@/stickslip "${(@)words[1,CURRENT]}" 2>/dev/null)"})
  compadd -S '' -- ${(M)offered:#*[=/:]}
  compadd -- ${offered:#*[=/:]}
}
_stickslip "$@"
