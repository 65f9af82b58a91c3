#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# use_packages.sh FOLDER [ROOT]: uses installed packages as their users do. FOLDER has courtyard.glb and light.c,
# and gets the results. ROOT is where the packages were installed; without it, this system.
set -eu
cd "$1"
root=${2:-}
if [ -n "$root" ]; then
    export PATH="$root/usr/bin:$PATH" PKG_CONFIG_PATH="$root/usr/lib/pkgconfig" LD_LIBRARY_PATH="$root/usr/lib"
    export PYTHONPATH="$root/usr/lib/python3/dist-packages"
fi

[ "$(command -v tetralight)" = "$root/usr/bin/tetralight" ]
tetralight --version >version
tetralight bake courtyard.glb --samples 16 --quiet -o court.probes
tetralight validate court.probes --quiet
echo 0 1.5 0 | tetralight query court.probes --json >answer.json
tetralight grid courtyard.glb --spacing 4 --quiet -o grid.json
for backend in tetralight cgal tetgen; do
    tetralight tetrahedralize grid.json --backend $backend --quiet -o $backend.probes
    tetralight info $backend.probes --json >$backend.json
done

cc -std=c99 -pedantic -Wall -Werror light.c -o light $(pkg-config --cflags --libs tetralight)
./light court.probes 0 1.5 0 >light.txt

if [ -e "$root/usr/lib/python3/dist-packages/tetralight" ]; then
    # Debian's Python, which has Debian's NumPy.
    PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 -c '
import tetralight
light = tetralight.open("court.probes").irradiance([[0, 1.5, 0]], (0, 1, 0))
print(float(light[0][0]))' >python.txt
fi

for page in tetralight tetralight-bake tetralight-serve tetralight-cgal tetralight-tetgen; do
    gzip -t "$root/usr/share/man/man1/$page.1.gz"
done
bash -n "$root/usr/share/bash-completion/completions/tetralight"
test -s "$root/usr/share/zsh/vendor-completions/_tetralight"

# The service finds the page that is installed.
tetralight serve --data data --listen 127.0.0.1:0 --log info 2>serve.log &
server=$!
for _ in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
    grep -q '"serving"' serve.log && break
    sleep 0.5
done
kill $server
wait $server
