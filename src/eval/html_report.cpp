// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/html_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "eval/chart.hpp"
#include "eval/html_page.hpp"
#include "eval/trajectory_charts.hpp"

namespace nvm::eval {

namespace {

constexpr double kMillimetres = 1e3;

constexpr const char* kStyle =
    R"(h2 { font-size: 1.15em; margin-top: 2em; } h3 { font-size: 1em; margin-bottom: .3em; }
.row { display: flex; flex-wrap: wrap; gap: 1em; overflow-x: auto; }
button { font: inherit; border: 1px solid #bbb; border-radius: 4px; background: #fff; padding: .2em .7em; margin-right: .5em; cursor: pointer; }
button.off { opacity: .35; }
)";

// Shows and hides the lines of a run.
constexpr const char* kScript = R"(<script>
document.querySelectorAll("button[data-run]").forEach(button => button.addEventListener("click", () => {
  const hidden = button.classList.toggle("off");
  document.querySelectorAll(".run-" + button.dataset.run).forEach(line => { line.style.display = hidden ? "none" : ""; });
}));
</script>
)";

std::string number(const std::optional<double>& value, double scale, int digits) {
  return value ? fmt::format("{:.{}f}", scale * *value, digits) : "–";
}

std::optional<double> rmse(const std::optional<ErrorStatistics>& statistics) {
  return statistics ? std::optional(statistics->rmse) : std::nullopt;
}

std::string cells(const std::vector<std::string>& texts, const std::string& tag) {
  std::string row;
  for (const std::string& text : texts) {
    row += fmt::format("<{0}>{1}</{0}>", tag, escaped(text));
  }
  return "<tr>" + row + "</tr>\n";
}

/// A table row with one cell per run.
std::string run_row(
    const Evaluation& evaluation,
    const std::string& label,
    const std::function<std::string(const RunEvaluation&)>& cell) {
  std::vector<std::string> texts{label};
  for (const RunEvaluation& run : evaluation.runs) {
    texts.push_back(cell(run));
  }
  return cells(texts, "td");
}

std::vector<std::string> header(const std::string& first, const Evaluation& evaluation) {
  std::vector<std::string> texts{first};
  for (const RunEvaluation& run : evaluation.runs) {
    texts.push_back(run.name);
  }
  return texts;
}

std::string trajectory_rows(const Evaluation& evaluation) {
  using Read = std::function<std::string(const TrajectoryEvaluation&)>;
  const auto row = [&](const std::string& label, const Read& read) {
    return run_row(evaluation, label, [&](const RunEvaluation& run) {
      return run.trajectory ? read(*run.trajectory) : "–";
    });
  };
  const auto length = [&](const std::string& label, double ErrorStatistics::*member) {
    return row(label, [member](const TrajectoryEvaluation& trajectory) {
      return number(trajectory.absolute.*member, kMillimetres, 2);
    });
  };
  const auto relative = [&](const std::string& label, RelativeError TrajectoryEvaluation::*member) {
    return row(label, [member](const TrajectoryEvaluation& trajectory) {
      const RelativeError& error = trajectory.*member;
      return number(rmse(error.translation), kMillimetres, 2) + " mm, " +
             number(rmse(error.rotation_deg), 1.0, 3) + "°";
    });
  };
  return length("ATE RMSE [mm]", &ErrorStatistics::rmse) +
         length("ATE mean [mm]", &ErrorStatistics::mean) +
         length("ATE median [mm]", &ErrorStatistics::median) +
         length("ATE max [mm]", &ErrorStatistics::max) +
         relative("RPE RMSE per frame", &TrajectoryEvaluation::per_frame) +
         relative("RPE RMSE per second", &TrajectoryEvaluation::per_second) +
         relative("RPE RMSE per metre", &TrajectoryEvaluation::per_metre) +
         row("poses compared (without truth)", [](const TrajectoryEvaluation& trajectory) {
           return fmt::format(
               "{} ({})", trajectory.association.pairs.size(), trajectory.association.unmatched);
         });
}

std::string wall_summary_rows(const Evaluation& evaluation) {
  using Read = std::function<std::string(const WallSummary&)>;
  const auto row = [&](const std::string& label, const Read& read) {
    return run_row(evaluation, label, [&](const RunEvaluation& run) {
      return read(summarize(run.map.walls));
    });
  };
  const auto error = [&](const std::string& label, double ErrorStatistics::*member) {
    return row(label, [member](const WallSummary& walls) {
      return walls.absolute_error ? number((*walls.absolute_error).*member, kMillimetres, 2) : "–";
    });
  };
  return row("walls found (of those seen from both sides)",
             [](const WallSummary& walls) {
               return fmt::format("{} ({})", walls.measured, walls.seen);
             }) +
         error("thickness error, mean absolute [mm]", &ErrorStatistics::mean) +
         error("thickness error, worst [mm]", &ErrorStatistics::max) +
         row("side purity [%]",
             [](const WallSummary& walls) { return number(walls.sides.purity(), 100.0, 3); });
}

std::string map_rows(const Evaluation& evaluation) {
  const auto crispness = [&](const std::string& label, const auto& read) {
    return run_row(evaluation, label, [&](const RunEvaluation& run) {
      return run.map.crispness ? read(*run.map.crispness) : "–";
    });
  };
  return crispness(
             "crispness: plane thickness [mm]",
             [](const Crispness& map) { return number(map.plane_thickness, kMillimetres, 2); }) +
         crispness(
             "crispness: mean map entropy",
             [](const Crispness& map) { return number(map.mean_map_entropy, 1.0, 2); }) +
         run_row(
             evaluation,
             "map points",
             [](const RunEvaluation& run) { return std::to_string(run.map.points); }) +
         run_row(evaluation, "sides of points told", [](const RunEvaluation& run) {
           return run.map.has_normals ? "by normal" : "by position";
         });
}

const StageTiming* find_stage(const RunEvaluation& run, const std::string& stage) {
  const auto found = std::find_if(
      run.timing.begin(), run.timing.end(), [&](const StageTiming& t) { return t.stage == stage; });
  return found == run.timing.end() ? nullptr : &*found;
}

/// "map_update_ms" as "map update".
std::string stage_label(std::string stage) {
  const std::string unit = "_ms";
  if (stage.size() > unit.size() && stage.rfind(unit) == stage.size() - unit.size()) {
    stage.resize(stage.size() - unit.size());
  }
  std::replace(stage.begin(), stage.end(), '_', ' ');
  return stage;
}

/// One row per stage that the first run timed.
std::string timing_rows(const Evaluation& evaluation) {
  std::string rows;
  for (const StageTiming& first : evaluation.runs[0].timing) {
    const std::string label = "CPU per scan, mean (max) [ms]: " + stage_label(first.stage);
    rows += run_row(evaluation, label, [&](const RunEvaluation& run) {
      const StageTiming* stage = find_stage(run, first.stage);
      return stage ? fmt::format("{:.2f} ({:.2f})", stage->mean_ms, stage->max_ms) : "–";
    });
  }
  return rows;
}

std::string wall_cell(const WallEvaluation& wall) {
  if (!wall.is_seen) {
    return "not seen from both sides";
  }
  if (!wall.thickness) {
    return "not found";
  }
  std::string text = fmt::format("{:.2f}", kMillimetres * *wall.thickness);
  if (wall.error()) {
    text += fmt::format(
        " ({:+.2f} mm, {:+.1f} %)",
        kMillimetres * *wall.error(),
        100.0 * *wall.error() / *wall.true_thickness);
  }
  return text;
}

std::string wall_table(
    const Evaluation& evaluation,
    const std::string& title,
    std::vector<WallEvaluation> MapEvaluation::*member) {
  const auto& walls = evaluation.runs[0].map.*member;
  if (walls.empty()) {
    return "";
  }
  std::string table = "<h2>" + title + "</h2>\n<table>\n" +
                      cells(header("thickness [mm]: true, mapped (error)", evaluation), "th");
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const std::string label = walls[i].name + ": " + number(walls[i].true_thickness, 1e3, 1);
    table += run_row(evaluation, label, [&](const RunEvaluation& run) {
      return wall_cell((run.map.*member)[i]);
    });
  }
  return table + "</table>\n";
}

