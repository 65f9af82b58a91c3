#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Run in a new system that has booted: uses the service of tetralight.service and writes what came of it to /result.
cd /result
server=http://127.0.0.1:8080

try() {
    for _ in $(seq 240); do
        curl -sf "$server$1" >/dev/null && return
        sleep 0.5
    done
    echo "no answer from $1" >failed
}

# post PATH JSON FILE: writes the answer, and its status to statuses.
post() {
    curl -sS --json "$2" -o "$3" -w "$1 %{http_code}\n" "$server$1" >>statuses
}

try /healthz
curl -sS --data-binary @/courtyard.glb -o scene.json -w '/v1/scenes %{http_code}\n' "$server/v1/scenes?name=court" >>statuses
post /v1/bakes '{"scene": "court", "name": "court", "samples": 64}' bake.json
try /v1/volumes/court
post /v1/volumes/court/query '{"positions": [[0, 1.5, 0]]}' answer.json
post /v1/render '{"scene": "court", "volume": "court", "camera": "camera", "width": 64, "height": 36}' picture.png
post /v1/lppv '{"volume": "court", "scene": "court", "object": "beam_long", "density": 2}' beam.vdb
journalctl -u tetralight --no-pager --output=cat >journal
grep -E '^(CapEff|NoNewPrivs|Seccomp):' "/proc/$(systemctl show -p MainPID --value tetralight)/status" >rights
systemctl stop tetralight
systemctl show -p Result -p ExecMainStatus tetralight >ended
touch done
