# One word each. Everything is installed into .venv; nothing needs doing by hand.
PYTHON ?= python3.11
VENV := .venv
BIN := $(VENV)/bin
RUST := Cargo.toml $(shell find engine bindings -name '*.rs' -o -name '*.csv' -o -name '*.json' -o -name Cargo.toml)
OUT := out
# Libraries that Blender as a module links to, beyond what a bare Debian carries.
BLENDER_LIBRARIES := libgl1 libice6 libsm6 libx11-6 libxext6 libxfixes3 libxi6 libxkbcommon0 libxrender1

.PHONY: setup demo test lint bench figures wheel clean

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

demo: setup
	mkdir -p $(OUT)
	$(BIN)/brisance run scenes/window.toml -o $(OUT)/window.usdc --report $(OUT)/window.json
	$(BIN)/brisance render $(OUT)/window.usdc -o $(OUT)/window.mp4 --size 640x360
	@echo
	@echo "Watch it:          $(OUT)/window.mp4"
	@echo "Open in Blender:   $(OUT)/window.usdc   (File > Import > Universal Scene Description)"
	@echo "Read the numbers:  $(OUT)/window.json"

test: setup
	cargo test --release --quiet --package brisance-engine
	$(BIN)/pytest python/tests

lint: setup
	cargo fmt --all --check
	cargo clippy --release --all-targets --quiet -- -D warnings
	$(BIN)/ruff check python benches docs
	$(BIN)/ruff format --check python benches docs
	$(BIN)/mypy
	cd python && ../$(BIN)/python -m mypy.stubtest brisance._engine

bench: setup
	cargo bench --package brisance-engine
	for script in benches/*.py; do $(BIN)/python $$script || exit 1; done

figures: setup
	$(BIN)/brisance figure all -o $(OUT)/figures

wheel: setup
	$(BIN)/maturin build --release --out dist

clean:
	rm -rf $(VENV) $(OUT) dist target
