# Writes the manual pages pt.1 and pt-COMMAND.1 into FOLDER: the help that PROGRAM prints, as it is. Run by cmake -P while
# the program is built.
function(pt_write_page name) # [command]
  execute_process(COMMAND ${PROGRAM} ${ARGN} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "^[^\n]*" description "${help}")
  # What troff takes for a command, an escape or a hyphen.
  string(REPLACE "\\" "\\e" help "${help}")
  string(REPLACE "-" "\\-" help "${help}")
  string(REGEX REPLACE "(^|\n)([.'])" "\\1\\\\&\\2" help "${help}")
  string(TOUPPER ${name} title)
  file(WRITE ${FOLDER}/${name}.1 ".TH ${title} 1\n.SH NAME\n${name} \\- ${description}\n.SH DESCRIPTION\n.nf\n${help}.fi\n")
  set(help "${help}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${FOLDER}) # pages of commands that are no more
pt_write_page(pt)
string(REGEX REPLACE ".*\nCommands:\n(.*\n)\n.*" "\\1" commands "${help}")
string(REGEX MATCHALL "(^|\n)  [a-z]+ " commands "\n${commands}")
foreach(command IN LISTS commands)
  string(STRIP "${command}" command)
  pt_write_page(pt-${command} ${command})
endforeach()
