// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/survey_html.hpp"

#include <fmt/format.h>

#include "survey/survey_table.hpp"

namespace nvm::survey {

namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>nvm walls</title>
<style>
body { font: 14px/1.45 sans-serif; color: #222; background: #fff; margin: 2em auto; max-width: 1640px; padding: 0 1em; }
h1 { font-size: 1.5em; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: .2em .8em; border-bottom: 1px solid #ddd; text-align: right; }
th:first-child, td:first-child { text-align: left; }
p.note { color: #666; max-width: 60em; }
th:nth-child(2), td:nth-child(2) { text-align: left; }
tr:hover td { background: #fdf1dd; }
.plan { overflow: auto; border: 1px solid #ddd; }
.wall.shown .fill { fill: #f3b562; }
.wall.shown line { stroke: #d4500c; stroke-width: 3; }
</style>
</head>
<body>
<h1>nvm walls</h1>
)";

constexpr const char* kScript = R"(<script>
document.querySelectorAll("tr[data-wall]").forEach(row => ["mouseenter", "mouseleave"].forEach(kind =>
  row.addEventListener(kind, () => {
    const wall = document.getElementById(row.dataset.wall);
    if (wall) wall.classList.toggle("shown", kind === "mouseenter");
  })));
</script>
)";

std::string row(const std::vector<std::string>& texts, const char* tag, const std::string& start) {
  std::string cells;
  for (const std::string& text : texts) {
    cells += fmt::format("<{0}>{1}</{0}>", tag, text);
  }
  return start + cells + "</tr>\n";
}

}  // namespace

std::string survey_html(const Survey& survey, const std::string& svg) {
  std::string page = kHead;
  page += fmt::format(
      "<p class=\"note\">{} walls, slabs, doors and panels seen from both sides, {} columns and "
      "pieces of furniture, {} faces seen from one side. Filled: between both faces, with the "
      "thickness [mm]; dashed: openings; grey: one side only; brown: furniture.</p>\n",
      survey.walls.size(),
      survey.bodies.size(),
      survey.faces.size());
  page += "<div class=\"plan\">\n" + svg + "</div>\n<table>\n" + row(table_header(), "th", "<tr>");
  const auto rows = table_rows(survey);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t walls = survey.walls.size();
    const std::string id =
        i < walls ? fmt::format("wall-{}", i) : fmt::format("body-{}", i - walls);
    page += row(rows[i], "td", "<tr data-wall=\"" + id + "\">");
  }
  return page + "</table>\n" + kScript + "</body>\n</html>\n";
}

}  // namespace nvm::survey
