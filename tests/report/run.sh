#!/bin/sh
# run.sh BUILD [FOLDER]: the tests of the report's page in headless Chromium, on reports that the dynid of a build
# folder makes.
# Where chromium, node or npm are absent it says so and ends with 77; with REPORT_TESTS=required that is a failure.
# SCREENSHOTS=docs/howto/report makes the pictures of the docs anew.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
dynid=${DYNID:-$(realpath "$1")/runtime/dynid}
record=${RECORD:-$(realpath "$1")/tests/report/report_record}
folder=$(realpath -m "${2:-build/report_tests}")

absent() {
  echo "tests/report: left out: $1"
  [ "${REPORT_TESTS:-}" != required ] || exit 1
  exit 77
}
CHROMIUM=${CHROMIUM:-$(command -v chromium || command -v chromium-browser || true)}
[ -n "$CHROMIUM" ] || absent "chromium is not installed (Debian: chromium)"
command -v node >/dev/null || absent "node is not installed (Debian: nodejs)"
command -v npm >/dev/null || absent "npm is not installed (Debian: npm)"
command -v gnuplot >/dev/null || absent "gnuplot is not installed (Debian: gnuplot-nox)"

mkdir -p "$folder/modules"
cp "$here"/package.json "$here"/package-lock.json "$here"/.npmrc "$here"/*.mjs "$folder/modules"
if ! cmp -s "$here/package-lock.json" "$folder/modules/node_modules/.installed"; then
  npm ci --ignore-scripts --no-audit --no-fund --prefix "$folder/modules" >"$folder/npm.log" 2>&1 || {
    cat "$folder/npm.log" >&2
    absent "npm could not fetch the packages of tests/report"
  }
  cp "$here/package-lock.json" "$folder/modules/node_modules/.installed"
fi
cd "$folder/modules"
[ -z "${SCREENSHOTS:-}" ] || SCREENSHOTS=$(realpath -m "$here/../../$SCREENSHOTS")
export DYNGEN_SOURCES="$here/../.." CHROMIUM SCREENSHOTS="${SCREENSHOTS:-}" DYNID="$dynid" RECORD="$record" REPORT_FOLDER="$folder/reports"
# one after the other: times are measured
node --test --test-reporter=spec report.test.mjs
exec node --test --test-reporter=spec pages.test.mjs
