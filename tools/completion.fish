# Completion of stickslip in fish, by what completion.bash says.
complete -c stickslip -f -a '(bash @COMPDIR@/stickslip (commandline -opc) (commandline -ct) 2>/dev/null)'
