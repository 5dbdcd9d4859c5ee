# make run     sets up, starts the service, prints the URL       make check   lint and types
# make test    sets up, passes every check and test              make bench   the benchmarks
# Everything it makes lies in .venv, .simulators, web/node_modules and server/static; `make clean` removes that.

SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DELETE_ON_ERROR:
.DEFAULT_GOAL := help

PYTHON ?= $(shell for p in python3 python3.12 python3.11; do \
	$$p -c 'import sys; sys.exit(not (3, 11) <= sys.version_info < (3, 13))' 2>/dev/null && echo $$p && exit; done; echo python3)
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/pip --disable-pip-version-check
NPM := $(BIN)/python scripts/node.py npm
INSTALL_FROM := pyproject.toml constraints.txt scripts/install.sh scripts/node.py
WEB_SOURCES := $(shell find web -type d \( -name node_modules -o -name test \) -prune -o -type f -print 2>/dev/null)
PYTEST_ARGS ?=
# A file stays on one worker, and files in their order: the browser's come last (tests/conftest.py). With more workers than
# cores a learner, which gives way to everything else, may not start within its deadline.
PYTEST_WORKERS ?= 2

.PHONY: help run setup setup-dev test test-arm check check-web check-docker test-web bench bench-arm api screenshots clean

help:
	@sed -n 's/^# //p' Makefile | head -3

# --- run ---------------------------------------------------------------------------------------------------------

run: setup  ## SEED_… variables are settings, see docs/settings.md
	@echo "==> Starting the service (Ctrl-C stops it)"
	@exec $(BIN)/seed serve

setup: $(VENV)/.installed server/static/index.html

$(VENV)/bin/python:
	@bash scripts/system.sh run $(PYTHON)
	@echo "==> Making a virtual environment in $(VENV)"
	@$(PYTHON) -c 'import sys; sys.exit(not (3, 11) <= sys.version_info < (3, 13) and "Python 3.11 or 3.12 is needed: make run PYTHON=python3.11")'
	@$(PYTHON) -m venv $(VENV)

$(VENV)/.installed: $(INSTALL_FROM) | $(VENV)/bin/python
	@bash scripts/system.sh run $(PYTHON)
	@echo "==> Installing (the first time this fetches a few hundred megabytes)"
	@bash scripts/install.sh $(VENV)
	@touch $@

# The hook in hatch_build.py builds the page; it does nothing where the sources' digest says that nothing changed.
server/static/index.html: $(WEB_SOURCES) hatch_build.py scripts/node.py | $(VENV)/.installed
	@echo "==> Building the web page"
	@$(PIP) install --verbose --no-deps --editable .
	@touch $@

# --- develop -----------------------------------------------------------------------------------------------------

setup-dev: $(VENV)/.installed-dev web/node_modules/.installed-dev server/static/index.html

$(VENV)/.installed-dev: $(INSTALL_FROM) | $(VENV)/bin/python
	@bash scripts/system.sh test $(PYTHON)
	@echo "==> Installing, with everything that checks and tests need"
	@bash scripts/install.sh $(VENV) dev
	@touch $(VENV)/.installed $@

.simulators/.installed: scripts/simulators.sh | $(VENV)/.installed-dev
	@bash scripts/simulators.sh $(PYTHON)
	@mkdir -p .simulators && touch $@

web/node_modules/.installed-dev: web/package.json web/package-lock.json | $(VENV)/.installed-dev
	@echo "==> Installing what the web page's checks and tests need"
	@$(NPM) ci
	@touch $@

# pytest comes last, so that its summary is the last thing to be read.
test: setup-dev .simulators/.installed
	@bash scripts/system.sh test $(PYTHON)
	@$(MAKE) --no-print-directory check test-web
	@echo "==> Tests"
	@$(BIN)/python -m pytest -n $(PYTEST_WORKERS) --dist loadfile --no-loadscope-reorder -m "not long" $(PYTEST_ARGS)

# Everything on the simulated Franka, with the long runs that `make test` has no time for.
test-arm: setup-dev .simulators/.installed
	@$(BIN)/python -m pytest -m simulated_arm $(PYTEST_ARGS)

check: setup-dev
	@echo "==> Lint and types"
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .
	@$(BIN)/mypy
	@$(MAKE) --no-print-directory check-web check-docker-lint

check-web: setup-dev
	@echo "==> Lint and types of the web page, and its types against the service's OpenAPI document"
	@$(NPM) run check

.PHONY: check-docker-lint
check-docker-lint: setup-dev
	@if [ -x $(BIN)/hadolint ]; then $(BIN)/hadolint Dockerfile; else echo "no hadolint for this machine: Dockerfile not linted"; fi

# No Docker engine is needed: the Dockerfile's own commands run in a clean directory.
check-docker: setup-dev
	@$(BIN)/python scripts/check_dockerfile.py

test-web: setup-dev
	@echo "==> Tests of the web page"
	@$(NPM) test

bench: setup-dev
	@$(BIN)/python -m tests.benchmarks

bench-arm: setup-dev .simulators/.installed  ## on the simulated Franka, by itself on the machine
	@$(BIN)/python -m tests.benchmarks franka_arm

screenshots: setup-dev  ## the pictures in docs/screenshots; look at them before you commit them
	@$(BIN)/python -m scripts.screenshots

api: setup-dev  ## writes web/src/api.ts from the service's OpenAPI document
	@$(NPM) run api

clean:
	rm -rf $(VENV) .simulators web/node_modules server/static test-results dist .mypy_cache .ruff_cache .pytest_cache .hypothesis
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
