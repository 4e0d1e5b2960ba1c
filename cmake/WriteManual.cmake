# Writes the manual pages and the shells' completions into FOLDER, as PROGRAM prints them, laid out as below share/. Run
# by cmake -P while the program is built.
function(pt_print file)
  cmake_path(GET file PARENT_PATH folder)
  file(MAKE_DIRECTORY ${FOLDER}/${folder})
  execute_process(COMMAND ${PROGRAM} ${ARGN} OUTPUT_FILE ${FOLDER}/${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${FOLDER}) # pages of commands that are no more
pt_print(man/man1/pt.1 man)
# Which commands there are, the first page says.
file(STRINGS ${FOLDER}/man/man1/pt.1 references REGEX "^\\.BR pt")
foreach(reference IN LISTS references)
  string(REGEX REPLACE "^\\.BR pt\\\\-([a-z]+) .*" "\\1" command "${reference}")
  pt_print(man/man1/pt-${command}.1 man ${command})
endforeach()
pt_print(bash-completion/completions/pt completion bash)
pt_print(zsh/site-functions/_pt completion zsh)
pt_print(fish/vendor_completions.d/pt.fish completion fish)
