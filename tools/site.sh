#!/usr/bin/env bash
# The documents as a site that needs no server, build/site/site/index.html, with the pages of the public headers. Takes the
# packages mkdocs and doxygen, which nothing else does. A page without a place in the menu and a link that leads nowhere
# are errors.
#   bash tools/site.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

for program in mkdocs doxygen; do
  command -v "$program" >/dev/null || { echo "site: install $program first: apt-get install mkdocs doxygen" >&2; exit 1; }
done
rm -rf build/site
mkdir -p build/site
cp -r docs build/site/pages
cp cmake/site/mkdocs.yml build/site
# The texts of the top level name what is in docs/ by its folder, and the front page is the README.
for text in README.md CONTRIBUTING.md CHANGELOG.md; do
  sed -E 's#\]\(docs/#](#g; s#src="docs/#src="#g' "$text" >"build/site/pages/$text"
done
mv build/site/pages/README.md build/site/pages/index.md
sed -i -E 's#\]\(\.\./(CHANGELOG|CONTRIBUTING)\.md#](\1.md#g; s#\]\(\.\./README\.md#](index.md#g' build/site/pages/*.md
while IFS= read -r page; do
  grep -qE ": $page\$" cmake/site/mkdocs.yml || { echo "site: docs/$page has no place in cmake/site/mkdocs.yml" >&2; exit 1; }
done < <(cd docs && find . -name '*.md' -not -path './examples/*' | sed 's#^\./##')
doxygen cmake/site/Doxyfile
(cd build/site && mkdocs build --quiet)
echo "build/site/site/index.html"
