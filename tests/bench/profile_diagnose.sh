#!/bin/bash
# profile_diagnose.sh PROGRAMS: where `gyrocal diagnose` spends its time, over ten sessions of the
# short set. PROGRAMS is the folder of gyrocal and gyrocal_hidden_sessions; perf comes with Debian's
# linux-perf.
set -euo pipefail
command -v perf >/dev/null || { echo "perf: not installed; apt-get install linux-perf" >&2; exit 3; }
programs=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$programs/gyrocal_hidden_sessions" --out "$folder" --set short --seed 1 --jobs 2 2>/dev/null
for session in "$folder"/sessions/*[05]; do
  perf record -q -F 1000 -o "$folder/$(basename "$session").perf" \
    "$programs/gyrocal" diagnose --session "$session" --json >/dev/null
done
for recorded in "$folder"/*.perf; do
  perf report -i "$recorded" --sort sym --stdio -w 0 2>/dev/null | grep -E '^ +[0-9]'
done | awk '{
  share = $1; sub(/%/, "", share)
  name = $0; sub(/^[^\]]*\] /, "", name); sub(/[(<].*/, "", name); sub(/ +$/, "", name)
  if (name ~ /^Eigen/) name = "Eigen"
  if ($2 == "[k]") name = "kernel"
  sum[name] += share; all += share
} END { for (name in sum) printf "%5.1f %%  %s\n", 100 * sum[name] / all, name }' | sort -rn | head -16
