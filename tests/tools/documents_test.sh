#!/usr/bin/env bash
# Runs the commands of the documents' code blocks on a small scene; a command that fails fails the test.
#   documents_test.sh QUORUM SOURCE_FOLDER WORK_FOLDER
set -uo pipefail
quorum="$1" source="$2" work="$3"
rm -rf "$work"
mkdir -p "$work"
cd "$work" || exit 1

# Not run here: what takes colmap, Slurm, or many minutes. Other tests run these commands in small.
left_out='^(photos|experiment|verify|bench) |^(verify|bench)$|^submit .*(\[options|-o OUT --shards 100 \[)'
# The cases of docs/conformance.md are run by the tests of that name.
documents=("$source/README.md")
for document in "$source"/docs/*.md; do [[ "$document" == */conformance.md ]] || documents+=("$document"); done

prepare() {
  rm -rf OUT scene out MODEL
  cp -r made/scene scene
  cp -r made/out OUT
  cp -r made/model MODEL
}
{
  "$quorum" synthesize made/scene --views 7 --width 96
  "$quorum" reconstruct made/scene -o made/out --device cpu --quiet --min-component 0 --min-confidence 0
  "$quorum" convert made/scene --to colmap -o made/model
} >log 2>&1 || { cat log; exit 1; }

failed=0 count=0
run() {
  count=$((count + 1))
  local code=0
  eval "'$quorum' $1" >log 2>&1 || code=$?
  [[ $code -ne 0 ]] || return
  failed=1
  echo "quorum $1: ended with $code"
  tail -n 3 log
}

for document in "${documents[@]}"; do
  prepare
  while IFS= read -r command; do
    [[ ! "$command" =~ $left_out ]] || continue
    command="$(sed -E 's/\bSCENE\b|\bdragonRing\b/scene/g; s/\bdragonRing0*/temple000/g; s/temple0000*8/temple0003/g' <<<"$command")"
    if [[ "$command" =~ ([a-z-]+(\|[a-z-]+)+) ]]; then  # a choice: all of them
      choice="${BASH_REMATCH[1]}"
      for word in ${choice//|/ }; do rm -rf OUT && run "${command/"$choice"/$word}"; done
    elif [[ "$command" =~ \ 1/7 ]]; then  # all of the shards
      for shard in 1 2 3 4 5 6 7; do run "${command/1\/7/$shard/7}"; done
    else
      run "$command"
    fi
  done < <(awk '/^```/ { inside = !inside; next }
                inside && /^(\$ )?(echo [^;]*; )?quorum / {
                  sub(/^(\$ )?(echo [^;]*; )?quorum +/, ""); sub(/ *#.*/, ""); sub(/ *\| cut.*/, ""); print }' "$document")
done
echo "$count commands"
[[ $count -ge 20 && $failed -eq 0 ]]
