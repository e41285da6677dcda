#!/bin/bash
# The completions in zsh and fish themselves. Needs zsh and fish; $1 is the build folder.
set -euo pipefail
build=$(realpath "$1")
source=$(realpath "$(dirname "$0")/../..")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"$source/packaging/manual/command_pages.py" 1.2.3 "$work" "$build/cli/reach"
export PATH="$build/cli:$PATH" HOME=$work
expect() { [[ $2 == "$3" ]] || { echo "completions: $1 gives '$2' instead of '$3'"; exit 1; }; }
in_fish() { fish --no-config -c "source fish/reach.fish; complete -C '$1'" | cut -f1 | sort | paste -sd' '; }
expect 'fish: reach val' "$(in_fish 'reach val')" validate
expect 'fish: reach run --dev' "$(in_fish 'reach run --dev')" --device
expect 'fish: reach run chain-s' "$(in_fish 'reach run chain-s')" chain-slow
expect 'fish: reach export --format ' "$(in_fish 'reach export --format c')" csv
zsh -f -n zsh/_reach
# What zsh would offer is caught where its completion system takes it.
zsh -f > offered << 'ZSH'
zmodload zsh/zpty
zpty shell zsh -f -i
zpty -w shell "PS1='%% '; fpath=($PWD/zsh \$fpath); autoload -U compinit; compinit -u -d $PWD/dump; zstyle ':completion:*' menu no; unsetopt always_last_prompt"
sleep 3
zpty -w -n shell $'reach vali\t'
sleep 3
zpty -w -n shell $'x run --dev\t'
sleep 2
zpty -r -t shell out; while zpty -r -t shell more; do out+=$more; done
print -r -- $out
ZSH
grep -q 'reach validate' offered || { echo "completions: zsh does not complete reach vali"; cat -v offered; exit 1; }
echo "completions: fish and zsh complete commands, options and names"
