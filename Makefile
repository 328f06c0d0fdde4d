# Everything here sets itself up: Python 3.11 or later and make are enough.
PYTHON ?= python3
VENV ?= .venv
BIN = $(VENV)/bin
JOBS ?= 2
# The day of the edition, so that what is built of the same files is the same bytes.
EPOCH := $(shell $(PYTHON) -c "import re, datetime as d; day = re.search('date-released: (.+)', open('CITATION.cff').read())[1]; print(int(d.datetime.fromisoformat(day + 'T00:00+00:00').timestamp()))")
PIP = $(BIN)/python -m pip install --quiet --disable-pip-version-check

.PHONY: reproduce test lint format coverage wheel pyz benchmark mutants claims tei-check edition book archive serve upgrade hooks clean

reproduce: $(VENV)/.run
	$(BIN)/hull1620 reproduce

# The processes that tests start read the bytecode of earlier ones, also if the user turned bytecode off.
test: export PYTHONDONTWRITEBYTECODE =
test: $(VENV)/.dev lint
	$(BIN)/python -m pytest -q -n $(JOBS) --dist worksteal

lint: $(VENV)/.dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports --no-cache

format: $(VENV)/.dev
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

coverage: $(VENV)/.dev
	$(BIN)/python -m pytest -q -n $(JOBS) --dist worksteal --cov --cov-report term:skip-covered

wheel: $(VENV)/.dev
	rm -rf build/lib
	SOURCE_DATE_EPOCH=$(EPOCH) $(BIN)/python -m build --wheel --no-isolation --outdir dist .

# The program as one file that needs only Python: dist/hull1620.pyz.
pyz: wheel
	$(BIN)/python -m modern.publication.pyz dist

benchmark: $(VENV)/.dev
	$(BIN)/python -m modern.bench.suite

mutants: $(VENV)/.dev
	$(BIN)/python -m tests.mutants --jobs $(JOBS)

# The full searches of the claims; the results are committed, and an interrupted run continues.
claims: $(VENV)/.dev
	$(BIN)/python -m modern.claims.full --jobs $(JOBS)

# The TEI documents against a schema: SCHEMA=tei_all.rng, or the project's own.
tei-check: $(VENV)/.dev
	$(BIN)/hull1620 tei --check $(SCHEMA)

edition: $(VENV)/.dev
	$(BIN)/python -m modern.publication.site.build dist/edition

# The same as a book: dist/hull1620.pdf, PDF/A.
book: $(VENV)/.dev
	$(BIN)/python -m modern.publication.book.build dist/hull1620.pdf

# Everything for an archive, as a BagIt bag: dist/hull1620-VERSION-deposit; ROWS=FOLDER adds rows of studies.
archive: wheel pyz book edition
	$(BIN)/python -m modern.publication.vendored dist/wheels
	$(BIN)/python -m modern.publication.deposit dist $(if $(ROWS),--rows $(ROWS))

# The site on your own computer alone; its pages open as files too, but for the machine in the page.
serve:
	$(BIN)/python -m http.server --bind 127.0.0.1 --directory dist/edition 1620

# The newest versions that pyproject.toml allows, for every platform, with hashes: locks/run.lock for the command alone,
# dev.lock for everything. Extras stay in the lock: without them, pip 23 ignores the pin of `coverage` when pytest-cov
# asks for `coverage[toml]`, and a newer release stops the installation.
LOCK = $(BIN)/uv pip compile --quiet --upgrade --universal --python-version 3.11 --fork-strategy fewest --generate-hashes \
	--no-header --no-annotate --no-emit-index-url --no-emit-find-links --no-strip-extras pyproject.toml locks/build.in
upgrade: $(VENV)/.dev
	$(LOCK) --output-file locks/run.lock
	$(LOCK) --all-extras --constraints locks/run.lock --output-file locks/dev.lock

hooks: $(VENV)/.dev
	$(BIN)/pre-commit install

$(VENV)/.run: pyproject.toml locks/run.lock
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "hull1620 needs Python 3.11 or later; set PYTHON=...")'
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	$(PIP) --require-hashes --requirement locks/run.lock
	$(PIP) --no-deps --no-build-isolation --editable .
	touch $@

$(VENV)/.dev: $(VENV)/.run locks/dev.lock
	$(PIP) --require-hashes --requirement locks/dev.lock
	touch $@

clean:
	rm -rf $(VENV) build dist *.egg-info
