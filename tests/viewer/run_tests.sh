#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# run_tests.sh SCRIPT [FILES]: a script of viewer/package.json. Ends with 77 where something is missing.
set -eu
script=$1
shift

skip() {
    echo "skipped: $*"
    exit 77
}

command -v npm >/dev/null || skip "there is no npm"
[ -x node_modules/.bin/vitest ] || skip "viewer/node_modules is missing (./run build viewer)"
if [ "$script" = test:browser ]; then
    command -v "${CHROMIUM:-/usr/bin/chromium}" >/dev/null || skip "there is no Chromium"
    [ -e ../build/viewer/index.html ] || skip "build/viewer is missing (./run build viewer)"
fi
exec npm run "$script" --silent -- "$@"
