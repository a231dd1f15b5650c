# make demo    a whole campaign on simulated devices, through the real drivers, to a stored model
# make test    every test
# make build   the two programs and their manual
# make bench   timings beside their peers        make judge   diagnose against hidden effects
# make bench-growth   how each cost grows with the work      make bench-profile   diagnose, by perf
# make soak    the long forms: fuzzing, sanitizers, seeds       make install [PREFIX= DESTDIR=]
# make deb     a Debian package, in build/package
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.ONESHELL:
.DEFAULT_GOAL := help

PACKAGES := g++ cmake ninja-build pkg-config sqlite3 catch2 libserialport-dev libmodbus-dev \
  libeigen3-dev libspdlog-dev libfmt-dev libsqlite3-dev libtomlplusplus-dev libcli11-dev \
  nlohmann-json3-dev libexpected-dev libcpp-httplib-dev libsystemd-dev libzstd-dev libgcrypt20-dev \
  gnuplot-nox libjs-dygraphs libmosquitto-dev mosquitto openssl

PREFIX ?= /usr/local
JOBS ?= $(shell nproc)
BUILD := build/release
DEMO := build/demo
CAMPAIGN := config/campaigns/demo.toml

.PHONY: help packages configured build everything demo test bench bench-growth bench-profile judge \
  soak install deb

help:
	@grep -E '^# make' Makefile | cut -c3-

# Installs what is missing and only that.
packages:
	@if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
	  echo "make: gyrocal builds on Debian 12. Elsewhere, install what these Debian packages hold" >&2
	  echo "and run 'cmake --preset release && cmake --build --preset release':" >&2
	  echo "  $(PACKAGES)" >&2
	  exit 1
	fi
	missing=()
	for package in $(PACKAGES); do
	  state=$$(dpkg-query -W -f='$${db:Status-Status}' "$$package" 2>/dev/null || true)
	  [ "$$state" = installed ] || missing+=("$$package")
	done
	[ $${#missing[@]} -gt 0 ] || exit 0
	as_root=
	if [ "$$(id -u)" != 0 ]; then
	  command -v sudo >/dev/null || { echo "make: as root, run: apt-get install $${missing[*]}" >&2; exit 1; }
	  as_root=sudo
	fi
	echo "installing $${missing[*]}"
	$$as_root apt-get update -qq
	$$as_root env DEBIAN_FRONTEND=noninteractive \
	  apt-get install -y -qq --no-install-recommends "$${missing[@]}" >/dev/null

configured: packages
	@mkdir -p build
	cmake --preset release >build/configure.log 2>&1 || { cat build/configure.log >&2; exit 1; }

# What is released; tests and benches are built where they are run.
build: configured
	cmake --build --preset release -j $(JOBS) --target gyrocal_release

everything: configured
	cmake --build --preset release -j $(JOBS)

demo: build
	@rm -rf $(DEMO); mkdir -p $(DEMO)
	$(BUILD)/gyrocal rig serve --campaign $(CAMPAIGN) >$(DEMO)/rig.log 2>&1 &
	rig=$$!
	trap 'kill $$rig 2>/dev/null || true; wait $$rig 2>/dev/null || true' EXIT
	for attempt in $$(seq 100); do
	  grep -q ready $(DEMO)/rig.log && break
	  kill -0 $$rig 2>/dev/null || { cat $(DEMO)/rig.log >&2; exit 1; }
	  sleep 0.1
	done
	cat $(DEMO)/rig.log
	$(BUILD)/gyrocal run $(CAMPAIGN) --db $(DEMO)/demo.db
	printf '\n%s holds it all. Three queries to try:\n' $(DEMO)/demo.db
	sed -n '/^## Three to begin/,/^## Where/{/^SELECT/p}' docs/queries.md | while read -r query; do
	  printf '\n  sqlite3 -box %s "%s"\n' $(DEMO)/demo.db "$$query"
	done

test: everything
	@ctest --preset release -j $(JOBS)

bench: everything
	@$(BUILD)/tests/bench/gyrocal_bench

bench-growth: everything
	@$(BUILD)/tests/bench/gyrocal_bench --growth

bench-profile: everything
	@tests/bench/profile_diagnose.sh $(BUILD)

judge: everything
	@rm -rf build/judge; mkdir -p build/judge
	$(BUILD)/gyrocal_hidden_sessions --out build/judge --set full --seed 1
	$(BUILD)/gyrocal_judge --gyrocal $(BUILD)/gyrocal --sessions build/judge --jobs $(JOBS)

# The whole suite under the sanitizers, ten million inputs for every reader of bytes and texts, and
# campaigns with random faults from a seed that differs each time: SEEDS= and FIRST= repeat them.
SEEDS ?= 20000
FIRST ?= $(shell date +%s)000
soak: everything
	@for preset in dev tsan; do
	  cmake --preset $$preset >build/configure-$$preset.log
	  cmake --build --preset $$preset -j $(JOBS)
	  ctest --preset $$preset -j $(JOBS)
	done
	for fuzz in fuzz_board fuzz_modbus fuzz_recording fuzz_campaign_toml fuzz_session_csv; do
	  $(BUILD)/tests/fuzz/$${fuzz}_sanitized 10000000
	done
	$(BUILD)/tests/faults/fault_campaigns $(SEEDS) $(FIRST)
	$(BUILD)/tests/faults/fault_campaigns clean $(SEEDS) $(FIRST)

# The prefix is compiled in: where profiles are looked for, which programs the unit starts.
install: configured
	@cmake --preset release -DCMAKE_INSTALL_PREFIX="$(PREFIX)" >build/configure.log
	cmake --build --preset release -j $(JOBS) --target gyrocal_release
	cmake --install $(BUILD)

# Dated by the last commit, or by SOURCE_DATE_EPOCH, so that a rebuild gives the same file.
SOURCE_DATE_EPOCH ?= $(shell git log -1 --format=%ct 2>/dev/null || stat -c %Y CMakeLists.txt)
export SOURCE_DATE_EPOCH
deb: PACKAGES += dpkg-dev file gzip
deb: packages
	@umask 022  # the package's folders get it
	mkdir -p build
	cmake --preset package >build/configure-package.log
	cmake --build --preset package -j $(JOBS)
	cd build/package && cpack >cpack.log || { cat cpack.log >&2; exit 1; }
	sha256sum *.deb
