// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/report/evaluation.hpp"
#include "io/sequence/sequence_reader.hpp"
#include "lio/pipeline/pipeline_options.hpp"
#include "sim/simulation.hpp"

// One function of each compiled component: the linker has to find all that they need.
auto* volatile evaluate_run = &nvm::eval::evaluate_run;
auto* volatile open_sequence = &nvm::io::open_sequence;
auto* volatile resolve = &nvm::lio::resolve;
auto* volatile simulate = &nvm::sim::simulate;
