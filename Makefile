# One word each. Everything is installed into .venv; nothing needs doing by hand.
PYTHON ?= python3.11
VENV := .venv
BIN := $(VENV)/bin
RUST := Cargo.toml $(shell find engine bindings -name '*.rs' -o -name '*.csv' -o -name '*.json' -o -name Cargo.toml)
OUT := out
# Libraries that Blender as a module links to, beyond what a bare Debian carries.
BLENDER_LIBRARIES := libgl1 libice6 libsm6 libx11-6 libxext6 libxfixes3 libxi6 libxkbcommon0 libxrender1

.PHONY: setup viewer demo test lint bench figures wheel clean

setup: $(VENV)/.ready

$(VENV)/.ready: pyproject.toml $(RUST)
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	$(BIN)/pip install --quiet --disable-pip-version-check --editable '.[render,dev]'
	$(BIN)/python -c 'import bpy' >/dev/null 2>&1 || $(MAKE) blender-libraries
	touch $@

.PHONY: blender-libraries
blender-libraries:
	@command -v apt-get >/dev/null && test "$$(id -u)" = 0 \
		&& apt-get update -qq && apt-get install -y -qq $(BLENDER_LIBRARIES) >/dev/null \
		|| echo "Videos need Blender's libraries: sudo apt-get install $(BLENDER_LIBRARIES)"

# The live view's page, built into the Python package.
VIEWER := python/brisance/view/static/index.html
NODE_PARTS := viewer/node_modules/.package-lock.json

viewer: $(VIEWER)

$(VIEWER): $(NODE_PARTS) $(wildcard viewer/src/*) viewer/index.html viewer/vite.config.mjs
	npm run --prefix viewer --silent build -- --logLevel warn
	touch $@

$(NODE_PARTS): viewer/package-lock.json
	@command -v npm >/dev/null || { echo "The live view is built with Node: install Node 20 or newer."; exit 1; }
	npm ci --prefix viewer --no-audit --no-fund --silent
	touch $@

# The browser that tests of the live view drive.
CHROMIUM ?= /usr/bin/chromium
.PHONY: chromium
chromium:
	@test -x $(CHROMIUM) || { command -v apt-get >/dev/null && test "$$(id -u)" = 0 \
		&& apt-get update -qq && apt-get install -y -qq chromium >/dev/null; } \
		|| { echo "Tests of the live view need Chromium: sudo apt-get install chromium, or name it in CHROMIUM"; exit 1; }

demo: setup viewer
	mkdir -p $(OUT)
	$(BIN)/brisance run scenes/window.toml -o $(OUT)/window.usdc --report $(OUT)/window.json
	$(BIN)/brisance render $(OUT)/window.usdc -o $(OUT)/window.mp4 --size 640x360
	@echo
	@echo "Watch it:          $(OUT)/window.mp4"
	@echo "Open in Blender:   $(OUT)/window.usdc   (File > Import > Universal Scene Description)"
	@echo "Read the numbers:  $(OUT)/window.json"
	@echo "Turn the knobs:    $(BIN)/brisance view scenes/window.toml"

# The same random cases on every run; BRISANCE_CASES and a seed of one's own draw others.
test: setup viewer chromium
	PROPTEST_RNG_SEED=1 cargo test --release --quiet --package brisance-engine
	$(BIN)/pytest python/tests
	CHROMIUM=$(CHROMIUM) node --test --test-concurrency=1 viewer/test/view.test.mjs viewer/test/page.test.mjs

lint: setup $(NODE_PARTS)
	cargo fmt --all --check
	cargo clippy --release --all-targets --quiet -- -D warnings
	$(BIN)/ruff check python benches docs
	$(BIN)/ruff format --check python benches docs
	$(BIN)/mypy
	cd python && ../$(BIN)/python -m mypy.stubtest brisance._engine
	npm run --prefix viewer --silent check

# What some benchmarks measure beside ours; where one cannot be had, they do without.
RIVALS := manifold3d multivoro pybullet rapier3d

bench: setup viewer chromium
	for rival in $(RIVALS); do $(BIN)/pip install --quiet --disable-pip-version-check --only-binary :all: $$rival || true; done
	cargo bench --package brisance-engine
	for script in benches/*.py; do $(BIN)/python $$script || exit 1; done

figures: setup
	$(BIN)/brisance figure all -o $(OUT)/figures

wheel: setup viewer
	$(BIN)/maturin build --release --out dist

clean:
	rm -rf $(VENV) $(OUT) dist target viewer/node_modules python/brisance/view/static
