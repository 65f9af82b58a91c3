#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Runs the tests of packages/js. Ends with 77 where something is missing.
set -eu

command -v npm >/dev/null || { echo "skipped: there is no npm"; exit 77; }
[ -x node_modules/.bin/vitest ] || { echo "skipped: packages/js/node_modules is missing (./run test)"; exit 77; }
exec npm test --silent
