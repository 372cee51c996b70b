// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>

namespace nvm::eval {

/// The beginning of a page that stands alone, up to its heading, which is the title. `style`: CSS
/// rules beside those of all pages.
std::string html_head(const std::string& title, int max_width_px, const std::string& style);

}  // namespace nvm::eval
