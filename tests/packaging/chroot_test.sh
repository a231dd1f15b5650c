#!/bin/bash
# chroot_test.sh DEB NEWER_DEB CHROOT: the package's life on a clean Debian: installed, used, upgraded,
# removed, purged. Needs root and the network, so `make test` does not run it.
#   debootstrap --variant=minbase --include=systemd bookworm CHROOT
# NEWER_DEB is the same tree with a higher version in CMakeLists.txt.
set -euo pipefail
old=$1 new=$2 root=$3
failed=0
complain() { echo "FAILED: $*" >&2; failed=1; }
inside() { chroot "$root" env LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
files() { inside find / -xdev \( -path /proc -o -path /run -o -path /tmp -o -path /var/cache -o -path /var/log \
  -o -path /var/lib/apt -o -path /var/lib/dpkg \) -prune -o -print | sort; }
version() { inside gyrocal version; }

mountpoint -q "$root/proc" || mount -t proc proc "$root/proc"
trap 'umount "$root/proc"' EXIT
cp "$old" "$root/tmp/old.deb"
cp "$new" "$root/tmp/new.deb"
inside apt-get update -qq
# What the package depends on, first: what it brings itself is then what differs.
depends=$(dpkg-deb -f "$old" Depends | sed 's/([^)]*)//g; s/,/ /g')
# shellcheck disable=SC2086
inside apt-get install -y -qq --no-install-recommends $depends >/dev/null
files >"$root/tmp/before"

echo "== install"
inside apt-get install -y -qq --no-install-recommends /tmp/old.deb >/dev/null 2>&1 || complain install
version
inside sh -c 'cd /tmp && gyrocal run /usr/share/gyrocal/campaigns/demo.toml --virtual --seed 7 \
  --db /tmp/demo.db && gyrocal fit --db /tmp/demo.db --board board0 --axis z' >"$root/tmp/used" 2>&1 ||
  complain "a virtual campaign: $(tail -3 "$root/tmp/used")"
grep -q "recommended" "$root/tmp/used" || complain "no model was recommended"
inside systemd-analyze --man=no verify gyrocald@weekend.service || complain "systemd-analyze verify"
exposure=$(inside systemd-analyze security --offline=yes /usr/lib/systemd/system/gyrocald@.service |
  sed -n 's/.*level for .*: \([0-9.]*\) .*/\1/p')
echo "exposure $exposure, at most 2.0"
awk -v e="$exposure" 'BEGIN { exit !(e != "" && e <= 2.0) }' || complain "exposure $exposure"
inside id gyrocal | grep -q dialout || complain "the user gyrocal is not in dialout"
[ "$(inside stat -c %U:%a /var/lib/gyrocal)" = gyrocal:750 ] || complain "/var/lib/gyrocal"

echo "== upgrade"
echo "# changed by the administrator" >>"$root/etc/gyrocal/weekend.toml"
inside apt-get install -y -qq --no-install-recommends /tmp/new.deb >/dev/null 2>&1 || complain upgrade
version
[ "$(inside dpkg-query -W -f='${Version}' gyrocal)" = "$(dpkg-deb -f "$new" Version)" ] ||
  complain "the new version is not installed"
tail -1 "$root/etc/gyrocal/weekend.toml" | grep -q administrator || complain "the conffile was replaced"

echo "== remove"
inside touch /var/lib/gyrocal/weekend.db
inside apt-get remove -y -qq gyrocal >/dev/null 2>&1 || complain remove
[ ! -e "$root/usr/bin/gyrocal" ] || complain "/usr/bin/gyrocal stays"
[ -e "$root/etc/gyrocal/weekend.toml" ] || complain "a conffile went without a purge"

echo "== purge"
inside apt-get purge -y -qq gyrocal >"$root/tmp/purged" 2>&1 || complain purge
grep "holds measurements" "$root/tmp/purged" || complain "nothing is said of the measurements"
[ -e "$root/var/lib/gyrocal/weekend.db" ] || complain "measurements were deleted"
files >"$root/tmp/after"
# The user stays too: its number must not come back as somebody else's, who would own the data.
inside id gyrocal >/dev/null || complain "the user that owns the measurements is gone"
echo "what stays:"
comm -13 "$root/tmp/before" "$root/tmp/after"
comm -13 "$root/tmp/before" "$root/tmp/after" | grep -v '^/var/lib/gyrocal' && complain "more stays than that"
exit $failed
