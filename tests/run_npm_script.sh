#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# run_npm_script.sh FOLDER SCRIPT [FILES]: a test of FOLDER/package.json. Ends with 77 where something is missing.
set -eu
folder=$1 script=$2
shift 2
cd "$(dirname "$0")/../$folder"

skip() {
    echo "skipped: $*"
    exit 77
}

command -v npm >/dev/null || skip "there is no npm"
[ -x node_modules/.bin/vitest ] || skip "$folder/node_modules is missing (./run test)"
if [ "$script" = test:browser ]; then
    command -v "${CHROMIUM:-/usr/bin/chromium}" >/dev/null || skip "there is no Chromium"
    [ "$folder" != viewer ] || [ -e ../build/viewer/index.html ] || skip "build/viewer is missing (./run build viewer)"
fi
exec npm run "$script" --silent -- "$@"
