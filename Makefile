# The commands of the project; `make help` lists them. Each sets up what it needs.
SHELL := /bin/bash
.NOTPARALLEL:
JOBS ?= $(shell nproc)

.PHONY: run program test bench count peers grid lint format docs asan tsan fuzz clean help

help: ## list these commands
	@awk -F ':.*## ' '/^[a-z]+:.*## /{printf "make %-7s %s\n", $$1, $$2}' Makefile

run: setup-build ## replay a recorded scene and a generated one, and verify them
	@scripts/build.sh release carom_run_program
	@scripts/run.sh build/release/cli/carom-run

program: setup-build ## build the program with all its commands: build/release/cli/carom
	@scripts/build.sh release carom_program

test: build-release ## run all tests
	ctest --preset release -j $(JOBS)

bench: setup-build ## run the benchmarks; JSON goes to build/bench, rows of frames to docs/benchmarks.md
	@scripts/build.sh release carom_bench carom_run_program
	@scripts/bench.sh build/release/bench/carom_bench
	@scripts/frame_rows.py build/release/cli/carom-run build/release/bench/carom_bench --write

count: setup-dev ## count the instructions of ten scenes and compare with bench/instructions.txt
	@scripts/build.sh release carom_run_program
	@scripts/instruction_counts.py build/release/cli/carom-run

peers: setup-peers ## compare with other libraries; ARGS="--large FILE.aabb"; writes docs/peers.md
	@scripts/build.sh peers carom_peers
	@scripts/peers.sh build/peers/bench/peers/carom_peers $(ARGS)

grid: setup-build ## compare the bits of six builds on all instruction sets (half an hour)
	@scripts/grid.sh

lint: setup-dev ## check format, clang-tidy and include directions
	@scripts/lint.sh

format: setup-dev ## format all sources
	@scripts/format.sh

docs: setup-docs ## reference pages of the public headers (build/docs/html)
	@scripts/docs.sh

asan: setup-dev build-asan ## run the tests under AddressSanitizer and UBSan
	ctest --preset asan -j $(JOBS)

tsan: setup-dev build-tsan ## run the tests that start threads under ThreadSanitizer
	ctest --preset tsan -j $(JOBS)

fuzz: setup-dev build-fuzz ## run every fuzz target for SECONDS_EACH seconds (20)
	@scripts/fuzz.sh build/fuzz

clean: ## remove all builds
	rm -rf build

setup-%:
	@scripts/setup.sh $*

build-%: setup-build
	@scripts/build.sh $*
