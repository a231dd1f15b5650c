#!/bin/bash
# installation_test.sh CMAKE BUILD: installs into a folder of its own and looks at what is there.
set -euo pipefail
cmake=$1 build=$2
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
DESTDIR="$root" "$cmake" --install "$build" >"$root/install.log"
prefix=$(sed -n 's/^CMAKE_INSTALL_PREFIX:PATH=//p' "$build/CMakeCache.txt")
failed=0
complain() { echo "FAILED: $*" >&2; failed=1; }

for file in "$prefix/bin/gyrocal" "$prefix/bin/gyrocald" \
  "$prefix/lib/systemd/system/gyrocald@.service" "$prefix/lib/sysusers.d/gyrocal.conf" \
  "$prefix/lib/tmpfiles.d/gyrocal.conf" "$prefix/lib/udev/rules.d/70-gyrocal.rules" \
  "$prefix/share/man/man1/gyrocal-rig-serve.1.gz" "$prefix/share/man/man1/gyrocald.1.gz" \
  "$prefix/share/bash-completion/completions/gyrocal" \
  "$prefix/share/doc/gyrocal/copyright" "$prefix/share/doc/gyrocal/changelog.gz" \
  "$prefix/share/gyrocal/chambers/yinhe.toml"; do
  [ -s "$root$file" ] || complain "$file is not installed"
done

for program in gyrocal gyrocald; do
  "$root$prefix/bin/$program" --version | grep -qx "$program [0-9.]*" || complain "$program --version"
done

# Every conffile of the package is installed, where the prefix is the machine's own.
if [ "$prefix" = /usr ] || [ "$prefix" = /usr/local ]; then
  while read -r file; do
    [ -s "$root$file" ] || complain "conffile $file is not installed"
  done <"$(dirname "$0")/../../config/debian/conffiles"
fi

# The changelog tells of the version that is packaged.
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")
zcat "$root$prefix/share/doc/gyrocal/changelog.gz" | head -1 | grep -qF "gyrocal ($version) " ||
  complain "the changelog does not begin with $version"

# The unit names programs below the prefix, which stand below $root for now.
unit="$root/gyrocald@.service"
sed "s|=$prefix/bin/|=$root$prefix/bin/|" "$root$prefix/lib/systemd/system/gyrocald@.service" >"$unit"
if command -v systemd-analyze >/dev/null; then
  systemd-analyze --man=no verify "$unit" || complain "systemd-analyze verify"
  exposure=$(systemd-analyze security --offline=yes "$unit" | sed -n 's/.*level for .*: \([0-9.]*\) .*/\1/p')
  echo "exposure $exposure, at most 2.0"
  awk -v e="$exposure" 'BEGIN { exit !(e != "" && e <= 2.0) }' || complain "exposure $exposure"
fi

for script in postinst prerm postrm; do
  sh -n "$(dirname "$0")/../../config/debian/$script" || complain "$script"
done
bash -n "$root$prefix/share/bash-completion/completions/gyrocal" || complain "bash completion"
exit $failed
