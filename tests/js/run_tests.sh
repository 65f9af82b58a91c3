#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# run_tests.sh SCRIPT: a script of packages/js/package.json. Ends with 77 where something is missing.
set -eu
script=$1

skip() {
    echo "skipped: $*"
    exit 77
}

command -v npm >/dev/null || skip "there is no npm"
[ -x node_modules/.bin/vitest ] || skip "packages/js/node_modules is missing (./run test)"
if [ "$script" = test:browser ]; then
    command -v "${CHROMIUM:-/usr/bin/chromium}" >/dev/null || skip "there is no Chromium"
fi
exec npm run "$script" --silent
