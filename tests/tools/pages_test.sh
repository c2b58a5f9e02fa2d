#!/usr/bin/env bash
# Manual pages and completions name every command and every option that the program's help names.
#   bash tests/tools/pages_test.sh QUORUM FOLDER
set -uo pipefail
program="$1" folder="$2" failed=0
wrong() { echo "$1" && failed=1; }

# What bash completes of words; the last one is not finished.
complete_words() {
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
  _quorum
  printf '%s\n' "${COMPREPLY[@]}"
}
source "$folder/completions/quorum.bash"

options() { grep -oE -- '--[a-z][a-z0-9-]*' | sort -u; }
# Of a command: the options that its help names, and those of its page and of the completions.
told_by_help() { "$program" "$1" --help | grep -oE '^ +(-[a-z],)?--[a-z][a-z0-9-]*' | options; }
told_by_page() { sed 's/\\-/-/g' "$folder/man1/quorum-$1.1" | options; }
told_by_bash() { complete_words quorum "$1" -- | options; }
told_by_zsh() { sed -nE "/^  $1\) options/,/^  \) ;;/s/^    '(--[a-z0-9-]+)\[.*/\1/p" "$folder/completions/_quorum" | options; }
told_by_fish() { sed -nE "s/.*_from $1' -l ([a-z0-9-]+) .*/--\1/p" "$folder/completions/quorum.fish" | options; }

mapfile -t commands < <("$program" --help | sed -nE 's/^  ([a-z]+)  .*/\1/p')
[[ ${#commands[@]} -gt 15 ]] || wrong "${#commands[@]} commands"
words=" $(complete_words quorum "" | tr '\n' ' ')"
for command in "${commands[@]}"; do
  grep -qF "quorum\\-$command" "$folder/man1/quorum.1" || wrong "quorum.1 does not name $command"
  [[ "$words" == *" $command "* ]] || wrong "bash does not complete $command"
  help="$(told_by_help "$command")"
  [[ -n "$help" ]] || wrong "$command has no option"
  for where in page bash zsh fish; do
    missing="$(comm -23 <(echo "$help") <("told_by_$where" "$command"))"
    [[ -z "$missing" ]] || wrong "$where does not name of $command: ${missing//$'\n'/ }"
  done
done
[[ "$(complete_words quorum rec)" == reconstruct ]] || wrong "bash completes rec to $(complete_words quorum rec)"
[[ "$(complete_words quorum reconstruct --voxel)" == --voxel-size ]] || wrong "bash does not complete --voxel"
if command -v zsh >/dev/null; then zsh -n "$folder/completions/_quorum" || wrong "zsh does not read its completion"; fi
if command -v fish >/dev/null; then fish -n "$folder/completions/quorum.fish" || wrong "fish does not read its own"; fi
if command -v groff >/dev/null; then
  said="$(groff -k -man -Tutf8 -ww -z "$folder"/man1/*.1 2>&1)"
  [[ -z "$said" ]] || wrong "$said"
fi
exit "$failed"
