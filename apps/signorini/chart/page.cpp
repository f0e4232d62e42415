#include "apps/signorini/chart/page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace signorini::chart {
namespace {

std::string cost_label(const std::string& against) { return against == "memory" ? "memory, MB" : against; }

std::string error_label(const std::string& of) {
  return of == "energy" ? "relative error in the energy norm" : "relative error: " + of;
}

Panel panel(const std::string& of, const std::string& against, const std::vector<Setting>& settings,
            const std::vector<Run>& all) {
  Panel out;
  out.title = fmt::format("error of {} against {}", of, against);
  out.label = error_label(of);
  out.across = cost_label(against);
  out.view = View::lines;
  out.logarithmic = true;
  for (std::size_t s = 0; s < settings.size(); ++s) {
    Line line;
    line.name = settings[s].name;
    line.style = static_cast<int>(s);
    for (const Run& run : all)
      if (run.setting == s && run.error) line.points.push_back({run.cost(against), *run.error});
    if (!line.points.empty()) out.lines.push_back(std::move(line));
  }
  return out;
}

std::string error_text(const Run& run) { return run.error ? fmt::format("{:.3e}", *run.error) : ""; }

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  return out;
}

std::string table(const std::vector<Setting>& settings, const std::vector<Run>& all) {
  std::string out =
      "<table><thead><tr><th>setting</th><th>keys</th><th>unknowns</th><th>iterations</th><th>MB</th><th>seconds</th>"
      "<th>error</th></tr></thead><tbody>\n";
  for (const Run& run : all)
    out += fmt::format(
        "<tr><td>{}</td><td><code>{}</code></td><td>{:.0f}</td><td>{:.0f}</td><td>{:.0f}</td>"
        "<td>{:.3g}</td><td>{}</td></tr>\n",
        escaped(settings[run.setting].name), escaped(run.keys.back()), run.unknowns, run.iterations, run.memory,
        run.seconds, run.error ? error_text(run) : "too close to the reference");
  return out + "</tbody></table>\n";
}

std::string omissions(const std::vector<Omission>& omitted) {
  if (omitted.empty()) return {};
  std::string out = "<h2>Left out</h2><ul>\n";
  for (const auto& [what, why] : omitted) out += fmt::format("<li>{}: {}</li>\n", escaped(what), escaped(why));
  return out + "</ul>\n";
}

/// The box around the corners of triangles, and the range of their values.
struct Box {
  std::array<double, 4> low, high;
};

double coordinate(const Patch& patch, int corner, std::size_t k) {
  return k < 3 ? patch.corner[corner][k] : patch.value[corner];
}

Box box_around(const std::vector<Patch>& patches) {
  Box box;
  box.low.fill(infinity);
  box.high.fill(-infinity);
  for (const Patch& patch : patches)
    for (int corner = 0; corner < 3; ++corner)
      for (std::size_t k = 0; k < 4; ++k) {
        box.low[k] = std::min(box.low[k], coordinate(patch, corner, k));
        box.high[k] = std::max(box.high[k], coordinate(patch, corner, k));
      }
  return box;
}

/// Triangles as x, y, z and value of each corner: whole numbers, for fewer digits. Lengths are thousandths of the box
/// around all, its middle 0; values those of their range.
std::string numbers(const Panel& panel) {
  const auto [low, high] = box_around(panel.patches);
  std::array<double, 4> size;
  size.fill(std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]}));
  if (panel.view == View::graph) size[2] = 2 * (high[2] - low[2]);  // its height is no length
  size[3] = high[3] - low[3];
  std::string out;
  for (const Patch& patch : panel.patches)
    for (int corner = 0; corner < 3; ++corner)
      for (std::size_t k = 0; k < 4; ++k) {
        const double from = k < 3 ? 0.5 * (low[k] + high[k]) : low[k];
        const double at = size[k] > 0 ? (coordinate(patch, corner, k) - from) / size[k] : 0;
        out += fmt::format("{}{:.0f}", out.empty() ? "" : ",", 1000 * at);
      }
  return fmt::format("const flat = {}, solution = [{}];\n", panel.view == View::flat, out);
}

constexpr const char* style =
    "body { font: 15px/1.5 sans-serif; max-width: 84em; margin: 2em auto; padding: 0 1em; color: #222 }\n"
    "table { border-collapse: collapse } th, td { padding: 0.2em 0.8em; text-align: right }\n"
    "th, tr:nth-child(even) { background: #f2f2f2 } td:first-child, td:nth-child(2) { text-align: left }\n"
    "svg { max-width: 100%; height: auto } canvas { width: 100%; max-width: 44em; cursor: grab; touch-action: none }\n"
    "@media (prefers-color-scheme: dark) { body { background: #181818; color: #ddd }\n"
    "  th, tr:nth-child(even) { background: #262626 } svg, canvas { background: #fff } }\n";

