#!/bin/bash
# booted_test.sh DEB NEWER_DEB CHROOT: gyrocald@NAME.service under a running systemd: started, killed,
# hung, upgraded under, stopped, started again, finished, with the simulated rig behind it. Needs root and
# the network, so `make test` does not run it. The systemd is the chroot's own, in its own namespaces.
#   debootstrap --variant=minbase --include=systemd,dbus,curl bookworm CHROOT
# NEWER_DEB may be DEB with another version: dpkg-deb -R, edit, dpkg-deb -b.
set -euo pipefail
old=$1 new=$2 root=$(realpath "$3")
failed=0
complain() { echo "FAILED: $*" >&2; failed=1; }

boot() { # as PID 1 of new namespaces; what it mounts is gone with them
  # shellcheck disable=SC2016
  setsid unshare --mount --pid --fork --cgroup --uts --ipc bash -c '
    root=$1
    mount --make-rprivate /
    mount --bind "$root" "$root"
    mount -t proc proc "$root/proc"
    mount -t sysfs sys "$root/sys"
    mount -t cgroup2 cgroup2 "$root/sys/fs/cgroup"
    for folder in run tmp dev; do mount -t tmpfs tmpfs "$root/$folder"; done
    for device in null zero full random urandom tty; do
      touch "$root/dev/$device"
      mount --bind "/dev/$device" "$root/dev/$device"
    done
    mkdir "$root/dev/pts" "$root/dev/shm"
    mount -t devpts -o newinstance,ptmxmode=666,mode=620,gid=5 devpts "$root/dev/pts"
    ln -s pts/ptmx "$root/dev/ptmx"
    exec chroot "$root" env container=other /lib/systemd/systemd --log-target=journal' \
    boot "$root" </dev/null >"$root/var/log/boot" 2>&1 &
  unshared=$!
  for _ in $(seq 60); do
    pid=$(pgrep -f -n '/lib/systemd/systemd --log-target=journal' || true)
    [ -n "$pid" ] && inside systemctl is-system-running 2>/dev/null | grep -qE 'running|degraded' && return
    sleep 1
  done
  echo "systemd does not come up in $root: $(cat "$root/var/log/boot")" >&2
  exit 1
}
inside() {
  nsenter -t "$pid" -m -p -C -u -i -r -w env PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"
}
unit() { inside systemctl show -P "$1" gyrocald@booted; }
log() { inside journalctl -u gyrocald@booted --no-pager -o cat; }
until_unit_is() { # STATE SECONDS
  for _ in $(seq "$2"); do
    [ "$(unit ActiveState)/$(unit SubState)" = "$1" ] && return
    sleep 1
  done
  complain "not $1 in $2 s but $(unit ActiveState)/$(unit SubState): $(log | tail -5)"
}
made_safe() { log | grep -cE '^chamber .*, confirmed' || true; }

install() {
  cp "$1" "$root/var/tmp/gyrocal.deb"
  inside apt-get install -y -qq --no-install-recommends --reinstall --allow-downgrades /var/tmp/gyrocal.deb
}

cp /etc/resolv.conf "$root/etc/resolv.conf"
boot
trap 'kill -KILL "$pid" 2>/dev/null; wait "$unshared" 2>/dev/null || true' EXIT

echo "== install"
inside apt-get update -qq
install "$old" >/dev/null 2>&1 || complain install
inside systemctl stop gyrocald@booted rig 2>/dev/null || true
rm -rf "$root"/var/lib/gyrocal/booted.*
sed -e 's/^name = "demo"/name = "booted"/; s#/tmp/gyrocal-demo#/run/rig#; s/^port = .*/port = 15021/' \
  "$root/usr/share/gyrocal/campaigns/demo.toml" >"$root/etc/gyrocal/booted.toml"
mkdir -p "$root/etc/systemd/system/gyrocald@booted.service.d"
# The simulated boards are pseudo-terminals; and nobody wants to wait long for a watchdog.
printf '[Service]\nDeviceAllow=char-pts rw\nWatchdogSec=10\nTimeoutAbortSec=5\n' \
  >"$root/etc/systemd/system/gyrocald@booted.service.d/rig.conf"
inside systemctl daemon-reload
inside systemd-run --quiet --unit=rig --uid=gyrocal --property=RuntimeDirectory=rig \
  gyrocal rig serve --campaign /etc/gyrocal/booted.toml
sleep 2

echo "== start"
inside systemctl start gyrocald@booted || complain "start: $(log | tail -5)"
until_unit_is active/running 10 # type notify: READY was said
echo "status text: $(unit StatusText)"
[ -n "$(unit StatusText)" ] || complain "no STATUS"
inside curl -fsS http://127.0.0.1:8470/api/status | grep -c '"campaign"' >/dev/null || complain "the page does not answer"
inside gyrocal status booted || complain "gyrocal status"

echo "== killed"
sleep 10
before=$(made_safe)
inside systemctl kill -s KILL gyrocald@booted
until_unit_is active/running 30
[ "$(unit NRestarts)" = 1 ] || complain "restarts: $(unit NRestarts)"
[ "$(made_safe)" -gt "$before" ] || complain "the kill left the chamber as it was"

echo "== hung"
sleep 5
inside systemctl kill -s STOP --kill-whom=main gyrocald@booted
for _ in $(seq 60); do [ "$(unit NRestarts)" -ge 2 ] && break; sleep 1; done
[ "$(unit NRestarts)" -ge 2 ] || complain "the watchdog did not end a hung daemon"
log | grep -ci watchdog >/dev/null || complain "no word of the watchdog"
until_unit_is active/running 30

echo "== upgraded under"
main=$(unit MainPID)
install "$new" >"$root/var/log/upgrade" 2>&1 || complain upgrade
grep 'still on the old version' "$root/var/log/upgrade" || complain "nothing is said of the running campaign"
[ "$(unit MainPID)" = "$main" ] || complain "the upgrade ended the campaign"

echo "== stopped"
inside systemctl stop gyrocald@booted
echo "result $(unit Result), exit $(unit ExecMainStatus)"
log | tail -4
inside systemctl reset-failed gyrocald@booted 2>/dev/null || true

echo "== started again, finished"
inside systemctl start gyrocald@booted || complain "start: $(log | tail -5)"
until_unit_is inactive/dead 420
echo "result $(unit Result), exit $(unit ExecMainStatus)"
[ "$(unit Result)/$(unit ExecMainStatus)" = success/0 ] || complain "did not finish: $(log | tail -5)"
inside gyrocal db /var/lib/gyrocal/booted.db
[ "$(inside stat -c %U:%a /var/lib/gyrocal/booted.db)" = gyrocal:640 ] || complain "the database's owner or mode"
exit $failed
