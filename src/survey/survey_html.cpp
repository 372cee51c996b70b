// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/survey_html.hpp"

#include <fmt/format.h>

#include "eval/chart.hpp"
#include "eval/html_page.hpp"
#include "survey/survey_table.hpp"

namespace nvm::survey {

namespace {

constexpr const char* kStyle = R"(th:nth-child(2), td:nth-child(2) { text-align: left; }
tr:hover td { background: #fdf1dd; }
.plan { overflow: auto; border: 1px solid #ddd; }
.wall.shown .fill { fill: #f3b562; }
.wall.shown line { stroke: #d4500c; stroke-width: 3; }
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
    cells += fmt::format("<{0}>{1}</{0}>", tag, eval::escaped(text));
  }
  return start + cells + "</tr>\n";
}

}  // namespace

std::string survey_html(const Survey& survey, const std::string& svg) {
  std::string page = eval::html_head("nvm walls", 1640, kStyle);
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
