# The verbs of a newcomer; everything behind them is a script or a CMake preset.
.PHONY: help setup demo test bench docs format lint coverage fuzz

help:  ## this list
	@sed -n 's/^\([a-z]*\):  ## /  make \1\t/p' Makefile

setup:  ## install every dependency (Debian 12)
	scripts/setup.sh

demo:  ## map a thin wall with and without nvm, as a picture
	scripts/demo.sh

test:  ## build everything and run every test
	scripts/test.sh

bench:  ## build for this machine and measure
	scripts/bench.sh

docs:  ## the site with all pages and interfaces, in build/docs
	scripts/docs.sh

format:  ## format every C++ file
	scripts/format.sh

lint:  ## build with clang, clang-tidy on every file
	scripts/setup.sh --developer
	cmake --preset tidy && cmake --build --preset tidy

fuzz:  ## try random maps, files, messages and options for SECONDS=60 each
	scripts/fuzz.sh $(SECONDS)

coverage:  ## which lines the tests reach
	scripts/setup.sh --developer
	scripts/test.sh coverage
	gcovr --root . --filter include --filter src build/coverage