/// Draws the triangles from the farthest to the nearest one, in colours from blue to red.
constexpr const char* viewer = R"(
const canvas = document.getElementById("solution"), pen = canvas.getContext("2d");
const count = solution.length / 12;
let turn = flat ? 0 : 0.6, rise = flat ? Math.PI / 2 : 0.5, zoom = 1;
function draw() {
  const side = canvas.width = canvas.height = Math.round(canvas.clientWidth * devicePixelRatio);
  const ct = Math.cos(turn), st = Math.sin(turn), cr = Math.cos(rise), sr = Math.sin(rise), scale = zoom * side / 1500;
  const x = new Float64Array(3 * count), y = new Float64Array(3 * count), far = new Float64Array(count);
  for (let k = 0; k < 3 * count; ++k) {
    const across = ct * solution[4 * k] - st * solution[4 * k + 1];
    const away = st * solution[4 * k] + ct * solution[4 * k + 1], up = solution[4 * k + 2];
    x[k] = side / 2 + scale * across;
    y[k] = side / 2 - scale * (cr * up + sr * away);
    far[Math.floor(k / 3)] += cr * away - sr * up;
  }
  for (const i of Array.from(far.keys()).sort((a, b) => far[b] - far[a])) {
    const t = (solution[12 * i + 3] + solution[12 * i + 7] + solution[12 * i + 11]) / 3000;
    pen.fillStyle = pen.strokeStyle = `hsl(${240 * (1 - t)}, 75%, ${45 + 15 * Math.sin(Math.PI * t)}%)`;
    pen.beginPath();
    for (let k = 3 * i; k < 3 * i + 3; ++k) pen.lineTo(x[k], y[k]);
    pen.closePath();
    pen.fill();
    pen.stroke();
  }
}
let held = null;
canvas.onpointerdown = e => { held = [e.clientX, e.clientY]; canvas.setPointerCapture(e.pointerId); };
canvas.onpointerup = () => { held = null; };
canvas.onpointermove = e => {
  if (!held) return;
  turn += (e.clientX - held[0]) / 150;
  rise += (e.clientY - held[1]) / 150;
  held = [e.clientX, e.clientY];
  draw();
};
canvas.onwheel = e => { e.preventDefault(); zoom *= Math.exp(-e.deltaY / 600); draw(); };
addEventListener("resize", draw);
draw();
document.body.dataset.drawn = count;
)";

std::string solution_part(const Panel& solution) {
  if (solution.patches.empty()) return {};
  const Box box = box_around(solution.patches);
  return fmt::format(
      "<h2>The solution</h2>\n<p>{} from {:.4g} (blue) to {:.4g} (red). Drag to turn it, scroll to come "
      "nearer.</p>\n<canvas id=\"solution\"></canvas>\n<script>\n{}{}</script>\n",
      escaped(solution.label), box.low[3], box.high[3], numbers(solution), viewer);
}

}  // namespace

std::vector<Panel> panels(const ChartArguments& arguments, const std::vector<Setting>& settings,
                          const std::vector<Run>& all) {
  std::vector<Panel> out{panel(arguments.of, arguments.against, settings, all)};
  if (arguments.against != "unknowns") out.push_back(panel(arguments.of, "unknowns", settings, all));
  return out;
}

std::string csv(const ChartArguments& arguments, const std::vector<Setting>& settings, const std::vector<Run>& all) {
  std::string out = fmt::format("setting,keys,unknowns,iterations,memory_mb,seconds,{},error\n", arguments.of);
  for (const Run& run : all)
    out += fmt::format("\"{}\",\"{}\",{:.0f},{:.0f},{:.1f},{:.6g},\"{:.17g}\",{}\n", settings[run.setting].name,
                       fmt::join(run.keys, " "), run.unknowns, run.iterations, run.memory, run.seconds,
                       fmt::join(run.value, " "), run.error ? fmt::format("{:.6e}", *run.error) : "");
  return out;
}

std::string html(const Page& page, const ChartArguments& arguments, const std::vector<Setting>& settings,
                 const Runs& runs) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<title>{0}</title>\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n<style>\n{1}</style></head><body>\n"
      "<h1>{0}</h1>\n<p>{2}: error against cost. Compared with {3}.{8}</p>\n{4}\n<h2>All runs</h2>\n{5}{6}"
      "{7}</body></html>\n",
      escaped(page.title), style, escaped(arguments.of), escaped(page.reference), page.svg, table(settings, runs.all),
      omissions(runs.omitted), solution_part(page.solution),
      runs.certificate.empty() ? "" : "<br>" + escaped(runs.certificate) + ".");
}

}  // namespace signorini::chart
