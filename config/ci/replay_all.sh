#!/bin/sh
# replay_all.sh GYROCAL FOLDER OUT: replays every capsule of a folder, a JUnit file each in OUT.
# Exit: 0 all alike, 4 one differs, 1 one could not be replayed or there is none.
set -u
gyrocal=$1 folder=$2 out=$3
mkdir -p "$out" || exit 1
worst=0 seen=0
for capsule in "$folder"/*.capsule; do
  [ -f "$capsule" ] || continue
  seen=$((seen + 1))
  "$gyrocal" replay "$capsule" --junit "$out/$(basename "$capsule" .capsule).xml"
  code=$?
  case $code in
    0) ;;
    4) [ $worst -ne 0 ] || worst=4 ;;
    *) worst=1 ;;
  esac
done
[ $seen -gt 0 ] || { echo "replay_all.sh: no capsule in $folder" >&2; exit 1; }
exit $worst
