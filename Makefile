# The verbs of this repository; `make` alone lists them. Each is one or two plain commands, to be read and run by hand as well.

CARGO ?= cargo
# Where `make demo` puts its report, and what else it is to be told: make demo ARGS="--frames 60 --size 800x600"
OUT ?= out/demo
ARGS ?=
# What `make fuzz` fuzzes, and for how many seconds.
FUZZ ?= loaders
FUZZ_SECONDS ?= 600

# Mesa's device selection complains where there is no desktop, and is not needed: Antumbra looks at every adapter itself.
export NODEVICE_SELECT ?= 1

.DEFAULT_GOAL := help
.PHONY: help demo test kit mutants lint fmt shaders bench data fuzz bevy test-bevy test-drivers test-web

help: ## list these verbs
	@sed -n 's/^\([a-z-]*\):[^#]*## \(.*\)/  make \1\t\2/p' $(firstword $(MAKEFILE_LIST)) | expand -t 14

demo: ## compare all strategies on the built-in scene; the report goes to out/demo
	scripts/vulkan.sh
	$(CARGO) run --release --locked -- compare --out $(OUT) $(ARGS)

test: ## run every test, on Vulkan and on OpenGL (installs Mesa's software drivers where there is no adapter)
	scripts/vulkan.sh --with-egl
	$(CARGO) test --workspace --locked

kit: ## play the whole conformance kit to all strategies, a million trials to depth-pyramid, two thousand random views to the judge, and depths of every size to its pyramid
	scripts/vulkan.sh --with-egl
	KIT=whole JUDGE_TRIALS=2000 PYRAMID_SEEDS=500 $(CARGO) test --workspace --locked --test conformance --test judge
	TRIALS=1000000 $(CARGO) test --workspace --locked --test depth_pyramid_trials
	PYRAMID_SIZES=whole $(CARGO) test --package antumbra-cull --locked --lib pyramid

mutants: ## take each safety away in a copy of the tree, and see a test fail (docs/mutants.md)
	scripts/vulkan.sh --with-egl
	scripts/mutants.sh

lint: ## formatting, clippy and rustdoc, warnings as errors
	$(CARGO) fmt --all --check
	$(CARGO) clippy --workspace --all-targets --locked -- -D warnings
	RUSTDOCFLAGS=-Dwarnings $(CARGO) doc --workspace --no-deps --locked

fmt: ## format all code
	$(CARGO) fmt --all

shaders: ## check the shaders and write shaders/src/generated.rs, after a change of WGSL
	UPDATE_SHADERS=1 $(CARGO) test --workspace --locked --test generated

bench: ## run the benches; loading is measured on data/2CylinderEngine.glb where it is there (make data)
	scripts/vulkan.sh
	engine=$(CURDIR)/data/2CylinderEngine.glb; if [ -f "$$engine" ]; then export ANTUMBRA_ENGINE_GLB="$$engine"; fi; \
	$(CARGO) bench --workspace --locked

bevy: ## say which Rust compiles the Bevy plug-in of crates/bevy, and build its examples with it
	scripts/bevy.sh
	scripts/bevy.sh build --locked --examples

test-bevy: ## test the Bevy plug-in
	scripts/vulkan.sh
	scripts/bevy.sh test --locked

test-drivers: ## test on SwiftShader, and on Mesa's driver under Khronos's validation layer (installs both where they are missing)
	scripts/vulkan.sh --with-egl
	scripts/drivers.sh $(CARGO) test --workspace --locked --test counting --test distrust --test judge --test gpu

test-web: ## run every shader, plan and strategy in Chromium, and compare with the same without a browser (installs Chromium and a Rust target where they are missing)
	scripts/web.sh

data: ## fetch the real scenes into data/
	scripts/data.sh all

fuzz: ## fuzz the loaders for ten minutes (FUZZ_SECONDS=600, FUZZ=surfaces, rasters, volumes, horizons, words); see fuzz/README.md
	@$(CARGO) fuzz --version >/dev/null 2>&1 || { echo "make fuzz needs cargo-fuzz: cargo install cargo-fuzz --locked"; exit 1; }
	RUSTC_BOOTSTRAP=1 $(CARGO) fuzz run $(FUZZ) -- -max_total_time=$(FUZZ_SECONDS)
