#!/usr/bin/env bash
# A file of tests by pytest; 77, which ctest takes as skipped, where Python lacks what they take.
#   bash tests/tools/python/run.sh PYTHON FILE
for module in numpy pytest; do
  "$1" -c "import $module" 2>/dev/null && continue
  echo "Skipped: $1 has no $module; install python3-$module"
  exit 77
done
export PYTHONDONTWRITEBYTECODE=1
exec "$1" -m pytest -q -p no:cacheprovider --durations 3 "$2"