std::string run_buttons(const Evaluation& evaluation) {
  std::string buttons;
  for (std::size_t i = 0; i < evaluation.runs.size(); ++i) {
    buttons += fmt::format(
        "<button data-run=\"{}\"><span style=\"color:{}\">■</span> {}</button>",
        i,
        run_color(i),
        escaped(evaluation.runs[i].name));
  }
  return "<p>" + buttons + "</p>\n";
}

std::string picture_section(const std::vector<WallPicture>& pictures) {
  if (pictures.empty()) {
    return "";
  }
  std::string section =
      "<h2>Cross-sections</h2>\n<p class=\"note\">Map points of a wall seen along it; the colour "
      "is the side that a point's normal tells (grey: the map has none), the lines are the true "
      "faces. The axis across the wall is stretched.</p>\n";
  for (const WallPicture& picture : pictures) {
    section +=
        "<h3>" + escaped(picture.name) + "</h3>\n<div class=\"row\">" + picture.svg + "</div>\n";
  }
  return section;
}

}  // namespace

std::string html_report(const Evaluation& evaluation, const std::vector<WallPicture>& pictures) {
  std::string page = html_head("nvm evaluation", 1320, kStyle);
  page += "<table>\n" + cells(header("", evaluation), "th");
  if (evaluation.truth) {
    page += trajectory_rows(evaluation) + wall_summary_rows(evaluation);
  }
  page += map_rows(evaluation) + timing_rows(evaluation) + "</table>\n";
  if (evaluation.truth) {
    page +=
        "<h2>Trajectories</h2>\n<p class=\"note\">The truth and the walls are black. A click "
        "on a run hides it.</p>\n" +
        run_buttons(evaluation) + "<div class=\"row\">" + trajectory_chart(evaluation) +
        error_chart(evaluation) + "</div>\n";
  }
  page += wall_table(evaluation, "Walls", &MapEvaluation::walls);
  page += wall_table(evaluation, "Regions", &MapEvaluation::regions);
  return page + picture_section(pictures) + kScript + "</body>\n</html>\n";
}

}  // namespace nvm::eval
