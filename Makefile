# `make demo` and `make test` set up what is missing; nothing else needs to be installed by hand.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
MODEL ?= models/truck/truck.obj
MODELS ?= models

.PHONY: setup demo test bench gallery clean

setup: $(VENV)/.ready

$(VENV)/.ready: pyproject.toml constraints.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' \
	  || { echo "popsim needs Python 3.11 or newer; $(PYTHON) is $$($(PYTHON) -V 2>&1). Say which: make PYTHON=python3.12" >&2; exit 2; }
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || { test "$$(id -u)" = 0 && command -v apt-get >/dev/null \
	  && apt-get update -qq && apt-get install -y -qq python3-venv >/dev/null; } \
	  || { echo "Python's venv module is missing: install it first (Debian: sudo apt-get install python3-venv)" >&2; exit 2; }
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[dev]'
	$(BIN)/python -m popsim.fitting.kernels
	touch $@

demo: setup
	$(BIN)/popsim design $(MODEL) --output demo --force

test: setup
	$(BIN)/ruff check popsim models tests
	$(BIN)/ruff format --check popsim models tests
	$(BIN)/mypy
	$(BIN)/pytest -n auto

bench: setup
	$(BIN)/pytest tests/benchmarks -o addopts='' -q --benchmark-group-by=group

gallery: setup
	$(BIN)/popsim gallery $(MODELS) --output tests/pictures/gallery.jpg --force

clean:
	rm -rf demo dist build .mypy_cache .ruff_cache .pytest_cache .hypothesis .benchmarks
	find . -name __pycache__ -not -path './$(VENV)/*' -prune -exec rm -rf {} +
