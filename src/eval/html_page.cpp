// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/html_page.hpp"

#include <fmt/format.h>

namespace nvm::eval {

std::string html_head(const std::string& title, int max_width_px, const std::string& style) {
  return fmt::format(
      R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{0}</title>
<style>
body {{ font: 14px/1.45 sans-serif; color: #222; background: #fff; margin: 2em auto; max-width: {1}px; padding: 0 1em; }}
h1 {{ font-size: 1.5em; }}
table {{ border-collapse: collapse; font-variant-numeric: tabular-nums; }}
th, td {{ padding: .2em .8em; border-bottom: 1px solid #ddd; text-align: right; }}
th:first-child, td:first-child {{ text-align: left; }}
p.note {{ color: #666; max-width: 60em; }}
{2}</style>
</head>
<body>
<h1>{0}</h1>
)",
      title,
      max_width_px,
      style);
}

}  // namespace nvm::eval
