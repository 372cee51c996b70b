// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// A configuration of any text is refused, or gives options that print as text which reads back.
#include "config/schema.hpp"
#include "fuzz_target.hpp"
#include "io/sequence/sequence_options.hpp"
#include "lio/pipeline/pipeline_options.hpp"

namespace {

/// All options of a run, as `yaml` sets them, in YAML.
std::string read(const std::string& yaml) {
  nvm::lio::PipelineOptions pipeline;
  nvm::io::SequenceOptions input;
  nvm::config::Schema schema;
  nvm::lio::bind(schema, pipeline);
  nvm::io::bind(schema.section("input", "How to read the sequence"), input);
  schema.read_text(yaml, "fuzzed.yaml");
  return schema.to_yaml();
}

void set(const std::string& assignment) {
  nvm::lio::PipelineOptions pipeline;
  nvm::config::Schema schema;
  nvm::lio::bind(schema, pipeline);
  schema.set(assignment);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = nvm::fuzz::Input(data, size).rest();
  nvm::fuzz::accepts([&] { set(text); });
  std::string printed;
  if (nvm::fuzz::accepts([&] { printed = read(text); })) {
    nvm::fuzz::require(read(printed) == printed, "printed options read back");
  }
  return 0;
}
