# completion.zsh PROGRAM: a real zsh takes the completion, and offers what it should.
set -e
folder=$(mktemp -d)
trap 'rm -rf $folder' EXIT
"$1" completion zsh >$folder/_contct
# In a terminal of its own, as a person would: what is offered is seen on the screen.
zmodload zsh/zpty
zpty shell 'zsh -f -i'
zpty -w shell "PS1=; fpath=($folder \$fpath); autoload -U compinit; compinit -u -D; zstyle ':completion:*' list-colors ''"
zpty -w shell "compdef _contct contct; autoload -U _contct; print the-end"
# offered LINE: everything on the screen after LINE and two tabs.
offered() {
  local text=''
  zpty -w -n shell "$1"$'\t\t'
  sleep 1
  while zpty -r -t shell line; do text+=$line; done
  zpty -w -n shell $'\025'
  print -r -- $text
}
sleep 1
while zpty -r -t shell line; do :; done
for line wanted in 'contct expl' 'explain' 'contct run --ker' '--kernels' 'contct run --engine cond' 'condensed'; do
  got=$(offered $line)
  [[ $got == *$wanted* ]] || { print -u2 "for \"$line\": \"$got\"; wanted $wanted"; exit 1; }
done
zpty -d shell
