# The front door: `make` says what there is. Everything else is CMake (CMakePresets.json) and scripts/.
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
MAKEFLAGS += --no-print-directory

JOBS ?= $(shell nproc)
SCENE ?= hexagon_room
IMAGE ?= out/$(notdir $(basename $(SCENE))).png
# The room as it is meant to be looked at: its default of as many shadow rays as samples, the report's, takes a minute.
ROOM_ARGS := --spp 256 -Dshadow_rays=1 --exposure 1.5
ARGS ?= $(if $(filter hexagon_room,$(SCENE)),$(ROOM_ARGS))
RELEASE := build/release

.PHONY: help
help:  ## say what there is
	@echo "usage: make TARGET [JOBS=N]"
	@sed -n 's/^\([a-z][a-z-]*\):.*## \(.*\)/  \1\t\2/p' $(MAKEFILE_LIST) | expand -t 14

.PHONY: render
render: build  ## build Norrsken and render the hexagon room (SCENE=..., IMAGE=..., ARGS="--spp 64")
	@mkdir -p "$(dir $(IMAGE))"
	$(RELEASE)/norrsken render "$(SCENE)" -o "$(IMAGE)" $(ARGS)
	@echo "The picture is $(abspath $(IMAGE))"

.PHONY: build
build:  ## install what is missing and build build/release/norrsken
	@scripts/install_dependencies.sh build
	cmake --preset release
	cmake --build $(RELEASE) --target norrsken_program -j $(JOBS)

# Two tiers. What is the same every time and takes a quarter of an hour at most is `test`; what takes minutes by itself, is
# drawn anew each time, or races with the clock is `thorough`.
.PHONY: test
test: tests  ## warnings as errors, a render, the tests, the checks, a peer's scenes: before every push
	@mkdir -p out
	$(RELEASE)/norrsken render hexagon_room -o out/hexagon_room.png $(ROOM_ARGS)
	ctest --test-dir $(RELEASE) -j $(JOBS) --output-on-failure
	scripts/check_conformance.sh $(RELEASE)/norrsken
	scripts/check_format.sh

.PHONY: thorough
thorough: test  ## `test`, then mutants, calibration, kills, benchmarks, clang-tidy, sanitizers, fuzzing: two hours
	cmake --preset release -DNORRSKEN_THOROUGH_TESTS=ON -DNORRSKEN_BUILD_BENCHMARKS=ON
	cmake --build $(RELEASE) -j $(JOBS)
	ctest --test-dir $(RELEASE) -j $(JOBS) --output-on-failure -L "$$(cat $(RELEASE)/thorough_labels)"
	@$(MAKE) tidy sanitize fuzz-quick

.PHONY: check
check: tests  ## the quick part of `test`: no slow tests
	ctest --test-dir $(RELEASE) -j $(JOBS) --output-on-failure -LE slow
	scripts/check_format.sh

.PHONY: sanitize
sanitize: asan-ubsan tsan  ## the quick tests under the address, undefined-behaviour and thread sanitizers

.PHONY: asan-ubsan tsan
asan-ubsan tsan:
	@scripts/install_dependencies.sh test
	cmake --preset $@ -DNORRSKEN_WARNINGS_AS_ERRORS=ON
	cmake --build build/$@ -j $(JOBS)
	ctest --preset $@ -j $(JOBS)

.PHONY: fuzz fuzz-quick
fuzz:  ## every fuzz target for ten minutes (FUZZ_SECONDS=600)
fuzz-quick:  ## every fuzz target for one minute
fuzz: FUZZ_SECONDS ?= 600
fuzz-quick: FUZZ_SECONDS ?= 60
fuzz fuzz-quick:
	@scripts/install_dependencies.sh test
	cmake --preset fuzz -DNORRSKEN_WARNINGS_AS_ERRORS=ON
	cmake --build --preset fuzz -j $(JOBS)
	scripts/fuzz.sh $(FUZZ_SECONDS) $(JOBS)

.PHONY: tests
tests:
	@scripts/install_dependencies.sh test
	cmake --preset release -DNORRSKEN_WARNINGS_AS_ERRORS=ON -DNORRSKEN_THOROUGH_TESTS=OFF -DNORRSKEN_BUILD_BENCHMARKS=OFF
	cmake --build $(RELEASE) -j $(JOBS)

.PHONY: bench
bench: build  ## measure the hexagon room and every Google Benchmark
	cmake --preset release -DNORRSKEN_BUILD_BENCHMARKS=ON
	cmake --build $(RELEASE) -j $(JOBS)
	$(RELEASE)/norrsken bench hexagon_room -Dshadow_rays=1 -Dbounces=3 --sampler independent
	for program in $(RELEASE)/benchmarks/*_benchmark; do "$$program"; done

.PHONY: format
format:  ## rewrite the sources in the project's format
	@scripts/install_dependencies.sh test
	scripts/check_format.sh --fix

.PHONY: tidy
tidy:  ## clang-tidy over every file
	@scripts/install_dependencies.sh test
	cmake --preset tidy
	scripts/check_tidy.py --build build/tidy -j $(JOBS) --all

.PHONY: clean
clean:  ## remove what was built and rendered
	rm -rf build out
