# Completes commands and options from the program's help, otherwise file names. For bash, and zsh after bashcompinit.
_pt() {
  local word=${COMP_WORDS[COMP_CWORD]} command= words=
  ((COMP_CWORD > 1)) && command=${COMP_WORDS[1]}
  if [[ ! $command ]]; then
    words=$(pt --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
  elif [[ $word == -* ]]; then
    words=$(pt "$command" --help 2>/dev/null | sed -n 's/^  \(-.,\)\{0,1\}\(--[a-z-]*\).*/\2/p')
  fi
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -o default -F _pt pt
