#!/usr/bin/env bash
# Manual pages, and completions for bash, zsh and fish, made of what the program tells of its commands and options.
#   bash cmake/packaging/pages.sh QUORUM FOLDER VERSION
# FOLDER/man1 takes quorum.1 and a page for each command, FOLDER/completions the others.
set -euo pipefail
program="$1" folder="$2" version="$3"
mkdir -p "$folder/man1" "$folder/completions"
commands="$("$program" --describe)"
tab=$'\t'

# Text as troff has it: - that may be typed, \ and lines that begin with a dot or a quote.
escape='function escape(text) {
  gsub(/\\/, "\\e", text); gsub(/-/, "\\-", text); gsub(/\n/, "\n.br\n", text)
  if (text ~ /^[.\x27]/) text = "\\&" text
  return text
}'

heading() { printf '.TH %s 1 "" "Quorum %s" "User Commands"\n' "${1^^}" "$version"; }

command_page() {
  "$program" "$1" --describe | awk -F '\t' -v summary="$2" "$escape"'
    NR == 1 {
      name = $1; description = $4
      print ".SH NAME\nquorum\\-" escape(name) " \\- " escape(summary)
      next
    }
    $3 == "Positionals" { words = words " " $1; positionals = positionals ".TP\n.I " escape($1) "\n" escape($4) "\n"; next }
    {
      if ($3 != group) { options = options ".SS " escape($3) "\n"; group = $3 }
      names = $1; gsub(/,/, ", ", names)
      options = options ".TP\n.B " escape(names) ($2 == "-" ? "" : " \\fI" escape($2) "\\fR") "\n" escape($4) "\n"
    }
    END {
      print ".SH SYNOPSIS\n.B quorum " escape(name) "\n" escape(substr(words, 2)) " [options]"
      print ".SH DESCRIPTION\n" escape(description)
      if (positionals) printf ".SH ARGUMENTS\n%s", positionals
      printf ".SH OPTIONS\n%s", options
      print ".SH SEE ALSO\n.BR quorum (1)"
    }'
}

main_page() {
  printf '.SH NAME\nquorum \\- multi\\-view stereo with one result on every device\n'
  printf '.SH SYNOPSIS\n.B quorum\nCOMMAND [options]\n.SH COMMANDS\n'
  awk -F '\t' "$escape"'{ print ".TP\n.BR quorum\\-" escape($1) " (1)\n" escape($2) }' <<<"$commands"
  printf '.SH EXIT STATUS\n'
  printf '.TP\n%s\n%s\n' 0 'All went well.' 1 'A device or the system failed.' 2 'An option or an argument is wrong.' \
    3 "A file is bad, or can't be written." 4 'There is no such device.' 5 'Out of memory, or a budget that is too small.' \
    '130, 143' 'Stopped by a signal; the same command goes on from there.'
  printf '.SH EXAMPLE\n.EX\nquorum synthesize scene\nquorum reconstruct scene \\-o result\n.EE\n'
}

bash_completion() {
  printf '# Made by cmake/packaging/pages.sh.\n_quorum() {\n  local word="${COMP_WORDS[COMP_CWORD]}" options=\n'
  printf '  COMPREPLY=()\n  if [[ $COMP_CWORD -eq 1 ]]; then\n    mapfile -t COMPREPLY < <(compgen -W "%s help --version --help" -- "$word")\n    return\n  fi\n' \
    "$(cut -f 1 <<<"$commands" | tr '\n' ' ' | sed 's/ $//')"
  printf '  case "${COMP_WORDS[1]}" in\n'
  while IFS="$tab" read -r name _; do
    printf '    %s) options="%s" ;;\n' "$name" "$(long_options "$name" | cut -f 1 | tr '\n' ' ' | sed 's/ $//')"
  done <<<"$commands"
  printf '  esac\n  [[ "$word" != -* ]] || mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")\n}\n'
  printf 'complete -o default -F _quorum quorum\n'
}

# Of a command: --name, what it takes, its help.
long_options() {
  "$program" "$1" --describe | awk -F '\t' 'NR > 1 && match($1, /--[a-z0-9-]+/) {
    print substr($1, RSTART, RLENGTH) "\t" $2 "\t" $4 }'
}

zsh_completion() {
  printf '#compdef quorum\n# Made by cmake/packaging/pages.sh.\nlocal -a commands options\ncommands=(\n'
  quoted="s/'/'\\\\''/g"
  sed -e "$quoted" -e "s/:/\\\\:/g" -e "s/\t/:/; s/.*/  '&'/" <<<"$commands"
  printf ')\nif (( CURRENT == 2 )); then\n  _describe command commands\n  return\nfi\ncase "$words[2]" in\n'
  while IFS="$tab" read -r name _; do
    printf '  %s) options=(\n' "$name"
    long_options "$name" | awk -F '\t' -v quote="'" '{
      gsub(/\[|\]|:|\\/, "\\\\&", $3); gsub(quote, quote "\\" quote quote, $3)
      print "    " quote $1 "[" $3 "]" ($2 == "-" ? "" : ":value:_files") quote }'
    printf '  ) ;;\n'
  done <<<"$commands"
  printf "esac\n_arguments -S '1:command:' \$options '*:file:_files'\n"
}

fish_completion() {
  printf '# Made by cmake/packaging/pages.sh.\n'
  while IFS="$tab" read -r name summary; do
    summary="${summary//\'/\\\'}"
    printf "complete -c quorum -n __fish_use_subcommand -a %s -d '%s'\n" "$name" "$summary"
    long_options "$name" | awk -F '\t' -v quote="'" -v name="$name" '{
      gsub(quote, "\\" quote, $3); sub(/^--/, "", $1)
      print "complete -c quorum -n " quote "__fish_seen_subcommand_from " name quote " -l " $1 ($2 == "-" ? "" : " -r") \
        " -d " quote $3 quote }'
  done <<<"$commands"
}

while IFS="$tab" read -r name summary; do
  { heading "quorum-$name" && command_page "$name" "$summary"; } >"$folder/man1/quorum-$name.1"
done <<<"$commands"
{ heading quorum && main_page; } >"$folder/man1/quorum.1"
bash_completion >"$folder/completions/quorum.bash"
zsh_completion >"$folder/completions/_quorum"
fish_completion >"$folder/completions/quorum.fish"
gzip -9nkf "$folder"/man1/*.1
