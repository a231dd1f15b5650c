#!/bin/sh
# Records outages.capsule anew: the rig's server with its faults, a daemon killed in the middle,
# resumed, paused and resumed by an operator. About a minute. Run from the source tree:
#   tests/recordings/remake.sh build/release
set -eu
programs=$(cd "$1" && pwd)
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
mkdir -p /tmp/gyrocal-outages
"$programs/gyrocal" rig serve --campaign "$here/outages.toml" --fault "$here/outages_faults.toml" --seed 3 > "$work/rig" &
rig=$!
trap 'kill $rig; rm -rf "$work"' EXIT
until grep -q ready "$work/rig"; do sleep 0.1; done
"$programs/gyrocald" "$here/outages.toml" --db "$work/outages.db" &
daemon=$!
sleep 8
kill -9 $daemon
wait $daemon || true
"$programs/gyrocald" "$here/outages.toml" --db "$work/outages.db" &
daemon=$!
sleep 4
"$programs/gyrocal" pause outages
sleep 1
"$programs/gyrocal" resume outages
wait $daemon
rm -f "$here/outages.capsule"
"$programs/gyrocal" capsule "$work/outages.db" --out "$here/outages.capsule"
