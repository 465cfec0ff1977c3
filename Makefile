# The front door: `make` says what there is. Everything else is CMake (CMakePresets.json) and scripts/.
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
MAKEFLAGS += --no-print-directory

JOBS ?= $(shell nproc)
SCENE ?= hexagon_room
IMAGE ?= out/$(notdir $(basename $(SCENE))).png
# The room as it is meant to be looked at: its default of as many shadow rays as samples, the report's, takes a minute.
ROOM_ARGS := --spp 256 -Dshadow_rays=1
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

.PHONY: test
test: release-all  ## warnings as errors, a render, all tests, the checks, a peer's scenes, sanitizers, fuzzers
	@mkdir -p out
	$(RELEASE)/norrsken render hexagon_room -o out/hexagon_room.png $(ROOM_ARGS)
	ctest --test-dir $(RELEASE) -j $(JOBS) --output-on-failure
	scripts/check_conformance.sh $(RELEASE)/norrsken
	scripts/check_format.sh
	@$(MAKE) sanitize-quick fuzz-quick

.PHONY: thorough
thorough: test tidy sanitize  ## `test`, then clang-tidy and the sanitizers

.PHONY: check
check: release-all  ## the quick part of `test`: no slow tests
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
# `make test` looks in about the same places each time, `make fuzz` elsewhere.
fuzz-quick: export FUZZ_SEED ?= 1
fuzz fuzz-quick:
	@scripts/install_dependencies.sh test
	cmake --preset fuzz -DNORRSKEN_WARNINGS_AS_ERRORS=ON
	cmake --build --preset fuzz -j $(JOBS)
	scripts/fuzz.sh $(FUZZ_SECONDS) $(JOBS)

# The fast part of the suite for `make test`: what reads files, and what has threads. The address and undefined-behaviour
# sanitizers go by way of the fuzz build, which has them too: its libraries are built anyway.
ASAN_TESTS := text_test raster_image_test texel_image_test parameters_test mitsuba_xml_test mitsuba_element_test \
  xml_document_test obj_test ply_test serialized_test vol_test curves_test section_file_test image_file_test film_test \
  work_plan_test cli_arguments_test repeatability_test traps_test path_trace_test hostile_files_test stopping_test
TSAN_TESTS := work_plan_test repeatability_test stopping_test cli_interrupt_test

.PHONY: sanitize-quick asan-ubsan-quick tsan-quick
sanitize-quick: asan-ubsan-quick tsan-quick  ## the fast part of the suite under the sanitizers
asan-ubsan-quick: PRESET := fuzz
asan-ubsan-quick: TESTS := $(ASAN_TESTS)
tsan-quick: PRESET := tsan
tsan-quick: TESTS := $(TSAN_TESTS)
asan-ubsan-quick tsan-quick:
	@scripts/install_dependencies.sh test
	cmake --preset $(PRESET) -DNORRSKEN_WARNINGS_AS_ERRORS=ON -DNORRSKEN_BUILD_TESTS=ON -DNORRSKEN_ISAS=scalar
	cmake --build build/$(PRESET) -j $(JOBS) --target $(TESTS)
	ctest --preset $(PRESET) -j $(JOBS) --exclude-regex '_NOT_BUILT|^Fuzz[.]'

.PHONY: release-all
release-all:
	@scripts/install_dependencies.sh test
	cmake --preset release -DNORRSKEN_WARNINGS_AS_ERRORS=ON
	cmake --build $(RELEASE) -j $(JOBS)

.PHONY: bench
bench: build  ## measure the hexagon room and every Google Benchmark
	cmake --build $(RELEASE) -j $(JOBS)
	$(RELEASE)/norrsken bench hexagon_room -Dshadow_rays=1 -Dbounces=3 --sampler independent
	for program in $(RELEASE)/benchmarks/*_benchmark; do "$$program"; done

.PHONY: format
format:  ## rewrite the sources in the project's format
	@scripts/install_dependencies.sh test
	scripts/check_format.sh --fix

.PHONY: tidy
tidy: release-all  ## clang-tidy over every file
	scripts/check_tidy.py --build $(RELEASE) -j $(JOBS) --all

.PHONY: clean
clean:  ## remove what was built and rendered
	rm -rf build out
